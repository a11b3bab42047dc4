// What a run came to has a word and advice, and a run that left the numbers returns what it met before.
#include <gtest/gtest.h>

#include <initializer_list>
#include <limits>
#include <set>
#include <string_view>

#include "conventional_fixture.hpp"
#include "rwn/networks/online_training.hpp"
#include "rwn/networks/trainers/structured_levenberg_marquardt.hpp"
#include "rwn/networks/training.hpp"

namespace rwn {
namespace {

template <class Status>
void expect_words(std::initializer_list<Status> all) {
  std::set<std::string_view> words, advices;
  for (const Status status : all) {
    words.insert(to_string(status));
    advices.insert(advice(status));
    EXPECT_EQ(advice(status).back(), '.');
  }
  EXPECT_EQ(words.size(), all.size());
  EXPECT_EQ(advices.size(), all.size());
}

TEST(Status, EachHasItsWordAndItsAdvice) {
  expect_words({OnlineStatus::stalled, OnlineStatus::unstable, OnlineStatus::diverged, OnlineStatus::completed});
  expect_words({FitStatus::converged, FitStatus::stuck, FitStatus::iteration_limit});
  expect_words(
      {TrainingStatus::converged, TrainingStatus::stalled, TrainingStatus::diverged, TrainingStatus::iteration_limit});
}

TEST(Watch, ARunThatLeavesTheNumbersReturnsTheBestThatItMet) {
  const ConventionalShape shape{.inputs = 1, .wavelets = 1, .outputs = 1};
  const ConventionalNetwork start = testing::random_network(Wavelet(), shape, 1);
  std::mt19937 random(2);
  const RowMatrix x = testing::random_matrix(9, 1, random);
  const Patterns patterns(x, x);
  for (const bool met : {false, true}) {
    Watch watch(1.0, 0.0, 0.0, 3);
    Eigen::VectorXd best = start.parameters(), lost = start.parameters();
    best[0] = 0.25;
    if (met) {
      EXPECT_FALSE(watch.stop(2.0, best));
    }
    lost[0] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(watch.stop(1.0, lost));
    EXPECT_EQ(watch.status, TrainingStatus::diverged);
    const Training done = watch.finish(start, patterns);
    EXPECT_EQ(done.network.parameters()[0], met ? 0.25 : start.parameters()[0]);
  }
}

}  // namespace
}  // namespace rwn
