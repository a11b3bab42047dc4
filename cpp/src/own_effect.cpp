#include "rwn/own_effect.hpp"

#include <stdexcept>

namespace rwn {

OwnEffect::OwnEffect(Term t, std::vector<Instruction> steps, int count)
    : term(t), program(std::move(steps)), parameters(count) {
  if (parameters > max_own_parameters) throw std::invalid_argument("own effect: too many parameters");
  check_formula(program, parameters);
  program = with_curves(program);
}

bool OwnEffect::varies() const {
  if (!is_torque(term)) return !is_sensor(term) && term != Term::input;
  return std::any_of(program.begin(), program.end(), [](const Instruction& step) {
    return step.operation == Operation::variable && step.place != static_cast<int>(Variable::direction);
  });
}

OwnProgram OwnEffect::plain() const {
  return {term, program.data(), static_cast<int>(program.size()), parameters, varies()};
}

}  // namespace rwn
