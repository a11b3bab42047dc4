#include "bind.hpp"
#include "rwn/simulate/active_effects.hpp"
#include "rwn/model/own_effect.hpp"
#include "rwn/simulate/simulate.hpp"

namespace rwn::bind {
namespace {

using Step = std::tuple<std::string, double, int>;  // operation, number, place

template <class Enum, std::size_t n>
Enum find(const std::string_view (&names)[n], std::string_view name) {
  const auto* found = std::find(std::begin(names), std::end(names), name);
  if (found == std::end(names)) throw std::invalid_argument("own effect: no such word as " + std::string(name));
  return static_cast<Enum>(found - std::begin(names));
}

template <std::size_t n>
std::vector<std::string> words(const std::string_view (&names)[n]) {
  return {std::begin(names), std::end(names)};
}

OwnEffect make(const std::string& term, const std::vector<Step>& steps, int parameters) {
  std::vector<Instruction> program;
  for (const auto& [operation, number, place] : steps) {
    program.push_back({find<Operation>(operation_names, operation), number, place});
  }
  return {find<Term>(term_names, term), program, parameters};
}

/// Value of the formula and its derivatives by the own parameters, at one state.
std::pair<double, std::array<double, max_own_parameters>> evaluate_formula(
    const OwnEffect& effect, const std::array<double, std::size(variable_names)>& variables,
    const std::array<double, motor_parameter_count>& nominal,
    const std::array<double, max_own_parameters>& parameters) {
  struct Plain {};
  using S = Dual<max_own_parameters, Plain>;
  const auto at = [&](Variable v) { return variables[static_cast<std::size_t>(v)]; };
  Motion<S> x;
  x.time = at(Variable::time);
  x.direction = at(Variable::direction);
  x.input = at(Variable::input);
  x.current = at(Variable::current);
  x.speed = at(Variable::speed);
  x.angle = at(Variable::position);
  x.drive_torque = at(Variable::drive_torque);
  Motor<S> motor;
  for (std::size_t k = 0; k < motor.size(); ++k) motor[k] = nominal[k];
  std::array<S, max_own_parameters> p;
  for (std::size_t k = 0; k < p.size(); ++k) p[k] = S::variable(parameters[k], static_cast<int>(k));
  std::array<S, formula_depth> stack;
  const S y = evaluate(effect.formula.plain(), static_cast<const S*>(p.data()), motor, x, stack.data());
  std::array<double, max_own_parameters> slopes;
  for (std::size_t k = 0; k < slopes.size(); ++k) slopes[k] = y.d[static_cast<int>(k)];
  return {y.v, slopes};
}

}  // namespace

void bind_own_effect(py::module_& m) {
  py::class_<OwnEffect>(m, "OwnEffect", "A user's effect: the term that it changes and the program of its formula.")
      .def(py::init(&make), "term"_a, "program"_a, "parameters"_a)
      .def("evaluate", &evaluate_formula, "variables"_a, "nominal"_a, "parameters"_a,
           "Value, and derivatives by its parameters.");
  m.attr("max_own_effects") = max_own_effects;
  m.attr("max_active_effects") = max_active_effects;
  m.attr("max_own_parameters") = max_own_parameters;
  m.attr("formula_depth") = formula_depth;
  m.def("first_own_parameter", &first_own_parameter);
  m.def("formula_words", [] {
    return py::dict("operations"_a = words(operation_names), "variables"_a = words(variable_names),
                    "terms"_a = words(term_names));
  });
}

}  // namespace rwn::bind
