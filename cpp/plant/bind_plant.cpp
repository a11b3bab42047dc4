#include <algorithm>
#include <cmath>
#include <map>

#include "bind.hpp"
#include "plant/plant.hpp"

namespace {

using namespace rwn;
using namespace rwn::bind;

PlantParameters parameters_from(const std::map<std::string, double>& values) {
  PlantParameters p;
  const auto& names = plant_parameter_names();
  for (const auto& [name, value] : values) {
    const auto found = std::find_if(names.begin(), names.end(), [&](const auto& known) { return known.name == name; });
    if (found == names.end()) throw std::invalid_argument("plant: no parameter is called " + name);
    p.*(found->member) = value;
  }
  return p;
}

std::array<double, plant_sample_width> row_of(const PlantSample& s) {
  return {s.current, s.speed, s.position, s.sensed_current, s.sensed_speed, s.temperature_rise};
}

py::array_t<double> sampled(const std::map<std::string, double>& values, const Array& voltage, double sample_time,
                            int substeps, double fineness) {
  const py::ssize_t n = voltage.size();
  const double* v = voltage.data();
  py::array_t<double> out({n, static_cast<py::ssize_t>(plant_sample_width)});
  double* rows = out.mutable_data();
  {
    const py::gil_scoped_release free_others;
    const double scale =
        n == 0 ? 0.0
               : std::abs(*std::max_element(v, v + n, [](double a, double b) { return std::abs(a) < std::abs(b); }));
    Plant plant(parameters_from(values), sample_time, scale, substeps, fineness);
    for (py::ssize_t k = 0; k < n; ++k) {
      std::ranges::copy(row_of(plant.sample()), rows + k * static_cast<py::ssize_t>(plant_sample_width));
      plant.step(v[k]);
    }
  }
  return out;
}

std::vector<std::array<double, plant_sample_width>> watched(Plant& plant, double voltage, std::size_t instants) {
  std::vector<PlantSample> seen(instants);
  plant.step(voltage, seen);
  std::vector<std::array<double, plant_sample_width>> rows;
  for (const PlantSample& one : seen) rows.push_back(row_of(one));
  return rows;
}

}  // namespace

PYBIND11_MODULE(_plant, m, pybind11::mod_gil_not_used()) {
  m.doc() = "The independent plant of the blind trials.";
  m.def("parameter_names", [] {
    std::vector<std::string> names;
    for (const auto& known : plant_parameter_names()) names.emplace_back(known.name);
    return names;
  });
  m.def("run", &sampled, "parameters"_a, "voltage"_a.noconvert(), "sample_time"_a, "substeps"_a, "fineness"_a,
        "Rows of (current, speed, position, sensed current, sensed speed, temperature rise), one per voltage.");
  py::class_<Plant>(m, "Plant", "The blind trials' motor, one sample at a time.")
      .def(py::init([](const std::map<std::string, double>& values, double sample_time, double voltage_scale,
                       int substeps, double fineness) {
             return Plant(parameters_from(values), sample_time, voltage_scale, substeps, fineness);
           }),
           "parameters"_a, "sample_time"_a, "voltage_scale"_a, "substeps"_a, "fineness"_a)
      .def("step", py::overload_cast<double>(&Plant::step), "voltage"_a)
      .def("step", &watched, "voltage"_a, "instants"_a,
           "The same; returns (current, speed, position, sensed current, sensed speed, temperature rise) at `instants` "
           "even\n"
           "places of the step, the first at its beginning.")
      .def("wait", &Plant::wait)
      .def("sample", [](const Plant& plant) { return row_of(plant.sample()); })
      .def_property_readonly("substeps", &Plant::substeps);
}
