#include "rwn/model/formula.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <vector>

#include "formulas.hpp"

namespace rwn {
namespace {

using S = Dual<4, struct Plain>;
using Steps = std::vector<Instruction>;

/// Value at speed 11 and current 0.7 with parameters 0.5 and 2, by these, speed and current.
S value(const Program& program) {
  const std::array<S, 2> p{S::variable(0.5, 0), S::variable(2.0, 1)};
  Motion<S> x;
  x.speed = S::variable(11.0, 2);
  x.current = S::variable(0.7, 3);
  std::array<S, formula_depth> stack;
  return evaluate(program, p.data(), Motor<S>{}, x, stack.data());
}

S value(const Steps& steps) { return value({steps.data(), static_cast<int>(steps.size()), nullptr}); }

auto count(const Steps& steps, Operation operation) {
  return std::count_if(steps.begin(), steps.end(), [&](auto& step) { return step.operation == operation; });
}

void append(Steps& steps, std::initializer_list<Instruction> more) { steps.insert(steps.end(), more); }

void expect_equal(const S& a, const S& b) {
  EXPECT_NEAR(a.v, b.v, 1e-14);
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(a.d[k], b.d[k], 1e-14);
}

TEST(Formula, ProgramsThatDoNotWorkOutAreRefused) {
  const auto refused = [](const std::vector<Instruction>& program) {
    EXPECT_THROW(check_formula(program, 1), std::invalid_argument);
  };
  refused({});
  refused({number(1.0), number(2.0)});
  refused({op(Operation::add)});
  refused({own(1)});
  refused({own(-1)});
  refused({variable(static_cast<Variable>(7))});
  refused(std::vector<Instruction>(formula_depth + 1, number(1.0)));
}

TEST(Formula, OperationsOfTwoTakeTheirValueAndItsSlopes) {
  const S w = S::variable(11.0, 2), i = S::variable(0.7, 3);
  const auto of = [](Steps left, const Steps& right, Operation operation) {
    left.insert(left.end(), right.begin(), right.end());
    left.push_back(op(operation));
    return value(left);
  };
  const Steps speed{variable(Variable::speed)}, current{variable(Variable::current)}, two{number(2.0)},
      three{number(3.0)};
  const Steps lost{number(-1.0), op(Operation::log)};  // not a number
  expect_equal(of(speed, current, Operation::min), i);
  expect_equal(of(current, speed, Operation::min), i);
  expect_equal(of(speed, current, Operation::max), w);
  expect_equal(of(current, speed, Operation::max), w);
  expect_equal(of(speed, current, Operation::multiply), w * i);
  expect_equal(of(speed, two, Operation::power), w * w);
  expect_equal(of(speed, three, Operation::power), w * w * w);
  for (const Operation operation : {Operation::min, Operation::max}) {
    EXPECT_TRUE(std::isnan(of(speed, lost, operation).v));
    EXPECT_TRUE(std::isnan(of(lost, speed, operation).v));
  }
  Steps exponent{variable(Variable::speed), own(1), op(Operation::power)};  // an exponent of 2 that has a slope
  EXPECT_NEAR(value(exponent).v, 121.0, 1e-12);
  EXPECT_NEAR(value(exponent).d[1], 121.0 * std::log(11.0), 1e-10);
  EXPECT_NEAR(value(exponent).d[2], 22.0, 1e-12);
}

TEST(Formula, SignsAndDirectionsGoBothWays) {
  for (const double speed : {-3.0, 0.0, 3.0}) {
    const double sign = (speed > 0.0) - (speed < 0.0);
    Motion<double> x;
    x.speed = speed;
    x.direction = 0.0;  // nobody keeps it
    EXPECT_EQ(direction_of(x), sign);
    x.direction = -1.0;  // kept by dry friction
    EXPECT_EQ(direction_of(x), -1.0);
    EXPECT_EQ(value({number(speed), op(Operation::sign)}).v, sign);
    EXPECT_EQ(value({number(speed), op(Operation::abs)}).v, std::abs(speed));
  }
  EXPECT_TRUE(std::isnan(value({number(-1.0), op(Operation::log), op(Operation::sign)}).v));
}

TEST(Formula, CurvesAreAnnouncedAndChangeNothing) {
  Steps mixed = two_wavelets(Variable::speed);  // beside a product of two variables, which is no curve
  append(mixed, {variable(Variable::speed), variable(Variable::current), op(Operation::multiply), op(Operation::add)});
  const Steps announced = with_curves(mixed);
  EXPECT_EQ(count(announced, Operation::curve), 2);
  EXPECT_EQ(announced.size(), mixed.size() + 2);
  expect_equal(value(mixed), value(announced));
  EXPECT_EQ(count(with_curves(drag()), Operation::curve), 1);  // |w|: the other w stands beside a parameter
  EXPECT_EQ(count(with_curves(Steps{number(1.0)}), Operation::curve), 0);
  EXPECT_THROW(check_formula(announced, 2), std::invalid_argument);
}

/// hat((s v + c) / d)
Steps hat(Variable v, double s, double c, double d) {
  return {number(s), variable(v), op(Operation::multiply), number(c), op(Operation::add),
          number(d), op(Operation::divide), op(Operation::mexican_hat)};
}

/// The sum of `count` hats over the speed, or their difference, with weights (a number, its negative) or parameter 0.
Steps network(int count, Operation joint, bool own_weights) {
  Steps steps;
  for (int k = 0; k < count; ++k) {
    steps.push_back(own_weights ? own(0) : number(0.3 - 0.1 * k));
    if (k % 2 == 1) steps.push_back(op(Operation::negate));
    for (const Instruction& step : hat(Variable::speed, 0.1, -0.2 * k, 0.7)) steps.push_back(step);
    steps.push_back(op(Operation::multiply));
    if (k > 0) steps.push_back(op(joint));
  }
  return steps;
}

TEST(Formula, SumsOfWaveletsAreOneStepAndChangeNothing) {
  for (const Operation joint : {Operation::add, Operation::subtract}) {
    const Steps steps = network(13, joint, false);
    const Formula formula(steps);
    EXPECT_EQ(formula.steps.size(), 1U);
    expect_equal(value(steps), value(formula.plain()));
  }
}

TEST(Formula, WeightsOfASumMayBeParameters) {
  const Steps steps = network(5, Operation::add, true);
  const Formula formula(steps);
  EXPECT_EQ(formula.steps.size(), 1U);
  expect_equal(value(steps), value(formula.plain()));
  const Steps wave = two_wavelets(Variable::speed);  // over the speed, and over its sine
  const Formula two(wave);
  EXPECT_EQ(two.sums.size(), 2U);
  expect_equal(value(wave), value(two.plain()));
}

TEST(Formula, WhatIsNoSumOfWaveletsStaysAsItIs) {
  const auto expect = [](Steps steps, std::size_t sums) {
    const Formula formula(steps);
    EXPECT_EQ(formula.sums.size(), sums);
    expect_equal(value(steps), value(formula.plain()));
  };
  const Steps one = hat(Variable::speed, 0.1, -0.2, 0.7), other = hat(Variable::current, 0.4, 0.1, 0.7);
  const auto both = [&](Operation operation) {
    Steps steps = one;
    steps.insert(steps.end(), other.begin(), other.end());
    steps.push_back(op(operation));
    return steps;
  };
  expect(both(Operation::add), 2);
  expect(both(Operation::multiply), 2);
  expect(both(Operation::max), 2);
  Steps steps{number(2.0)};  // 2 - hat
  steps.insert(steps.end(), one.begin(), one.end());
  steps.push_back(op(Operation::subtract));
  expect(steps, 1);
  steps = one;  // hat / 0.5, negated, times a parameter, and times another
  append(steps, {number(0.5), op(Operation::divide), op(Operation::negate), own(0), op(Operation::multiply), own(1),
                 op(Operation::multiply)});
  expect(steps, 1);
  steps = one;  // hat tanh(v)
  append(steps, {variable(Variable::speed), op(Operation::tanh), op(Operation::multiply)});
  expect(steps, 1);
  expect({variable(Variable::speed), own(0), op(Operation::multiply), op(Operation::mexican_hat)}, 0);
  expect(network(max_wavelets + 3, Operation::add, false), 4);  // the rest one by one
}

}  // namespace
}  // namespace rwn
