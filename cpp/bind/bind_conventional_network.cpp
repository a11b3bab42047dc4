#include "bind.hpp"
#include "rwn/networks/conventional_network.hpp"

namespace rwn::bind {

void bind_conventional_network(py::module_& m) {
  using Network = ConventionalNetwork;
  const auto release = py::call_guard<py::gil_scoped_release>();
  py::class_<Network>(m, "ConventionalNetwork")
      .def(py::init([](const Wavelet& wavelet, int inputs, int wavelets, int outputs, Eigen::VectorXd parameters) {
             return Network(wavelet, {inputs, wavelets, outputs}, std::move(parameters));
           }),
           "wavelet"_a, "inputs"_a, "wavelets"_a, "outputs"_a, "parameters"_a.noconvert())
      .def_property_readonly("parameters", [](const Network& n) { return Eigen::VectorXd(n.parameters()); })
      .def("output", &Network::output, "x"_a.noconvert(), release)
      .def("gradient", &Network::gradient, "x"_a.noconvert(), "y"_a.noconvert(), release)
      .def("jacobian", &Network::jacobian, "x"_a.noconvert(), release);
}

}  // namespace rwn::bind
