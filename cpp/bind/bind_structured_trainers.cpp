#include "bind.hpp"
#include "defaults.hpp"
#include "rwn/networks/trainers/recursive_gauss_newton.hpp"
#include "rwn/networks/trainers/structured_levenberg_marquardt.hpp"

namespace rwn::bind {

namespace {

py::dict structured_trainer_defaults() {
  py::dict all;
  all["recursive-gauss-newton"] = defaults_of<RecursiveGaussNewton>(
      std::pair{"noise", &RecursiveGaussNewton::noise}, std::pair{"forgetting", &RecursiveGaussNewton::forgetting},
      std::pair{"forgetting_decay", &RecursiveGaussNewton::forgetting_decay},
      std::pair{"underweighting", &RecursiveGaussNewton::underweighting},
      std::pair{"follow_state", &RecursiveGaussNewton::follow_state},
      std::pair{"cycles", &RecursiveGaussNewton::cycles},
      std::pair{"frozen_every", &RecursiveGaussNewton::frozen_every});
  all["structured-levenberg-marquardt"] = defaults_of<StructuredLevenbergMarquardt>(
      std::pair{"iterations", &StructuredLevenbergMarquardt::iterations},
      std::pair{"damping", &StructuredLevenbergMarquardt::damping},
      std::pair{"tolerance", &StructuredLevenbergMarquardt::tolerance},
      std::pair{"gauge", &StructuredLevenbergMarquardt::gauge},
      std::pair{"weights_first", &StructuredLevenbergMarquardt::weights_first},
      std::pair{"ridge", &StructuredLevenbergMarquardt::ridge});
  return all;
}

}  // namespace

void bind_structured_trainers(py::module_& m) {
  const auto release = py::call_guard<py::gil_scoped_release>();
  m.def("structured_trainer_defaults", &structured_trainer_defaults);
  m.def(
      "recursive_gauss_newton",
      [](const StructuredNetwork& network, const VectorRef& input, const VectorRef& speed, const Eigen::Vector2d& start,
         const VectorRef& spread, double noise, double forgetting, double forgetting_decay, double underweighting,
         bool follow_state, int cycles, int frozen_every) {
        const RecursiveGaussNewton trainer{noise,        forgetting, forgetting_decay, underweighting,
                                           follow_state, cycles,     frozen_every};
        auto r = trainer.train(network, {input, speed, start}, spread);
        return std::make_tuple(Vector(r.network.theta()), std::move(r.history), std::move(r.deviation));
      },
      "network"_a, "input"_a.noconvert(), "speed"_a.noconvert(), "start"_a, py::kw_only(), "spread"_a.noconvert(),
      "noise"_a, "forgetting"_a, "forgetting_decay"_a, "underweighting"_a, "follow_state"_a, "cycles"_a,
      "frozen_every"_a, release);

  using Fit = StructuredLevenbergMarquardt::Result;
  py::class_<Fit>(m, "StructuredFit")
      .def_property_readonly("theta", [](const Fit& f) { return Vector(f.network.theta()); })
      .def_readonly("slope", &Fit::slope)
      .def_property_readonly("status", [](const Fit& f) { return std::string(to_string(f.status)); })
      .def_property_readonly("advice", [](const Fit& f) { return std::string(advice(f.status)); })
      .def_readonly("mse", &Fit::mse)
      .def_readonly("deviation", &Fit::deviation)
      .def_readonly("condition", &Fit::condition);
  m.def(
      "structured_levenberg_marquardt",
      [](const StructuredNetwork& network, const VectorRef& input, const VectorRef& speed, const Eigen::Vector2d& start,
         const VectorRef& network_speed, const std::string& feed, const VectorRef& current, double current_weight,
         const std::vector<bool>& learn, int iterations, double damping, double tolerance, bool gauge,
         bool weights_first, double ridge) {
        const StructuredLevenbergMarquardt trainer{iterations, damping, tolerance, gauge, weights_first, ridge};
        return trainer.fit(network, {{input, speed, start}, network_speed, current, current_weight, feed_by_name(feed)},
                           learn);
      },
      "network"_a, "input"_a.noconvert(), "speed"_a.noconvert(), "start"_a, py::kw_only(),
      "network_speed"_a.noconvert(), "feed"_a, "current"_a.noconvert(), "current_weight"_a, "learn"_a, "iterations"_a,
      "damping"_a, "tolerance"_a, "gauge"_a, "weights_first"_a, "ridge"_a, release);
  m.def("simulate_fed_back",
        [](const StructuredNetwork& network, double slope, const VectorRef& input, const Eigen::Vector2d& start) {
          return simulate_fed_back(network, slope, {input, input, start});
        },
        "network"_a, "slope"_a, "input"_a.noconvert(), "start"_a, release, "Speed of a free run.");
  m.def(
      "simulate_plant",
      [](const StructuredNetwork& network, const VectorRef& input, const VectorRef& torque,
         const Eigen::Vector2d& start) { return simulate_plant(network, {input, input, start}, torque); },
      "network"_a, "input"_a.noconvert(), "torque"_a.noconvert(), "start"_a, release,
      "Speed for the input and a given friction torque.");
}

}  // namespace rwn::bind
