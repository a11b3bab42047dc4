#include "rwn/own_effect.hpp"

#include <stdexcept>

namespace rwn {

OwnEffect::OwnEffect(Term t, std::vector<Instruction> steps, int parameters) : term(t), program(std::move(steps)) {
  if (parameters > max_own_parameters) throw std::invalid_argument("own effect: too many parameters");
  check_formula(program, parameters);
}

bool OwnEffect::varies() const {
  if (!is_torque(term)) return !is_sensor(term) && term != Term::input;
  return std::any_of(program.begin(), program.end(), [](const Instruction& step) {
    return step.operation == Operation::variable && step.place != static_cast<int>(Variable::direction);
  });
}

}  // namespace rwn
