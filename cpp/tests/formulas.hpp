// Programs of formulas for tests.
#pragma once

#include <vector>

#include "rwn/model/formula.hpp"

namespace rwn {

inline Instruction number(double x) { return {Operation::number, x}; }
inline Instruction variable(Variable v) { return {Operation::variable, 0.0, static_cast<int>(v)}; }
inline Instruction own(int k) { return {Operation::parameter, 0.0, k}; }
inline Instruction op(Operation o) { return {o}; }

/// -k w |w|
inline std::vector<Instruction> drag() {
  return {own(0),
          op(Operation::negate),
          variable(Variable::speed),
          op(Operation::multiply),
          variable(Variable::speed),
          op(Operation::abs),
          op(Operation::multiply)};
}

/// p0 hat((v - 0.2) / 30) + p1 hat(sin(v / 40) / 0.7)
inline std::vector<Instruction> two_wavelets(Variable v) {
  return {own(0),
          variable(v),
          number(0.2),
          op(Operation::subtract),
          number(30.0),
          op(Operation::divide),
          op(Operation::mexican_hat),
          op(Operation::multiply),
          own(1),
          variable(v),
          number(40.0),
          op(Operation::divide),
          op(Operation::sin),
          number(0.7),
          op(Operation::divide),
          op(Operation::mexican_hat),
          op(Operation::multiply),
          op(Operation::add)};
}

}  // namespace rwn
