#include "rwn/numerics/dual.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rwn {
namespace {

using S = Dual<4, struct Plain>;

TEST(Dual, AnExponentialThatUnderflowsIsZeroWithItsSlopes) {
  for (const double x : {-701.0, -740.0, -1e6}) {
    const S y = exp(S::variable(x, 1));
    EXPECT_EQ(y.v, 0.0);
    EXPECT_EQ(y.d[1], 0.0);
  }
  const S y = exp(S::variable(-699.0, 1));
  EXPECT_EQ(y.v, std::exp(-699.0));
  EXPECT_EQ(y.d[1], y.v);
}

}  // namespace
}  // namespace rwn
