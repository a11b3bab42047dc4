// Cycles that can only repeat the one before them: in the history, and not run.
#include "rwn/networks/online_training.hpp"

#include <gtest/gtest.h>

#include "rwn/networks/rates.hpp"
#include "structured_fixture.hpp"

namespace rwn {
namespace {

using testing::network;
using testing::Recording;

const StructuredMask kFriction{false, false, false, false, false, true, true, true, true};

/// Learns for some cycles and no longer; counts the cycles that are run.
struct Ending : StructuredRates {
  int left, run_cycles = 0;
  bool remembers;
  Ending(int learning, bool memory) : left(learning), remembers(memory) {}
  double train(StructuredRun& run, const StructuredSignals& signals) override {
    StructuredRateValues rates{};
    rates[kWeight] = left > 0 ? 1e-5 : 0.0;
    left -= left > 0;
    ++run_cycles;
    report.samples += static_cast<long>(signals.samples());
    return run.train(signals, rates.data());
  }
  StructuredRateValues rates() const override { return {}; }
  std::vector<double> memory() const override {
    return remembers ? std::vector<double>{double(run_cycles)} : std::vector<double>{};
  }
};

TEST(OnlineTraining, CyclesThatCanOnlyRepeatAreInTheHistoryAndNotRun) {
  const Recording r(300);
  Ending rests(3, false), counts(3, true);
  const auto rested = train(network(7, 1), r.signals(), rests, kFriction, {20, 5, false});
  const auto run = train(network(7, 1), r.signals(), counts, kFriction, {20, 5, false});
  EXPECT_EQ(rests.run_cycles, 4);    // three that learn, and the first that does not
  EXPECT_EQ(counts.run_cycles, 20);  // a rule that remembers another number after each cycle may yet change its mind
  EXPECT_EQ(rested.network.theta(), run.network.theta());
  EXPECT_EQ(rested.history.mse_learning, run.history.mse_learning);
  EXPECT_EQ(rested.history.mse_frozen, run.history.mse_frozen);
  EXPECT_EQ(rested.history.frozen_after, run.history.frozen_after);
  EXPECT_EQ(rested.history.parameters, run.history.parameters);
  EXPECT_EQ(rested.history.report.samples, run.history.report.samples);
  EXPECT_EQ(rested.history.status, run.history.status);
}

/// What the rule alone does in as many cycles, each run.
template <class Run, class Signals, class Rates>
std::vector<double> cycle_by_cycle(Run& run, const Signals& signals, Rates& rates, int cycles) {
  rates.prepare(run, signals);
  std::vector<double> mse;
  for (int n = 0; n < cycles; ++n) mse.push_back(rates.train(run, signals) / static_cast<double>(signals.samples()));
  return mse;
}

TEST(OnlineTraining, TheThesisRuleAtRestCountsTheSamplesOfCyclesThatAreNotRun) {
  const Recording r(300);
  StructuredNetwork net = network(7, 1);
  Vector theta = net.theta();
  theta.tail(7).setConstant(5.0);  // |c/d| beyond 1: the bounds have no meaning and nothing learns
  net = StructuredNetwork(theta, net.wavelet());
  const ThesisRates rule{};
  const auto skipped = rule.on(net, kFriction), each = rule.on(net, kFriction);
  const auto trained = train(net, r.signals(), *skipped, kFriction, {9, 0, false});
  StructuredRun run(net);
  EXPECT_EQ(trained.history.mse_learning, cycle_by_cycle(run, r.signals(), *each, 9));
  EXPECT_EQ(trained.network.theta(), theta);
  EXPECT_EQ(trained.history.status, OnlineStatus::stalled);
  EXPECT_EQ(trained.history.report.recurrent, each->report.recurrent);
  EXPECT_EQ(trained.history.report.recurrent, 9 * 299);
}

TEST(OnlineTraining, RunningMaximaThatStillRiseAreNoRest) {
  const Recording r(300);
  Vector x(300);
  x << r.speed.head(150), 3.0 * r.speed.tail(150);
  const StructuredNetwork net = network(7, 1);
  const auto rates = ThesisRates{}.on(net, kFriction);
  StructuredRun run(net);
  const auto before = rates->memory();
  rates->train(run, {r.input, r.speed});
  const auto once = rates->memory();
  rates->train(run, {r.input, x});
  EXPECT_NE(before, once);
  EXPECT_NE(once, rates->memory());
}

}  // namespace
}  // namespace rwn
