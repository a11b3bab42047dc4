#include "rwn/model/formula.hpp"

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

int taken(Operation operation) {
  if (pushes(operation) || operation == Operation::wavelet_sum) return 0;
  return takes_two(operation) ? 2 : 1;
}

constexpr int nothing = -1, several = -2;  // what a value depends on, other than one variable

int joined(int a, int b) { return a == nothing || a == b ? b : b == nothing ? a : several; }

/// Where the steps that give a value begin, and the variable that it depends on.
struct Value {
  std::size_t begin = 0;
  int on = nothing;
};

int source(const Instruction& step, std::span<const WaveletSum> sums) {
  if (step.operation == Operation::wavelet_sum) {
    const WaveletSum& sum = sums[static_cast<std::size_t>(step.place)];
    return sum.numeric() ? sum.over : several;
  }
  return step.operation == Operation::number ? nothing : step.operation == Operation::variable ? step.place : several;
}

/// What every step leaves on top of the stack.
std::vector<Value> values_of(std::span<const Instruction> program, std::span<const WaveletSum> sums) {
  std::vector<Value> values, stack;
  for (std::size_t k = 0; k < program.size(); ++k) {
    Value value{k, taken(program[k].operation) == 0 ? source(program[k], sums) : nothing};
    for (int n = taken(program[k].operation); n > 0; --n) {
      value = {stack.back().begin, joined(stack.back().on, value.on)};
      stack.pop_back();
    }
    stack.push_back(value);
    values.push_back(value);
  }
  return values;
}

}  // namespace

void check_formula(std::span<const Instruction> program, int parameters) {
  int depth = 0;
  for (const Instruction& step : program) {
    require(step.place >= 0 && step.place < places(step.operation, parameters), "formula: no such value");
    require(step.operation < Operation::curve, "formula: curves and sums are found, not given");
    require(depth >= taken(step.operation), "formula: an operation lacks its values");
    depth += 1 - taken(step.operation);
    require(depth <= formula_depth, "formula: too deep for the stack");
  }
  require(depth == 1, "formula: a program leaves one value");
}

Formula::Formula(std::span<const Instruction> program) : steps(with_sums(program, sums)) {
  steps = with_curves(steps, sums);
}

std::vector<Instruction> with_curves(std::span<const Instruction> program, std::span<const WaveletSum> sums) {
  const std::vector<Value> values = values_of(program, sums);
  std::vector<Instruction> reversed;
  for (std::size_t k = program.size(); k-- > 0;) {
    reversed.push_back(program[k]);
    const auto [begin, on] = values[k];
    if (on < 0 || begin == k) continue;
    const auto length = static_cast<double>(k + 1 - begin);
    while (k > begin) reversed.push_back(program[--k]);
    reversed.push_back({Operation::curve, length, on});
  }
  return {reversed.rbegin(), reversed.rend()};
}

}  // namespace rwn
