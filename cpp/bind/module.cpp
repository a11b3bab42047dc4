// Table of contents of the extension module: one bind_<noun>.cpp per noun.
#include "bind.hpp"
#include "rwn/isa.hpp"

namespace rwn::bind {
void bind_plant(py::module_& m);
void bind_wavelets(py::module_& m);
}  // namespace rwn::bind

PYBIND11_MODULE(_core, m, pybind11::mod_gil_not_used()) {
  using namespace rwn::bind;
  m.doc() = "C++ core of rwn; use the classes of the rwn package, which check their input and explain themselves.";
  m.attr("__version__") = RWN_VERSION;
  m.def("isa", [] { return std::string(rwn::to_string(rwn::isa())); }, "Instruction set in use.");
  bind_plant(m);
  bind_wavelets(m);
}
