#include "rwn/networks/side_by_side.hpp"

#include <gtest/gtest.h>

#include "allocations.hpp"
#include "rwn/networks/rates.hpp"
#include "structured_fixture.hpp"

namespace rwn {
namespace {

using testing::network;
using testing::Recording;

RowMatrix thetas(int count) {
  RowMatrix theta(count, 5 + 4 * 15);
  for (int k = 0; k < count; ++k) theta.row(k) = network(15, static_cast<unsigned>(k)).theta();
  return theta;
}

RowMatrix rates_of(int count) {
  RowMatrix rates(count, static_cast<Eigen::Index>(kStructuredGroups));
  rates.rowwise() = Eigen::RowVectorXd{{1e-6, 1e-6, 1e-7, 0.0, 0.0, 1e-6, 1e-5, 1e-5, 1e-5}};
  return rates;
}

TEST(SideBySide, EqualsEachRunAlone) {
  const Recording r(1500);
  const RowMatrix theta = thetas(5), rates = rates_of(5);
  const SideBySide got = train_side_by_side(theta, Wavelet(), rates, r.signals(), 2);
  const StructuredMask all{true, true, true, true, true, true, true, true, true};
  for (Eigen::Index k = 0; k < theta.rows(); ++k) {
    const StructuredNetwork start(theta.row(k), Wavelet());
    const auto rule = FixedRates{{rates.row(k).begin(), rates.row(k).end()}}.on(start, all);
    const StructuredTraining alone = train(start, r.signals(), *rule, all, {2, 0, false});
    EXPECT_GT((got.theta.row(k) - theta.row(k)).cwiseAbs().maxCoeff(), 1e-8);
    EXPECT_LT((got.theta.row(k).transpose() - alone.network.theta()).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_EQ(got.status[static_cast<std::size_t>(k)], alone.history.status);
    EXPECT_NEAR(got.mse_frozen[k], alone.history.mse_frozen.back(), 1e-11 * got.mse_frozen[k]);
  }
}

TEST(SideBySide, AllocatesAsOftenForAnyNumberOfSamples) {
  const RowMatrix theta = thetas(3), rates = rates_of(3);
  const auto made = [&](Eigen::Index samples) {
    const Recording r(samples);
    const StructuredSignals signals = r.signals();
    const long before = testing::allocations();
    train_side_by_side(theta, Wavelet(), rates, signals, 1);
    return testing::allocations() - before;
  };
  EXPECT_EQ(made(2000), made(20));
}

TEST(SideBySide, RefusesWhatDoesNotFit) {
  const Recording r(20);
  EXPECT_THROW(train_side_by_side(thetas(2), Wavelet(), rates_of(3), r.signals(), 1), std::invalid_argument);
  EXPECT_THROW(train_side_by_side(thetas(2), Wavelet(), rates_of(2), r.signals(), 0), std::invalid_argument);
}

}  // namespace
}  // namespace rwn
