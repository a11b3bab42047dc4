#include "bind.hpp"
#include "rwn/simulate.hpp"
#include "rwn/transfer_function.hpp"

namespace rwn::bind {
namespace {

py::dict describe(const Parameter& p) {
  py::dict d;
  std::vector<double> scan(p.scan.begin(), p.scan.end());
  while (!scan.empty() && scan.back() == 0.0) scan.pop_back();
  d["name"] = std::string(p.name);
  d["unit"] = std::string(p.unit);
  d["meaning"] = std::string(p.meaning);
  d["lower"] = p.lower;
  d["upper"] = p.upper;
  d["start"] = p.start;
  d["scale"] = std::string(to_string(p.scale));
  d["scan"] = scan;
  d["inverse"] = p.inverse;
  d["strength"] = p.strength;
  d["fixed"] = p.fixed;
  d["cyclic"] = p.cyclic;
  d["order"] = p.order;
  d["window"] = p.window;
  d["resonance"] = p.resonance;
  d["many_minima"] = p.many_minima;
  d["lattice"] = p.lattice;
  d["idealised"] = p.idealised;
  d["replaces"] = p.replaces < 0 ? py::object(py::none())
                                 : py::cast(std::string(motor_parameters[static_cast<std::size_t>(p.replaces)].name));
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
  d["turns"] = requires { E::turns; };
  d["second_mass"] = functions_of<double, E>().joint != nullptr;
  return d;
}

py::list effect_table() {
  py::list table;
  std::apply([&](auto... e) { (table.append(describe_effect<decltype(e)>()), ...); }, Effects{});
  return table;
}

py::tuple run(const std::string& kind, const Array& time, const Array& input, const Array& parameters,
              const std::vector<int>& active, const std::vector<int>& by, double angle_per_position,
              double input_before, const Array& angle, bool angle_from_speed, int restart_every,
              const Array& restart_speed, const Array& restart_position, int order,
              const std::vector<OwnEffect>& own, std::optional<Work*> work) {
  const auto n = time.size();
  const auto p = static_cast<py::ssize_t>(by.size());
  std::vector<Array> out;
  for (int k = 0; k < 3; ++k) out.emplace_back(n);
  for (int k = 0; k < 3; ++k) out.emplace_back(std::vector<py::ssize_t>{n, p});
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
  const bool electrical = task.kind == Kind::dc;
  if (!electrical) {  // an axis has no current: untouched zeros
    const py::object zeros = py::module_::import("numpy").attr("zeros");
    out[0] = zeros(n);
    out[3] = zeros(py::make_tuple(n, p));
  }
  const SimulationOutput output{electrical ? view(out[0]) : std::span<double>{}, view(out[1]), view(out[2]),
                                electrical ? view(out[3]) : std::span<double>{}, view(out[4]), view(out[5])};
  SimulationStatus status;
  {
    py::gil_scoped_release release;
    status = simulate(task, output);
  }
  return py::make_tuple(std::string(to_string(status)), out[0], out[1], out[2], out[3], out[4], out[5]);
}

}  // namespace

void bind_simulate(py::module_& m) {
  m.def("motor_parameter_table", [] { return describe_all(motor_parameters); }, "The motor's own parameters.");
  m.def("effect_table", &effect_table, "Every effect with its parameters, as the C++ table states them.");
  m.def("parameter_count", &parameter_count);
  m.def("first_coefficient", &first_coefficient);
  m.attr("max_order") = max_order;
  m.def("simulation_advice", [](const std::string& status) {
    return std::string(advice(status_of(status)));
  });
  m.def("simulate", &run, "kind"_a, "time"_a.noconvert(), "input"_a.noconvert(), "parameters"_a.noconvert(), "active"_a,
        "by"_a, "angle_per_position"_a = 1.0, "input_before"_a = 0.0, "angle"_a = Array(0),
        "angle_from_speed"_a = false, "restart_every"_a = 0, "restart_speed"_a = Array(0),
        "restart_position"_a = Array(0), "order"_a = 0, "own"_a = std::vector<OwnEffect>{},
        "work"_a = std::optional<Work*>{},
        "Returns status, current, speed, position (n) and their derivatives (n, p).");
}

}  // namespace rwn::bind
