#include "rwn/model/own_effect.hpp"

#include <algorithm>
#include <stdexcept>

namespace rwn {
namespace {

std::span<const Instruction> checked(std::span<const Instruction> program, int parameters) {
  if (parameters > max_own_parameters) throw std::invalid_argument("own effect: too many parameters");
  check_formula(program, parameters);
  return program;
}

/// Whether a step brings the motion in, other than the direction of sliding.
bool moves(const Instruction& step) {
  const bool variable = step.operation == Operation::variable && step.place != static_cast<int>(Variable::direction);
  return variable || step.operation == Operation::wavelet_sum;
}

}  // namespace

OwnEffect::OwnEffect(Term t, std::span<const Instruction> program, int count)
    : term(t), formula(checked(program, count)), parameters(count) {}

bool OwnEffect::varies() const {
  if (!is_torque(term)) return !is_sensor(term) && term != Term::input;
  return std::any_of(formula.steps.begin(), formula.steps.end(), moves);
}

OwnProgram OwnEffect::plain() const { return {term, formula.plain(), parameters, varies()}; }

}  // namespace rwn
