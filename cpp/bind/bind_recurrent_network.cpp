#include "bind.hpp"
#include "rwn/networks/recurrent_network.hpp"

namespace rwn::bind {

void bind_recurrent_network(py::module_& m) {
  using Inputs = Eigen::Ref<const RowMatrix>;
  const auto release = py::call_guard<py::gil_scoped_release>();
  py::class_<RecurrentNetwork>(m, "RecurrentNetwork")
      .def(py::init([](const VectorRef& theta, Eigen::Index inputs, const Wavelet& wavelet) {
             return RecurrentNetwork(theta, inputs, wavelet);
           }),
           "theta"_a.noconvert(), "inputs"_a, "wavelet"_a)
      .def_property_readonly("theta", [](const RecurrentNetwork& n) { return Vector(n.theta()); })
      .def(
          "simulate", [](const RecurrentNetwork& n, const Inputs& x) { return simulate(n, x); }, "x"_a.noconvert(),
          release)
      .def(
          "sensitivities",
          [](const RecurrentNetwork& n, const Inputs& x) {
            RecurrentSensitivities s = sensitivities(n, x);
            return std::make_pair(std::move(s.output), std::move(s.jacobian));
          },
          "x"_a.noconvert(), release);
}

}  // namespace rwn::bind
