// Tasks whose lengths or indices do not fit are refused, each for its own reason, before anything is written.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "effect_index.hpp"
#include "formulas.hpp"
#include "rwn/simulate/simulate.hpp"
#include "rwn/simulate/transfer_function.hpp"
#include "rwn/simulate/unknown_inputs.hpp"

namespace rwn {
namespace {

constexpr std::size_t samples = 10;

/// A run of a small motor, and a motion that it is given; every array has a value for each sample.
struct Case {
  std::vector<double> time, input = std::vector<double>(samples, 6.0), input_time, angle, restart_speed,
                            restart_position;
  std::vector<double> parameters = std::vector<double>(static_cast<std::size_t>(parameter_count()), 0.0);
  std::vector<int> active, by;
  std::vector<double> speed = std::vector<double>(samples, 0.0), d_speed;
  std::vector<OwnEffect> own;
  int drive = drive_of("dc"), restart_every = 0, order = 0;
  std::vector<double> current, current_slope, given = std::vector<double>(samples, 0.0), torque = given, voltage;

  Case() {
    for (std::size_t k = 0; k < samples; ++k) time.push_back(1e-3 * static_cast<double>(k));
    parameters[resistance] = 0.8;
    parameters[inductance] = 1.5e-3;
    parameters[torque_constant] = parameters[back_emf_constant] = 0.1;
    parameters[inertia] = 3e-4;
  }

  SimulationTask task() const {
    SimulationTask t;
    t.drive = drive;
    t.time = time;
    t.input = input;
    t.input_time = input_time;
    t.parameters = parameters;
    t.active = active;
    t.by = by;
    t.angle = angle;
    t.restart_every = restart_every;
    t.restart_speed = restart_speed;
    t.restart_position = restart_position;
    t.order = order;
    t.own = own;
    return t;
  }
  SimulationStatus run() { return simulate(task(), {{}, speed, {}, {}, d_speed, {}}); }
  void look() { unknown_inputs(task(), {current, current_slope, given, given, given}, torque, voltage); }
};

/// The reason for which `call` is refused; empty where it is not.
std::string reason(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::invalid_argument& refused) {
    return refused.what();
  }
  return "";
}

using Change = std::function<void(Case&)>;

/// Expects that `call` is refused after each change with these words in the reason; not refused where there are none.
void expect_reasons(const std::vector<std::pair<Change, std::string>>& changes, const Change& call) {
  for (std::size_t k = 0; k < changes.size(); ++k) {
    Case c;
    changes[k].first(c);
    const std::string said = reason([&] { call(c); });
    if (changes[k].second.empty()) {
      EXPECT_EQ(said, "") << k;
    } else {
      EXPECT_NE(said.find(changes[k].second), std::string::npos) << k << ": " << said;
    }
  }
}

TEST(Simulation, TasksThatDoNotFitAreRefusedForTheirReason) {
  const std::vector<std::pair<Change, std::string>> changes{
      {[](Case&) {}, ""},
      {[](Case& c) { c.drive = -1; }, "no such kind of drive"},
      {[](Case& c) { c.drive = drive_count; }, "no such kind of drive"},
      {[](Case& c) { c.time.resize(1); }, "at least two samples"},
      {[](Case& c) { c.input.pop_back(); }, "the input and its instants"},
      {[](Case& c) { c.input_time = {0.0, 5e-3}; }, "the input and its instants"},
      {[](Case& c) { c.input_time = {0.0, 5e-3}, c.input.resize(2); }, ""},
      {[](Case& c) { c.angle.resize(samples - 1); }, "time and angle"},
      {[](Case& c) { c.angle.resize(samples); }, ""},
      {[](Case& c) { c.restart_every = -1; }, "windows need"},
      {[](Case& c) { c.restart_every = 4; }, "windows need"},
      {[](Case& c) { c.restart_every = 4, c.restart_speed = c.given; }, "windows need"},
      {[](Case& c) { c.restart_every = 4, c.restart_speed = c.restart_position = c.given; }, ""},
      {[](Case& c) { c.parameters.pop_back(); }, "wrong number of parameters"},
      {[](Case& c) { c.drive = drive_of("lti"); }, "order out of range"},
      {[](Case& c) { c.drive = drive_of("lti"), c.order = max_order + 1; }, "order out of range"},
      {[](Case& c) { c.active.resize(9); }, "too many effects at once"},
      {[](Case& c) { c.active = {-1}; }, "no such effect"},
      {[](Case& c) { c.active = {effect_count}; }, "no such effect"},
      {[](Case& c) { c.active = {effect_index("supply-sag")}; }, ""},
      {[](Case& c) { c.drive = drive_of("axis"), c.active = {effect_index("supply-sag")}; }, "no term for an effect"},
      {[](Case& c) { c.drive = drive_of("axis"), c.active = {effect_index("coulomb-friction")}; }, ""},
      {[](Case& c) { c.own.emplace_back(Term::drop, drag(), 1), c.active = {effect_count}; }, ""},
      {[](Case& c) {
         c.drive = drive_of("axis");
         c.own.emplace_back(Term::drop, drag(), 1);
         c.active = {effect_count};
       },
       "no term for an effect"},
      {[](Case& c) { c.drive = drive_of("lti"), c.order = 1, c.active = {effect_index("constant-load")}; },
       "no term for an effect"},
      {[](Case& c) { c.by = {-1}; }, "no such parameter"},
      {[](Case& c) { c.by = {parameter_count()}; }, "no such parameter"},
      {[](Case& c) { c.speed.pop_back(); }, "an output differs in length"},
      {[](Case& c) { c.by = {inertia}, c.d_speed.resize(samples + 1); }, "derivatives must be"},
      {[](Case& c) { c.by = {inertia}, c.d_speed.resize(samples); }, ""},
  };
  expect_reasons(changes, [](Case& c) { c.run(); });
}

TEST(UnknownInputs, MotionsThatDoNotFitAreRefusedForTheirReason) {
  const std::vector<std::pair<Change, std::string>> changes{
      {[](Case&) {}, ""},
      {[](Case& c) { c.time.clear(), c.input.clear(), c.given.clear(), c.torque.clear(); }, "the signals differ"},
      {[](Case& c) { c.input.pop_back(); }, "the signals differ"},
      {[](Case& c) { c.input_time = {0.0}; }, "the signals differ"},
      {[](Case& c) { c.given.pop_back(); }, "the signals differ"},
      {[](Case& c) { c.torque.pop_back(); }, "the signals differ"},
      {[](Case& c) { c.current = c.given; }, "the current and its slope"},
      {[](Case& c) { c.current.resize(4), c.current_slope.resize(4); }, "the current and its slope"},
      {[](Case& c) { c.current = c.current_slope = c.given; }, ""},
      {[](Case& c) { c.voltage.resize(4); }, "voltage differs"},
      {[](Case& c) { c.voltage.resize(samples); }, ""},
      {[](Case& c) { c.parameters.pop_back(); }, "wrong number of parameters"},
      {[](Case& c) { c.drive = drive_of("lti"); }, "no equations of motion"},
  };
  expect_reasons(changes, [](Case& c) { c.look(); });
}

TEST(UnknownInputs, EachOfTheThreeSignalsOfAMotionHasItsLength) {
  Case c;
  const std::vector<double> full(samples, 0.0), cut(samples - 1, 0.0);
  const auto look = [&](const std::vector<double>& w, const std::vector<double>& q, const std::vector<double>& a) {
    return reason([&] { unknown_inputs(c.task(), {{}, {}, w, q, a}, c.torque, {}); });
  };
  EXPECT_EQ(look(full, full, full), "");
  EXPECT_NE(look(cut, full, full), "");
  EXPECT_NE(look(full, cut, full), "");
  EXPECT_NE(look(full, full, cut), "");
}

TEST(UnknownInputs, AFormulaWithoutAValueGivesNoNumber) {
  Case c;  // log(speed) at rest
  c.own.push_back({Term::torque, std::vector<Instruction>{{Operation::variable, 0.0, static_cast<int>(Variable::speed)},
                                                          {Operation::log, 0.0, 0}}, 0});
  c.active = {effect_count};
  c.voltage.resize(samples);
  c.look();
  for (std::size_t k = 0; k < samples; ++k) {
    EXPECT_TRUE(std::isnan(c.torque[k]));
    EXPECT_TRUE(std::isnan(c.voltage[k]));
  }
}

}  // namespace
}  // namespace rwn
