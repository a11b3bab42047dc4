#include <algorithm>
#include <array>
#include <cmath>

#include "rwn/fit/innovations.hpp"
#include "rwn/fit/normal_equations.hpp"
#include "task.hpp"

namespace rwn::bind {
namespace {

Array matrix(const std::vector<double>& values, py::ssize_t rows) {
  Array a({rows, rows});
  std::copy(values.begin(), values.end(), a.mutable_data());
  return a;
}

/// Measurements with the arrays that they view.
struct Measured {
  Array current, speed, position;
  Measurements rest;

  Measurements measurements() const {
    Measurements m = rest;
    m.current = view(current);
    m.speed = view(speed);
    m.position = view(position);
    return m;
  }
};

void check(const std::vector<double>& reflection) {
  if (std::any_of(reflection.begin(), reflection.end(), [](double c) { return !(std::abs(c) < 1.0); })) {
    throw std::invalid_argument("a reflection coefficient is a correlation: below 1 in size");
  }
}

Array innovations_of(const Array& errors, const std::vector<double>& reflection, std::size_t restart) {
  check(reflection);
  Array fresh(errors.size());
  std::copy_n(errors.data(), errors.size(), fresh.mutable_data());
  innovations({fresh.mutable_data(), static_cast<std::size_t>(fresh.size())}, reflection, restart);
  return fresh;
}

Measured measured_from(const Array& current, const Array& speed, const Array& position,
                       const std::array<double, 3>& weights, const std::array<std::size_t, 2>& speed_difference,
                       const std::array<std::vector<double>, 3>& reflection) {
  for (const auto& of_signal : reflection) check(of_signal);
  Measured m{current, speed, position, {}};
  m.rest.current_weight = weights[0];
  m.rest.speed_weight = weights[1];
  m.rest.position_weight = weights[2];
  m.rest.speed_measurement = {speed_difference[0], speed_difference[1]};
  m.rest.reflection = reflection;
  return m;
}

/// The sums of squares of one run, as Python takes them.
struct Sums {
  std::string status;
  double chi2;
  long count;
  Array gradient, curvature;
};

Sums sums(const Task& task, const Measured& seen, const Array& parameters, const std::vector<int>& active,
          const std::vector<int>& by, std::optional<Work*> work) {
  const SimulationTask what = task.with(parameters, active, by, work.value_or(nullptr));
  const Measurements measured = seen.measurements();
  for (const auto& signal : {measured.current, measured.speed, measured.position}) {
    if (!signal.empty() && signal.size() != what.time.size()) {
      throw std::invalid_argument("normal_equations: a measured signal differs in length from time");
    }
  }
  NormalEquations sum;
  {
    py::gil_scoped_release release;
    sum = normal_equations(what, measured);
  }
  const auto p = static_cast<py::ssize_t>(by.size());
  return {.status = std::string(to_string(sum.status)),
          .chi2 = sum.chi2,
          .count = static_cast<long>(sum.count),
          .gradient = Array(p, sum.gradient.data()),
          .curvature = matrix(sum.curvature, p)};
}

}  // namespace

void bind_normal_equations(py::module_& m) {
  py::class_<Measured>(m, "Measurements", "Recorded signals (n) of one run; empty: not recorded, NaN: does not count.")
      .def(py::init(&measured_from), py::kw_only(), "current"_a = Array(0), "speed"_a = Array(0),
           "position"_a = Array(0), "weights"_a = std::array<double, 3>{1.0, 1.0, 1.0},
           "speed_difference"_a = std::array<std::size_t, 2>{}, "reflection"_a = std::array<std::vector<double>, 3>{},
           "weights: 1 / standard deviation of current, speed and position; speed_difference: samples before and after "
           "between whose positions the speed was taken; reflection: partial autocorrelations of the noise of each, "
           "whose "
           "errors then count as what is new in them.");
  m.def("innovations", &innovations_of, "errors"_a, "reflection"_a, "restart"_a = 0,
        "What is new in errors (n) whose noise has these partial autocorrelations; NaN is passed over.");
  py::class_<Sums>(m, "NormalEquations", "Squared error chi2 over `count` samples, J'r (p) and J'J (p, p).")
      .def_readonly("status", &Sums::status)
      .def_readonly("chi2", &Sums::chi2)
      .def_readonly("count", &Sums::count)
      .def_readonly("gradient", &Sums::gradient)
      .def_readonly("curvature", &Sums::curvature);
  m.def("normal_equations", &sums, "task"_a, "measurements"_a, "parameters"_a.noconvert(), "active"_a, "by"_a,
        "work"_a = std::optional<Work*>{}, "Free-run output error of one run.");
}

}  // namespace rwn::bind
