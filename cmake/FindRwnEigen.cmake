# Eigen from Debian's libeigen3-dev, else from the cmeel-eigen wheel of the build requirements; never from the network.
find_package(Eigen3 3.3 QUIET NO_MODULE)
if(NOT Eigen3_FOUND)
  set(_hints)
  foreach(_path IN LISTS CMAKE_PREFIX_PATH)
    list(APPEND _hints "${_path}/cmeel.prefix")
  endforeach()
  find_package(Python QUIET COMPONENTS Interpreter Development.Module)  # both: pybind11 does not look again
  if(Python_Interpreter_FOUND)
    execute_process(
      COMMAND "${Python_EXECUTABLE}" -c "import sysconfig; print(sysconfig.get_path('purelib'))"
      OUTPUT_VARIABLE _purelib OUTPUT_STRIP_TRAILING_WHITESPACE)
    list(APPEND _hints "${_purelib}/cmeel.prefix")
  endif()
  find_package(Eigen3 3.3 QUIET NO_MODULE HINTS ${_hints})
endif()
if(NOT Eigen3_FOUND)
  message(FATAL_ERROR "Eigen 3 was not found. Install Debian's libeigen3-dev, or: pip install cmeel-eigen")
endif()
message(STATUS "rwn: Eigen ${Eigen3_VERSION} from ${Eigen3_DIR}")
