#include "rwn/fit/innovations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace rwn {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

TEST(Innovations, OfAnAutoregressionOfOrderTwo) {
  const std::vector<double> reflection{0.5, -0.3};
  const double one = 0.5 * (1.0 + 0.3), two = -0.3;  // Durbin: a1 = r1 (1 - r2), a2 = r2
  std::vector<double> errors{1.0, 2.0, -1.0, 0.5, 3.0};
  const std::vector<double> before = errors;
  innovations(errors, reflection);
  for (std::size_t k = 2; k < errors.size(); ++k) {
    EXPECT_NEAR(errors[k], before[k] - one * before[k - 1] - two * before[k - 2], 1e-12);
  }
  EXPECT_NEAR(errors[1], std::sqrt(1.0 - 0.09) * (2.0 - 0.5 * 1.0), 1e-12);
  EXPECT_NEAR(errors[0], std::sqrt(1.0 - 0.09) * std::sqrt(1.0 - 0.25) * 1.0, 1e-12);
}

TEST(Innovations, PassOverWhatWasNotMeasuredAndBeginAnewAtARestart) {
  std::vector<double> errors{1.0, missing, 2.0, 4.0, 8.0};
  innovations(errors, {0.5}, 3);
  const double alone = std::sqrt(0.75);
  EXPECT_NEAR(errors[0], alone, 1e-12);
  EXPECT_TRUE(std::isnan(errors[1]));
  EXPECT_NEAR(errors[2], 2.0 - 0.5 * 1.0, 1e-12);
  EXPECT_NEAR(errors[3], alone * 4.0, 1e-12);
  EXPECT_NEAR(errors[4], 8.0 - 0.5 * 4.0, 1e-12);
}

TEST(Innovations, TakeTheSlopesAlong) {
  std::vector<double> errors{1.0, 3.0, 7.0}, slopes{1.0, 10.0, 2.0, 20.0, 5.0, 50.0};
  innovations(errors, {0.5}, 0, slopes);
  EXPECT_NEAR(slopes[4], 5.0 - 0.5 * 2.0, 1e-12);
  EXPECT_NEAR(slopes[5], 50.0 - 0.5 * 20.0, 1e-12);
}

}  // namespace
}  // namespace rwn
