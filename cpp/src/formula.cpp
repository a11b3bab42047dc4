#include "rwn/formula.hpp"

#include <stdexcept>

namespace rwn {
namespace {

void require(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(message);
}

int places(Operation operation, int parameters) {
  switch (operation) {
    case Operation::variable:
      return static_cast<int>(std::size(variable_names));
    case Operation::nominal:
      return motor_parameter_count;
    case Operation::parameter:
      return parameters;
    default:
      return 1;
  }
}

}  // namespace

void check_formula(std::span<const Instruction> program, int parameters) {
  int depth = 0;
  for (const Instruction& step : program) {
    require(step.place >= 0 && step.place < places(step.operation, parameters), "formula: no such value");
    const int taken = pushes(step.operation) ? 0 : takes_two(step.operation) ? 2 : 1;
    require(depth >= taken, "formula: an operation lacks its values");
    depth += 1 - taken;
    require(depth <= formula_depth, "formula: too deep for the stack");
  }
  require(depth == 1, "formula: a program leaves one value");
}

}  // namespace rwn
