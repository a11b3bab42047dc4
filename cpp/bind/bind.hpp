// The one header of all binding files, so that no two of them see different type casters.
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <span>

namespace rwn::bind {

namespace py = pybind11;
using namespace pybind11::literals;

/// Read-only view of a C-contiguous float64 array; anything else is refused, never converted silently.
using Array = py::array_t<double, py::array::c_style>;

inline std::span<const double> view(const Array& a) { return {a.data(), static_cast<std::size_t>(a.size())}; }
inline std::span<double> view(Array& a) { return {a.mutable_data(), static_cast<std::size_t>(a.size())}; }

}  // namespace rwn::bind
