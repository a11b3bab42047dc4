#include <algorithm>
#include <array>

#include "bind.hpp"
#include "rwn/normal_equations.hpp"

namespace rwn::bind {
namespace {

Array matrix(const std::vector<double>& values, py::ssize_t rows) {
  Array a({rows, rows});
  std::copy(values.begin(), values.end(), a.mutable_data());
  return a;
}

py::tuple sums(const std::string& kind, const Array& time, const Array& input, const Array& parameters,
              const std::vector<int>& active, const std::vector<int>& by, const Array& current, const Array& speed,
              const Array& position, const std::array<double, 3>& weights, const std::string& speed_measurement,
              double angle_per_position, double input_before, const Array& angle, bool angle_from_speed,
              int restart_every, const Array& restart_speed, const Array& restart_position, int order,
              const std::vector<OwnEffect>& own, const std::array<double, 3>& persistence, std::optional<Work*> work) {
  const SimulationTask task{kind_of(kind),
                            view(time),
                            view(input),
                            view(parameters),
                            active,
                            by,
                            angle_per_position,
                            input_before,
                            view(angle),
                            angle_from_speed,
                            restart_every,
                            view(restart_speed),
                            view(restart_position),
                            order,
                            own,
                            work.value_or(nullptr)};
  const Measurements measured{view(current),
                              view(speed),
                              view(position),
                              weights[0],
                              weights[1],
                              weights[2],
                              speed_measurement_of(speed_measurement),
                              persistence};
  if (std::any_of(persistence.begin(), persistence.end(), [](double c) { return !(c >= 0.0 && c < 1.0); })) {
    throw std::invalid_argument("normal_equations: a persistence is a correlation from 0 to less than 1");
  }
  for (const auto& signal : {measured.current, measured.speed, measured.position}) {
    if (!signal.empty() && signal.size() != task.time.size()) {
      throw std::invalid_argument("normal_equations: a measured signal differs in length from time");
    }
  }
  NormalEquations sum;
  {
    py::gil_scoped_release release;
    sum = normal_equations(task, measured);
  }
  const auto p = static_cast<py::ssize_t>(by.size());
  return py::make_tuple(std::string(to_string(sum.status)), sum.chi2, sum.count, Array(p, sum.gradient.data()),
                        matrix(sum.curvature, p));
}

}  // namespace

void bind_normal_equations(py::module_& m) {
  m.def("normal_equations", &sums, "kind"_a, "time"_a.noconvert(), "input"_a.noconvert(), "parameters"_a.noconvert(),
        "active"_a, "by"_a, "current"_a.noconvert(), "speed"_a.noconvert(), "position"_a.noconvert(), "weights"_a,
        "speed_measurement"_a = "instantaneous", "angle_per_position"_a = 1.0, "input_before"_a = 0.0,
        "angle"_a = Array(0), "angle_from_speed"_a = false, "restart_every"_a = 0, "restart_speed"_a = Array(0),
        "restart_position"_a = Array(0), "order"_a = 0, "own"_a = std::vector<OwnEffect>{},
        "persistence"_a = std::array<double, 3>{}, "work"_a = std::optional<Work*>{},
        "Free-run output error: status, chi2, count, J'r (p) and J'J (p, p). Empty arrays: not recorded.");
}

}  // namespace rwn::bind
