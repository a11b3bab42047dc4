#include <algorithm>
#include <set>
#include <stdexcept>
#include <string_view>

#include "rwn/model/sites.hpp"
#include "rwn/simulate/active_effects.hpp"
#include "rwn/simulate/transfer_function.hpp"
#include "task.hpp"

namespace rwn::bind {
namespace {

/// Factor, and the power of each quantity that is part of it.
py::tuple describe(const Scale& scale) {
  py::dict powers;
  for (std::size_t k = 0; k < scale.powers.size(); ++k) {
    if (scale.powers[k] != 0) powers[py::str(std::string(Scale::quantities[k]))] = scale.powers[k];
  }
  return py::make_tuple(scale.factor, powers);
}

/// None where there is none.
py::object name_of_motor_parameter(int index) {
  if (index < 0) return py::none();
  return py::cast(std::string(motor_parameters[static_cast<std::size_t>(index)].name));
}

py::dict describe(const Parameter& p) {
  py::dict d;
  std::vector<double> scan(p.scan.begin(), p.scan.end());
  while (!scan.empty() && scan.back() == 0.0) scan.pop_back();
  d["name"] = std::string(p.name);
  d["symbol"] = std::string(p.symbol);
  d["unit"] = std::string(p.unit);
  d["meaning"] = std::string(p.meaning);
  d["lower"] = p.lower;
  d["upper"] = p.upper;
  d["start"] = p.start;
  d["scale"] = describe(p.scale);
  d["scan"] = scan;
  d["strength"] = p.strength;
  d["fixed"] = p.fixed;
  d["cyclic"] = p.cyclic;
  d["order"] = p.order;
  d["idealised"] = p.idealised;
  d["natural"] = p.natural;
  d["replaces"] = name_of_motor_parameter(p.replaces);
  d["line"] = p.line;
  d["beside"] = name_of_motor_parameter(p.beside);
  return d;
}

template <class List>
py::list describe_all(const List& parameters) {
  py::list list;
  for (const Parameter& p : parameters) list.append(describe(p));
  return list;
}

template <class E>
py::dict describe_effect() {
  py::dict d;
  d["name"] = std::string(E::info.name);
  d["site"] = std::string(to_string(E::info.site));
  d["mismatch"] = std::string(equation_of(E::info.site));
  d["equation"] = std::string(E::info.equation);
  d["meaning"] = std::string(E::info.meaning);
  d["source"] = std::string(E::info.source);
  d["parameters"] = describe_all(E::parameters);
  d["turns"] = E::traits.turns;
  d["one_sided"] = E::traits.one_sided;
  d["steady"] = is_steady_torque<E>();
  d["holds"] = E::traits.holds;
  d["rectifies"] = rectifies<E>();
  d["jumps"] = jumps<E>();
  d["filters"] = std::string(E::traits.filters);
  d["shows_late"] = std::string(E::traits.shows_late);
  d["delays"] = has(E::traits.hooks, Hook::delay);
  d["second_mass"] = has(E::traits.hooks, Hook::joint);
  d["guess"] = std::string(to_string(guess_of<E>()));
  d["special_case"] = std::string(E::traits.special_case);
  return d;
}

py::list effect_table() {
  py::list table;
  std::apply([&](auto... e) { (table.append(describe_effect<decltype(e)>()), ...); }, Effects{});
  return table;
}

std::set<std::string> drive_sites(const std::string& drive) {
  std::set<std::string> sites;
  for (Site site : all_sites) {
    if (has_site(drive_of(drive), site)) sites.emplace(to_string(site));
  }
  return sites;
}

/// Number of parameters of the effect of this name.
std::size_t parameters_of(std::string_view name) {
  std::size_t count = 0;
  std::apply([&](auto... e) { ((count += decltype(e)::info.name == name ? decltype(e)::parameters.size() : 0), ...); },
             Effects{});
  return count;
}

/// Whether `general` are parameters of the effect E of this name, which has a special case: then with its parameters.
template <class E>
bool specialise(std::string_view name, const std::vector<double>& general, std::vector<double>& special) {
  if constexpr (requires { &E::specialise; }) {
    if (name != E::info.name || general.size() != E::parameters.size()) return false;
    special.resize(parameters_of(E::traits.special_case));
    E::specialise(general.data(), special.data());
    return true;
  }
  return false;
}

std::vector<double> special_case_parameters(const std::string& name, const std::vector<double>& general) {
  std::vector<double> special;
  const bool found = std::apply([&](auto... e) { return (specialise<decltype(e)>(name, general, special) || ...); },
                                Effects{});
  if (!found) {
    throw std::invalid_argument("no special case of " + name + " by " + std::to_string(general.size()) + " parameters");
  }
  return special;
}

bool has_current(int drive) {
  return with_drive(drive, [](auto d) {
    if constexpr (decltype(d)::coefficients) {
      return false;
    } else {
      return decltype(d)::states > 0;
    }
  });
}

/// What a simulation gave: signals (n) and their derivatives (n, p), by the name of the signal.
struct Simulated {
  std::string status;
  py::dict signals, slopes;
};

Simulated run(const Task& task, const Array& parameters, const std::vector<int>& active, const std::vector<int>& by,
              std::optional<Work*> work) {
  const auto n = static_cast<py::ssize_t>(task.fixed.time.size());
  const auto p = static_cast<py::ssize_t>(by.size());
  std::vector<Array> out;
  for (int k = 0; k < 3; ++k) out.emplace_back(n);
  for (int k = 0; k < 3; ++k) out.emplace_back(std::vector<py::ssize_t>{n, p});
  const SimulationTask what = task.with(parameters, active, by, work.value_or(nullptr));
  if (!has_current(what.drive)) {  // untouched zeros
    std::fill_n(out[0].mutable_data(), out[0].size(), 0.0);
    std::fill_n(out[3].mutable_data(), out[3].size(), 0.0);
  }
  const bool electrical = has_current(what.drive);
  const SimulationOutput output{electrical ? view(out[0]) : std::span<double>{}, view(out[1]), view(out[2]),
                                electrical ? view(out[3]) : std::span<double>{}, view(out[4]), view(out[5])};
  SimulationStatus status;
  {
    py::gil_scoped_release release;
    status = simulate(what, output);
  }
  return {.status = std::string(to_string(status)),
          .signals = py::dict("current"_a = out[0], "speed"_a = out[1], "position"_a = out[2]),
          .slopes = py::dict("current"_a = out[3], "speed"_a = out[4], "position"_a = out[5])};
}

}  // namespace

void bind_simulate(py::module_& m) {
  m.def("motor_parameter_table", [] { return describe_all(motor_parameters); }, "The motor's own parameters.");
  m.def("effect_table", &effect_table, "Every effect with its parameters, as the C++ table states them.");
  m.def("drive_sites", &drive_sites, "drive"_a, "Where effects can attach to a kind of drive, by its name.");
  m.def("special_case_parameters", &special_case_parameters, "effect"_a, "parameters"_a,
        "Parameters of an effect's special case, in the order of the table, from those of the effect.");
  m.attr("scale_quantities") = std::vector<std::string>(Scale::quantities.begin(), Scale::quantities.end());
  m.def("parameter_count", &parameter_count);
  m.def("first_coefficient", &first_coefficient);
  m.attr("max_order") = max_order;
  m.def("simulation_advice", [](const std::string& status) {
    return std::string(advice(status_of(status)));
  });
  py::class_<Simulated>(m, "Simulated", "Signals (n) [SI] and their derivatives (n, p), by the name of the signal.")
      .def_readonly("status", &Simulated::status)
      .def_readonly("signals", &Simulated::signals)
      .def_readonly("slopes", &Simulated::slopes);
  m.def("simulate", &run, "task"_a, "parameters"_a.noconvert(), "active"_a, "by"_a, "work"_a = std::optional<Work*>{},
        "Free run from the input and the start, with derivatives by the parameters `by`.");
}

}  // namespace rwn::bind
