#include "rwn/networks/conventional_network.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <stdexcept>

#include "conventional_fixture.hpp"

namespace {

using namespace rwn;
using rwn::testing::random_matrix;
using rwn::testing::random_network;

/// Output k of the network for one pattern from (2.4) and (2.5), on any scalar.
template <class T>
T output(const ConventionalNetwork& n, const Eigen::Matrix<T, Eigen::Dynamic, 1>& theta, const Eigen::VectorXd& x,
         int k) {
  const ConventionalShape& s = n.shape();
  T y = theta[k];
  for (int i = 0; i < s.inputs; ++i) {
    y += theta[s.a() + k * s.inputs + i] * x[i];
  }
  for (int j = 0; j < s.wavelets; ++j) {
    T phi = theta[s.w() + k * s.wavelets + j];
    for (int i = 0; i < s.inputs; ++i) {
      const int at = j * s.inputs + i;
      phi *= n.wavelet().visit([&](const auto& w) { return w.value((x[i] - theta[s.m() + at]) / theta[s.d() + at]); });
    }
    y += phi;
  }
  return y;
}

struct Case {
  const char* wavelet;
  double omega0;
  ConventionalShape shape;
};

class Networks : public ::testing::TestWithParam<Case> {
 protected:
  ConventionalNetwork network = random_network(Wavelet(GetParam().wavelet, GetParam().omega0), GetParam().shape, 3);
};

TEST_P(Networks, OutputFollowsTheEquations) {
  std::mt19937 random(1);
  const RowMatrix x = random_matrix(37, network.shape().inputs, random);
  const RowMatrix y = network.output(x);
  for (int p = 0; p < x.rows(); ++p) {
    for (int k = 0; k < network.shape().outputs; ++k) {
      const double want = output<double>(network, network.parameters(), x.row(p).transpose(), k);
      EXPECT_NEAR(y(p, k), want, 1e-13 * (1.0 + std::abs(want)));
    }
  }
}

TEST_P(Networks, JacobianAgreesWithTheComplexStep) {
  std::mt19937 random(2);
  const RowMatrix x = random_matrix(11, network.shape().inputs, random);
  const Eigen::MatrixXd jacobian = network.jacobian(x);
  constexpr double h = 1e-30;
  for (int c = 0; c < network.shape().size(); ++c) {
    Eigen::VectorXcd theta = network.parameters();
    theta[c] += std::complex<double>(0.0, h);
    for (int k = 0; k < network.shape().outputs; ++k) {
      for (int p = 0; p < x.rows(); ++p) {
        const double want = output<std::complex<double>>(network, theta, x.row(p).transpose(), k).imag() / h;
        EXPECT_NEAR(jacobian(k * x.rows() + p, c), want, 1e-12 * (1.0 + std::abs(want)));
      }
    }
  }
}

TEST_P(Networks, GradientIsTheJacobianTimesTheErrors) {
  std::mt19937 random(4);
  const RowMatrix x = random_matrix(29, network.shape().inputs, random);
  const RowMatrix y = random_matrix(29, network.shape().outputs, random);
  const RowMatrix error = y - network.output(x);
  const Eigen::VectorXd stacked = Eigen::Map<const Eigen::VectorXd>(Eigen::MatrixXd(error).data(), error.size());
  const Eigen::VectorXd want = -network.jacobian(x).transpose() * stacked;
  EXPECT_LT((network.gradient(x, y) - want).norm(), 1e-12 * want.norm());
}

INSTANTIATE_TEST_SUITE_P(Shapes, Networks,
                         ::testing::Values(Case{"gaussian-derivative", 5.0, {1, 15, 1}},
                                           Case{"gaussian-derivative", 5.0, {3, 9, 2}},
                                           Case{"mexican-hat", 5.0, {2, 7, 3}}, Case{"morlet", 5.0, {1, 5, 1}},
                                           Case{"morlet", 1.75, {4, 3, 1}}, Case{"mexican-hat", 5.0, {2, 0, 1}}));

TEST(ConventionalNetwork, WrongSizesAreRefused) {
  EXPECT_THROW(ConventionalNetwork(Wavelet(), {1, 2, 1}, Eigen::VectorXd::Zero(3)), std::invalid_argument);
  const ConventionalNetwork network = random_network(Wavelet(), {2, 3, 1}, 1);
  EXPECT_THROW(network.output(RowMatrix::Zero(4, 3)), std::invalid_argument);
  EXPECT_THROW(Patterns(RowMatrix::Zero(4, 1), RowMatrix::Zero(3, 1)), std::invalid_argument);
}

}  // namespace
