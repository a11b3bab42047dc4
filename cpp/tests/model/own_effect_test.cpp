#include "rwn/model/own_effect.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "allocations.hpp"
#include "formulas.hpp"
#include "rwn/simulate/unknown_inputs.hpp"
#include "rwn/simulate/simulate.hpp"

namespace rwn {
namespace {

/// A 24 V motor under a chirp, with own effects.
struct Case {
  std::vector<double> time, input, parameters;
  std::vector<int> active, by;
  std::vector<OwnEffect> effects;

  explicit Case(int samples = 400) {
    for (int k = 0; k < samples; ++k) {
      const double t = 1e-3 * k;
      time.push_back(t);
      input.push_back(12.0 * std::sin(2.0 * std::numbers::pi * (1.0 + 4.0 * t) * t));
    }
    parameters.assign(static_cast<std::size_t>(parameter_count()), 0.0);
    parameters[resistance] = 0.8;
    parameters[inductance] = 1.5e-3;
    parameters[torque_constant] = parameters[back_emf_constant] = 0.1;
    parameters[inertia] = 3e-4;
    parameters[viscous_friction] = 7e-5;
  }

  /// Switches a formula on, differentiated by its parameters.
  void add(Term term, std::vector<Instruction> program, const std::vector<double>& values) {
    const int slot = static_cast<int>(effects.size());
    effects.emplace_back(term, std::move(program), static_cast<int>(values.size()));
    active.push_back(effect_count + slot);
    const int first = first_own_parameter() + slot * max_own_parameters;
    for (std::size_t k = 0; k < values.size(); ++k) {
      by.push_back(first + static_cast<int>(k));
      parameters[static_cast<std::size_t>(by.back())] = values[k];
    }
  }

  SimulationTask task() const {
    SimulationTask t;
    t.time = time;
    t.input = input;
    t.parameters = parameters;
    t.active = active;
    t.by = by;
    t.own = effects;
    return t;
  }
};

struct Trajectory {
  SimulationStatus status;
  std::vector<double> signals;  // current, speed, position end to end
  std::vector<double> slopes;   // the same, each (n, p)
};

Trajectory run(const Case& c) {
  const std::size_t n = c.time.size(), p = c.by.size();
  Trajectory r{SimulationStatus::ok, std::vector<double>(3 * n), std::vector<double>(3 * n * p)};
  const std::span<double> y(r.signals), d(r.slopes);
  r.status = simulate(c.task(), {y.subspan(0, n), y.subspan(n, n), y.subspan(2 * n, n), d.subspan(0, n * p),
                                 d.subspan(n * p, n * p), d.subspan(2 * n * p, n * p)});
  return r;
}

/// p0 tanh(v / p1) for a variable v, plus `level`.
std::vector<Instruction> step_over(Variable v, double level) {
  return {own(0),        variable(v),       own(1), op(Operation::divide), op(Operation::tanh), op(Operation::multiply),
          number(level), op(Operation::add)};
}

template <class E, std::size_t... I>
int index_of(std::index_sequence<I...>) {
  return ((std::is_same_v<E, std::tuple_element_t<I, Effects>> ? static_cast<int>(I) : 0) + ...);
}

void expect_slopes(const Case& c) {
  const Trajectory r = run(c);
  ASSERT_EQ(r.status, SimulationStatus::ok);
  const std::size_t p = c.by.size();
  for (std::size_t j = 0; j < p; ++j) {
    const auto index = static_cast<std::size_t>(c.by[j]);
    const double nudge = 1e-6 * std::abs(c.parameters[index]);
    Case up = c, down = c;
    up.parameters[index] += nudge;
    down.parameters[index] -= nudge;
    const std::vector<double> high = run(up).signals, low = run(down).signals;
    double error = 0.0, size = 0.0;
    for (std::size_t k = 0; k < high.size(); ++k) {
      const double difference = (high[k] - low[k]) / (2.0 * nudge);
      error += std::pow(difference - r.slopes[k * p + j], 2);
      size += difference * difference;
    }
    EXPECT_GT(size, 0.0) << "parameter " << index << " acts on nothing";
    EXPECT_LE(std::sqrt(error), 2e-4 * std::sqrt(size)) << "parameter " << index;
  }
}

TEST(OwnEffect, TooManyParametersAreRefused) {
  const std::vector<Instruction> one{number(1.0)};
  EXPECT_THROW(OwnEffect(Term::torque, one, max_own_parameters + 1), std::invalid_argument);
}

TEST(OwnEffect, AFormulaOfABuiltInEffectRunsAsThatOne) {
  Case built_in;
  const int index = index_of<QuadraticDrag>(std::make_index_sequence<effect_count>{});
  built_in.active = {index};
  built_in.by = {first_parameter(index)};
  built_in.parameters[static_cast<std::size_t>(first_parameter(index))] = 1e-5;
  Case mine;
  mine.add(Term::torque, drag(), {1e-5});
  const Trajectory a = run(built_in), b = run(mine);
  double largest = 0.0;
  for (double y : a.signals) largest = std::max(largest, std::abs(y));
  // an own effect asks for shorter steps where its formula bends, so that they agree to what a step of 1 ms is worth
  for (std::size_t k = 0; k < a.signals.size(); ++k) EXPECT_NEAR(a.signals[k], b.signals[k], 1e-6 * largest);
}

TEST(OwnEffect, SlopesOfEveryTermAgreeWithCentralDifferences) {
  const auto expect = [](Term term, Variable v, double amplitude, double scale, double level) {
    SCOPED_TRACE(term_names[static_cast<std::size_t>(term)]);
    Case c;
    c.add(term, step_over(v, level), {amplitude, scale});
    expect_slopes(c);
  };
  expect(Term::torque, Variable::speed, -0.02, 30.0, 0.0);
  expect(Term::torque, Variable::position, -0.02, 1.0, 0.0);
  expect(Term::load, Variable::time, -0.02, 0.1, 0.0);
  expect(Term::friction, Variable::speed, 0.01, 40.0, 0.02);
  expect(Term::drop, Variable::current, 0.5, 1.0, 0.0);
  expect(Term::resistance, Variable::current, 0.3, 4.0, 1.0);
  expect(Term::flux, Variable::current, 0.2, 4.0, 1.0);
  expect(Term::inductance, Variable::current, 0.3, 4.0, 1.0);
  expect(Term::input, Variable::input, 10.0, 9.0, 0.0);
  expect(Term::input, Variable::current, -1.0, 3.0, 4.0);
  expect(Term::current, Variable::drive_torque, 1.0, 0.4, 0.0);
  expect(Term::speed, Variable::speed, 80.0, 90.0, 0.0);
  expect(Term::position, Variable::position, 1.0, 2.0, 0.0);
}

TEST(OwnEffect, SlopesOfWavelets) {
  for (Variable v : {Variable::speed, Variable::position}) {
    Case c;
    c.add(Term::torque, two_wavelets(v), {0.02, -0.03});
    expect_slopes(c);
  }
}

TEST(OwnEffect, FrictionOfItsOwnHoldsAtStandstill) {
  Case c;
  c.add(Term::friction, {own(0)}, {0.02});
  for (double& v : c.input) v = 0.1;  // 0.0125 N m at stall, below 0.02
  const Trajectory r = run(c);
  for (std::size_t k = 0; k < c.time.size(); ++k) EXPECT_EQ(r.signals[c.time.size() + k], 0.0);
}

TEST(OwnEffect, AFormulaWithoutAValueIsAStatus) {
  for (Term term : {Term::torque, Term::drop, Term::inductance, Term::input, Term::speed}) {
    SCOPED_TRACE(term_names[static_cast<std::size_t>(term)]);
    Case c;
    const Variable v = term == Term::input ? Variable::input : Variable::speed;
    c.add(term, {own(0), variable(v), op(Operation::sqrt), op(Operation::multiply)}, {0.01});
    const Trajectory r = run(c);
    EXPECT_EQ(r.status, SimulationStatus::formula_failed);
    for (double y : r.signals) EXPECT_TRUE(std::isfinite(y));
    for (double y : r.slopes) EXPECT_TRUE(std::isfinite(y));
  }
  EXPECT_NE(advice(SimulationStatus::formula_failed), advice(SimulationStatus::diverged));
}

TEST(OwnEffect, ASlopeWithoutAValueIsZero) {
  Case c;  // a root at rest
  c.add(Term::torque,
        {own(0), variable(Variable::speed), op(Operation::abs), number(0.5), op(Operation::power),
         op(Operation::multiply)},
        {-1e-3});
  const Trajectory r = run(c);
  EXPECT_EQ(r.status, SimulationStatus::ok);
  for (double y : r.slopes) EXPECT_TRUE(std::isfinite(y));
}

TEST(OwnEffect, SeveralActAtOnce) {
  Case both;
  both.add(Term::friction, {own(0)}, {0.01});
  both.add(Term::torque, drag(), {1e-5});
  Case one;
  one.add(Term::torque,
          {own(0), op(Operation::negate), variable(Variable::speed), op(Operation::multiply), variable(Variable::speed),
           op(Operation::abs), op(Operation::multiply), own(1), variable(Variable::direction), op(Operation::multiply),
           op(Operation::subtract)},
          {1e-5, 0.0});
  one.parameters[coulomb_friction] = 0.01;
  const Trajectory a = run(both), b = run(one);
  for (std::size_t k = 0; k < a.signals.size(); ++k) EXPECT_NEAR(a.signals[k], b.signals[k], 1e-9);
}

TEST(OwnEffect, AllocationsDoNotGrowWithTheRecording) {
  const auto count = [](int samples) {
    Case c(samples);
    c.add(Term::torque, drag(), {1e-5});
    c.add(Term::speed, step_over(Variable::speed, 0.0), {80.0, 90.0});
    std::vector<double> speed(c.time.size()), slopes(3 * c.time.size());
    const SimulationTask task = c.task();
    const auto before = testing::allocations();
    simulate(task, {{}, speed, {}, {}, slopes, {}});
    return testing::allocations() - before;
  };
  EXPECT_EQ(count(400), count(4000));
}

TEST(OwnEffect, IsNoUnknownTorque) {
  Case c;
  c.add(Term::torque, drag(), {1e-5});
  c.time = {0.0, 1.0};
  c.input = {0.0, 0.0};
  SimulationTask axis = c.task();
  axis.drive = drive_of("axis");
  const std::vector<double> position{0.0, 0.0}, speed{10.0, -10.0}, acceleration{0.0, 0.0};
  std::vector<double> torque(2);
  unknown_inputs(axis, {{}, {}, speed, position, acceleration}, torque, {});
  EXPECT_NEAR(torque[0], 7e-4 + 1e-3, 1e-15);  // what keeps it turning
  EXPECT_NEAR(torque[1], -7e-4 - 1e-3, 1e-15);
}

TEST(OwnEffect, TransferFunctionsHaveNoPlaceForIt) {
  Case c;
  c.add(Term::torque, drag(), {1e-5});
  SimulationTask task = c.task();
  task.drive = drive_of("lti");
  task.order = 1;
  EXPECT_THROW(simulate(task, {}), std::invalid_argument);
}

}  // namespace
}  // namespace rwn
