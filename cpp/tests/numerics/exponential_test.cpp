// The matrix functions of exponential integrators against their definition, and the matrices of a step by entries.
#include "rwn/numerics/exponential.hpp"

#include <gtest/gtest.h>

#include "rwn/simulate/step_matrices.hpp"

namespace rwn {
namespace {

struct Tag {};
using Real = Dual<0, Tag>;
using WithSlopes = Dual<8, Tag>;

/// (phi_{k-1}(z) - 1/(k-1)!) / z, at numbers where it does not cancel.
TEST(Exponential, PhiFunctionsOfNumbersAreTheirDefinition) {
  for (const double z : {-700.0, -31.0, -2.0, -0.6, 0.9, 2.5}) {
    const auto phi = phi_functions<Real, 1>({Real(z)});
    double expected = std::exp(z);
    EXPECT_NEAR(phi.p0[0].v, expected, 1e-13 * std::max(1.0, expected)) << z;
    expected = (expected - 1.0) / z;
    EXPECT_NEAR(phi.p1[0].v, expected, 1e-13 * expected) << z;
    expected = (expected - 1.0) / z;
    EXPECT_NEAR(phi.p2[0].v, expected, 1e-13 * expected) << z;
    expected = (expected - 0.5) / z;
    EXPECT_NEAR(phi.p3[0].v, expected, 1e-13 * expected) << z;
  }
}

TEST(Exponential, PhiFunctionsOfNothingAreTheReciprocalFactorials) {
  const auto phi = phi_functions<Real, 2>({});
  for (const std::size_t k : {0, 1, 2, 3}) {
    const double one = k == 0 || k == 3 ? 1.0 : 0.0;
    EXPECT_EQ(phi.p0[k].v, one);
    EXPECT_EQ(phi.p1[k].v, one);
    EXPECT_EQ(phi.p2[k].v, one / 2.0);
    EXPECT_EQ(phi.p3[k].v, one / 6.0);
  }
}

/// Of numbers, of a shaft that coasts (defective) and of one that rotates; all by the series, without doublings.
TEST(Exponential, PhiFunctionsOfTwiceTheArgumentAreThoseOfItDoubled) {
  for (const SmallMatrix<Real, 2>& z :
       {SmallMatrix<Real, 2>{-0.12, 0.0, 0.0, 0.02}, SmallMatrix<Real, 2>{0.0, 0.12, 0.0, 0.0},
        SmallMatrix<Real, 2>{0.0, -0.12, 0.05, 0.0}}) {
    auto doubled = phi_functions<Real, 2>(z);
    double_argument<Real, 2>(doubled);
    SmallMatrix<Real, 2> twice = z;
    for (Real& entry : twice) entry *= 2.0;
    const auto expected = phi_functions<Real, 2>(twice);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(doubled.p0[k].v, expected.p0[k].v, 1e-15);
      EXPECT_NEAR(doubled.p1[k].v, expected.p1[k].v, 1e-15);
      EXPECT_NEAR(doubled.p2[k].v, expected.p2[k].v, 1e-15);
      EXPECT_NEAR(doubled.p3[k].v, expected.p3[k].v, 1e-15);
    }
  }
}

/// A winding of 0.1 ms with a shaft of 0.1 s, and derivatives that lie across its entries in all ways.
SmallMatrix<WithSlopes, 2> drive() {
  SmallMatrix<WithSlopes, 2> a{-1e4, -300.0, 50.0, -10.0};
  for (std::size_t k = 0; k < a.size(); ++k) {
    for (int j = 0; j < 8; ++j)
      a[k].d.set(j, (1.0 + static_cast<double>(k)) * std::cos(1.0 + 3.0 * j + 7.0 * static_cast<double>(k)));
  }
  return a;
}

TEST(StepMatrices, MadeByEntriesAreThoseMadeByParameters) {
  static_assert(made_by_entries<WithSlopes, 2> && !made_by_entries<WithSlopes, 3>);
  for (const bool varies : {false, true}) {
    StepMatrices<WithSlopes, 2> by_entries, by_parameters;
    make_matrices<WithSlopes, 2>(by_entries, drive(), 1e-3, varies);
    make_by_series<WithSlopes, 2>(by_parameters, drive(), 1e-3, varies);
    const auto agree = [](const SmallMatrix<WithSlopes, 2>& a, const SmallMatrix<WithSlopes, 2>& b) {
      for (std::size_t k = 0; k < a.size(); ++k) {
        EXPECT_EQ(a[k].v, b[k].v);
        for (int j = 0; j < 8; ++j) EXPECT_NEAR(a[k].d[j], b[k].d[j], 1e-12 * std::abs(b[k].d[j]) + 1e-18);
      }
    };
    agree(by_entries.e, by_parameters.e);
    agree(by_entries.p1, by_parameters.p1);
    agree(by_entries.p2, by_parameters.p2);
    agree(by_entries.eh, by_parameters.eh);
    agree(by_entries.p1h, by_parameters.p1h);
    agree(by_entries.f1, by_parameters.f1);
    agree(by_entries.f2, by_parameters.f2);
    agree(by_entries.f3, by_parameters.f3);
  }
}

}  // namespace
}  // namespace rwn
