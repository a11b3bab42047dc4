#include "rwn/networks/initialisation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include <numeric>
#include <set>
#include <stdexcept>

#include "conventional_fixture.hpp"

namespace {

using namespace rwn;

const RowMatrix line = Eigen::VectorXd::LinSpaced(101, -10.0, 10.0);

TEST(LeastSquares, FindsAnAffineFunction) {
  std::mt19937 random(1);
  const RowMatrix x = rwn::testing::random_matrix(40, 3, random);
  const Eigen::MatrixXd truth = rwn::testing::random_matrix(4, 2, random);
  const RowMatrix y = (x * truth.bottomRows(3)).rowwise() + truth.row(0);
  EXPECT_LT((least_squares(x, y) - truth).norm(), 1e-13);
}

TEST(Heuristic, CentresEveryWaveletOnTheDomain) {
  const Shapes shapes = heuristic(line, 4);
  EXPECT_TRUE((shapes.m.array() == 0.0).all());
  EXPECT_TRUE((shapes.d.array() == 4.0).all());
}

TEST(DyadicGrid, HalvesAtTheCentreOfGravity) {
  const Shapes shapes = dyadic_grid(line, 3, {});
  EXPECT_NEAR(shapes.m(0, 0), 0.0, 1e-12);
  EXPECT_NEAR(shapes.d(0, 0), 10.0, 1e-12);
  EXPECT_NEAR(shapes.m(1, 0), -5.0, 0.11);
  EXPECT_NEAR(shapes.m(2, 0), 5.0, 0.11);
  EXPECT_NEAR(shapes.d(2, 0), 5.0, 1e-12);
}

TEST(DyadicGrid, FollowsTheDensityOfTheData) {
  const Shapes shapes = dyadic_grid(RowMatrix((line.array() / 10.0).exp()), 1, {});
  EXPECT_LT(shapes.m(0, 0), 0.5 * (std::exp(1.0) + std::exp(-1.0)));  // more points lie low
}

TEST(DyadicGrid, TakesTheRestFromTheFinestScale) {
  EXPECT_EQ(finest_scale(7).taken, 0);
  EXPECT_EQ(finest_scale(10).nodes, 8);
  EXPECT_EQ(finest_scale(10).taken, 3);
  const Shapes shapes = dyadic_grid(line, 10, {0, 3, 7});
  EXPECT_NEAR(shapes.m(9, 0), 8.75, 0.3);
  EXPECT_THROW(dyadic_grid(line, 10, {0}), std::invalid_argument);
}

TEST(Initialisation, RefusesAConstantInput) {
  EXPECT_THROW(heuristic(RowMatrix::Ones(5, 1), 3), std::invalid_argument);
}

TEST(Selection, FindsThePlantedWavelets) {
  const Wavelet wavelet("mexican-hat");
  const Shapes library = wavelet_library(line, 4, 0.5);
  const std::vector<int> planted{3, 11, 20};
  RowMatrix y = RowMatrix::Zero(line.rows(), 1);
  for (const int j : planted) {
    for (Eigen::Index p = 0; p < line.rows(); ++p) {
      y(p, 0) += (1.0 + j) * wavelet.value((line(p, 0) - library.m(j, 0)) / library.d(j, 0));
    }
  }
  const std::vector<int> chosen = select_wavelets(wavelet, library, line, y, 8);
  Eigen::MatrixXd basis(line.rows(), 8);
  for (int c = 0; c < 8; ++c) {
    for (Eigen::Index p = 0; p < line.rows(); ++p) {
      const int j = chosen[static_cast<std::size_t>(c)];
      basis(p, c) = wavelet.value((line(p, 0) - library.m(j, 0)) / library.d(j, 0));
    }
  }
  EXPECT_EQ(std::set<int>(chosen.begin(), chosen.end()).size(), chosen.size());
  const Eigen::VectorXd w = (basis.transpose() * basis).ldlt().solve(basis.transpose() * y);
  EXPECT_LT((y - basis * w).squaredNorm(), 1e-2 * y.squaredNorm());
}

TEST(Selection, CombinesScalesOverInputs) {
  RowMatrix x(4, 2);
  x << 0, 0, 1, 0, 0, 2, 1, 2;
  const Shapes library = wavelet_library(x, 2, 0.5);
  const Shapes axis = wavelet_library(RowMatrix(x.col(0)), 2, 0.5);
  EXPECT_EQ(library.m.rows(), axis.m.rows() * axis.m.rows());
  EXPECT_NEAR(library.d.col(1).maxCoeff(), 1.0, 1e-15);
}

}  // namespace
