#include "bind.hpp"
#include "rwn/networks/plant_analysis.hpp"
#include "rwn/networks/structured_network.hpp"

namespace rwn::bind {

void bind_structured_network(py::module_& m) {
  const auto release = py::call_guard<py::gil_scoped_release>();
  py::class_<StructuredNetwork>(m, "StructuredNetwork")
      .def(py::init([](const VectorRef& theta, const Wavelet& wavelet) { return StructuredNetwork(theta, wavelet); }),
           "theta"_a.noconvert(), "wavelet"_a)
      .def_property_readonly("theta", [](const StructuredNetwork& n) { return Vector(n.theta()); })
      .def_property_readonly("plant", &StructuredNetwork::plant)
      .def(
          "simulate",
          [](const StructuredNetwork& n, const VectorRef& input, const VectorRef& speed, const Eigen::Vector2d& start) {
            return simulate(n, {input, speed, start});
          },
          "input"_a.noconvert(), "speed"_a.noconvert(), "start"_a, release)
      .def(
          "sensitivities",
          [](const StructuredNetwork& n, const VectorRef& input, const VectorRef& speed, const Eigen::Vector2d& start) {
            StructuredSensitivities s = sensitivities(n, {input, speed, start});
            return std::make_pair(std::move(s.speed), std::move(s.jacobian));
          },
          "input"_a.noconvert(), "speed"_a.noconvert(), "start"_a, release);

  m.def("plant_gain",
        [](double a11, double a12, double a21, double a22) {
          const PlantGain g = plant_gain(a11, a12, a21, a22);
          return std::make_pair(g.spectral_radius, g.condition);
        },
        "a11"_a, "a12"_a, "a21"_a, "a22"_a, "rho(A) and cond(M) in closed form.");
  m.def("plant_gain_by_eigen",
        [](const Eigen::Matrix2d& a) {
          const PlantGain g = plant_gain_by_eigen(a);
          return std::make_pair(g.spectral_radius, g.condition);
        },
        "a"_a, "rho(A) and cond(M) from Eigen's eigendecomposition.");
  m.def("impulse_sums",
        [](const Eigen::Matrix2d& a) {
          const ImpulseSums s = impulse_sums(a);
          return std::make_pair(s.mechanical, s.electrical);
        },
        "a"_a, "Sums over r of |C A^r e1| and |C A^r e2|.");
}

}  // namespace rwn::bind
