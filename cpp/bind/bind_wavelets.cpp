#include "bind.hpp"
#include "rwn/networks/wavelets.hpp"

namespace rwn::bind {
namespace {

/// f(wavelet, z) at every element of an array of any shape.
template <class F>
py::array_t<double> over(const Wavelet& wavelet, const Array& z, F f) {
  py::array_t<double> out(std::vector<py::ssize_t>(z.shape(), z.shape() + z.ndim()));
  const double* from = z.data();
  double* to = out.mutable_data();
  wavelet.visit([&](const auto& w) {
    for (py::ssize_t n = 0; n < z.size(); ++n) {
      to[n] = f(w, from[n]);
    }
  });
  return out;
}

}  // namespace

void bind_wavelets(py::module_& m) {
  m.def("wavelet_names", &wavelet_names);
  py::class_<Wavelet>(m, "Wavelet")
      .def(py::init<std::string, double>(), "name"_a, "omega0"_a)
      .def_property_readonly("max_value", &Wavelet::max_value)
      .def_property_readonly("max_derivative", &Wavelet::max_derivative)
      .def_property_readonly("max_scaled_derivative", &Wavelet::max_scaled_derivative)
      .def(
          "value",
          [](const Wavelet& w, const Array& z) {
            return over(w, z, [](const auto& k, double x) { return k.value(x); });
          },
          "z"_a.noconvert())
      .def(
          "derivative",
          [](const Wavelet& w, const Array& z) {
            return over(w, z, [](const auto& k, double x) { return k.derivative(x); });
          },
          "z"_a.noconvert())
      .def(
          "second_derivative",
          [](const Wavelet& w, const Array& z) {
            return over(w, z, [](const auto& k, double x) { return k.second_derivative(x); });
          },
          "z"_a.noconvert());
}

}  // namespace rwn::bind
