#include "rwn/simulate/speed_measurement.hpp"

#include <gtest/gtest.h>

#include <array>

namespace rwn {
namespace {

constexpr std::array time{0.0, 1.0, 3.0, 4.0};
constexpr std::array position{0.0, 0.0,  1.0, 10.0,
                              5.0, 50.0, 6.0, 60.0};  // two columns, the second ten times the first

std::array<double, 8> speed_of(SpeedMeasurement measurement) {
  std::array<double, 8> speed{};
  difference(measurement, time, position, speed, 2);
  return speed;
}

TEST(SpeedMeasurement, DifferencesReachAsFarAsTheirNameSays) {
  EXPECT_EQ(speed_of(SpeedMeasurement{1, 0}), (std::array{1.0, 10.0, 1.0, 10.0, 2.0, 20.0, 1.0, 10.0}));
  EXPECT_EQ(speed_of(SpeedMeasurement{0, 1}), (std::array{1.0, 10.0, 2.0, 20.0, 1.0, 10.0, 1.0, 10.0}));
  const auto central = speed_of(SpeedMeasurement{1, 1});
  EXPECT_DOUBLE_EQ(central[0], 1.0);
  EXPECT_DOUBLE_EQ(central[2], 5.0 / 3.0);
  EXPECT_DOUBLE_EQ(central[5], 50.0 / 3.0);
  EXPECT_DOUBLE_EQ(central[6], 1.0);
}

TEST(SpeedMeasurement, ADifferenceOverMoreSamplesIsTheMeanOfThoseOverOne) {
  const auto two = speed_of({2, 0}), one = speed_of({1, 0});
  EXPECT_DOUBLE_EQ(two[6], (one[6] * 1.0 + one[4] * 2.0) / 3.0);  // over samples of unequal length
}

}  // namespace
}  // namespace rwn
