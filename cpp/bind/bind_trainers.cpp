#include "bind.hpp"
#include "defaults.hpp"
#include "rwn/networks/trainers.hpp"

namespace rwn::bind {
namespace {

Training train(const auto& trainer, const ConventionalNetwork& network, const RowMatrixRef& x, const RowMatrixRef& y) {
  return trainer.train(network, Patterns(x, y));
}

py::dict trainer_defaults() {
  py::dict all;
  all["gradient-descent"] = defaults_of<GradientDescent>(
      std::pair{"rate", &GradientDescent::rate}, std::pair{"momentum", &GradientDescent::momentum},
      std::pair{"iterations", &GradientDescent::iterations}, std::pair{"target", &GradientDescent::target},
      std::pair{"stall", &GradientDescent::stall});
  all["pattern-descent"] = defaults_of<PatternDescent>(
      std::pair{"rate", &PatternDescent::rate}, std::pair{"momentum", &PatternDescent::momentum},
      std::pair{"shape_momentum", &PatternDescent::shape_momentum},
      std::pair{"iterations", &PatternDescent::iterations}, std::pair{"target", &PatternDescent::target},
      std::pair{"stall", &PatternDescent::stall});
  all["pattern-gauss-newton"] = defaults_of<PatternGaussNewton>(
      std::pair{"noise", &PatternGaussNewton::noise}, std::pair{"weight_prior", &PatternGaussNewton::weight_prior},
      std::pair{"shape_prior", &PatternGaussNewton::shape_prior},
      std::pair{"forgetting", &PatternGaussNewton::forgetting},
      std::pair{"iterations", &PatternGaussNewton::iterations}, std::pair{"target", &PatternGaussNewton::target},
      std::pair{"stall", &PatternGaussNewton::stall});
  all["levenberg-marquardt"] = defaults_of<LevenbergMarquardt>(
      std::pair{"mu", &LevenbergMarquardt::mu}, std::pair{"beta", &LevenbergMarquardt::beta},
      std::pair{"iterations", &LevenbergMarquardt::iterations}, std::pair{"target", &LevenbergMarquardt::target},
      std::pair{"stall", &LevenbergMarquardt::stall});
  all["variable-projection"] = defaults_of<VariableProjection>(
      std::pair{"mu", &VariableProjection::mu}, std::pair{"beta", &VariableProjection::beta},
      std::pair{"resolution", &VariableProjection::resolution},
      std::pair{"iterations", &VariableProjection::iterations}, std::pair{"target", &VariableProjection::target},
      std::pair{"stall", &VariableProjection::stall});
  return all;
}

}  // namespace

void bind_trainers(py::module_& m) {
  m.def("trainer_names", &trainer_names);
  m.def("trainer_defaults", &trainer_defaults);
  py::class_<Training>(m, "Training")
      .def_property_readonly("parameters", [](const Training& t) { return Eigen::VectorXd(t.network.parameters()); })
      .def_property_readonly(
          "mse", [](const Training& t) { return py::array_t<double>(py::ssize_t(t.mse.size()), t.mse.data()); })
      .def_readonly("frozen_mse", &Training::frozen_mse)
      .def_property_readonly("status", [](const Training& t) { return std::string(to_string(t.status)); })
      .def_property_readonly("advice", [](const Training& t) { return std::string(advice(t.status)); });

  const auto release = py::call_guard<py::gil_scoped_release>();
  m.def(
      "gradient_descent",
      [](const ConventionalNetwork& network, const RowMatrixRef& x, const RowMatrixRef& y, double rate, double momentum,
         int iterations, double target,
         double stall) { return train(GradientDescent{rate, momentum, iterations, target, stall}, network, x, y); },
      "network"_a, "x"_a.noconvert(), "y"_a.noconvert(), py::kw_only(), "rate"_a, "momentum"_a, "iterations"_a,
      "target"_a, "stall"_a, release);
  m.def(
      "pattern_descent",
      [](const ConventionalNetwork& network, const RowMatrixRef& x, const RowMatrixRef& y, double rate, double momentum,
         double shape_momentum, int iterations, double target, double stall) {
        return PatternDescent{rate, momentum, shape_momentum, iterations, target, stall}.train(network, x, y);
      },
      "network"_a, "x"_a.noconvert(), "y"_a.noconvert(), py::kw_only(), "rate"_a, "momentum"_a, "shape_momentum"_a,
      "iterations"_a, "target"_a, "stall"_a, release);
  m.def(
      "pattern_gauss_newton",
      [](const ConventionalNetwork& network, const RowMatrixRef& x, const RowMatrixRef& y, double noise,
         double weight_prior, double shape_prior, double forgetting, int iterations, double target, double stall) {
        return PatternGaussNewton{noise, weight_prior, shape_prior, forgetting, iterations, target, stall}.train(
            network, x, y);
      },
      "network"_a, "x"_a.noconvert(), "y"_a.noconvert(), py::kw_only(), "noise"_a, "weight_prior"_a, "shape_prior"_a,
      "forgetting"_a, "iterations"_a, "target"_a, "stall"_a, release);
  m.def("levenberg_marquardt",
        [](const ConventionalNetwork& network, const RowMatrixRef& x, const RowMatrixRef& y, double mu, double beta,
           int iterations, double target, double stall) {
          return train(LevenbergMarquardt{mu, beta, iterations, target, stall}, network, x, y);
        },
        "network"_a, "x"_a.noconvert(), "y"_a.noconvert(), py::kw_only(), "mu"_a, "beta"_a, "iterations"_a, "target"_a,
        "stall"_a, release);
  m.def(
      "variable_projection",
      [](const ConventionalNetwork& network, const RowMatrixRef& x, const RowMatrixRef& y, double mu, double beta,
         double resolution, int iterations, double target, double stall) {
        return train(VariableProjection{mu, beta, resolution, iterations, target, stall}, network, x, y);
      },
      "network"_a, "x"_a.noconvert(), "y"_a.noconvert(), py::kw_only(), "mu"_a, "beta"_a, "resolution"_a,
      "iterations"_a, "target"_a, "stall"_a, release);
}

}  // namespace rwn::bind
