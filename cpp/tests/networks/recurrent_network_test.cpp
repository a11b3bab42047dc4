#include "rwn/networks/recurrent_network.hpp"

#include <gtest/gtest.h>

#include <random>

#include "allocations.hpp"
#include "rwn/networks/online_training.hpp"
#include "rwn/networks/rates.hpp"

namespace rwn {
namespace {

RecurrentNetwork network(Eigen::Index inputs, Eigen::Index wavelets, const Wavelet& wavelet) {
  std::mt19937 rng(4);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  Vector theta(1 + inputs + wavelets * (1 + 3 * inputs));
  for (double& t : theta) {
    t = u(rng);
  }
  const Eigen::Index n = wavelets * inputs;
  theta.segment(theta.size() - 2 * n, n).array() += 1.5 + 0.0;
  theta.tail(n) *= 0.2 / wavelet.max_derivative();
  return {theta, inputs, wavelet};
}

RowMatrix inputs(Eigen::Index n, Eigen::Index columns) {
  RowMatrix x(n, columns);
  for (Eigen::Index k = 0; k < n; ++k) {
    for (Eigen::Index i = 0; i < columns; ++i) {
      x(k, i) = std::sin(0.01 * static_cast<double>((k + 3) * (i + 1)));
    }
  }
  return x;
}

TEST(RecurrentNetwork, GradientsMatchFiniteDifferences) {
  for (const char* name : {"gaussian-derivative", "mexican-hat", "morlet"}) {
    for (Eigen::Index columns : {1, 2, 3}) {
      const RecurrentNetwork net = network(columns, 3, Wavelet(name));
      const RowMatrix x = inputs(200, columns);
      const RecurrentSensitivities s = sensitivities(net, x);
      for (Eigen::Index k = 0; k < net.theta().size(); ++k) {
        Vector plus = net.theta(), minus = net.theta();
        plus[k] += 1e-6;
        minus[k] -= 1e-6;
        const Vector difference = (simulate({plus, columns, net.wavelet()}, x) - simulate({minus, columns, net.wavelet()}, x)) / 2e-6;
        EXPECT_LT((s.jacobian.col(k) - difference).cwiseAbs().maxCoeff(), 1e-6 * std::max(1.0, difference.cwiseAbs().maxCoeff()));
      }
    }
  }
}

TEST(RecurrentNetwork, PerSampleLoopsDoNotAllocate) {
  const RecurrentNetwork net = network(2, 5, Wavelet());
  const RowMatrix x = inputs(300, 2);
  const Vector y = Vector::Ones(300);
  const RecurrentSignals signals{x, y};
  const RecurrentMask all{true, true, true, true, true, true};
  RecurrentRun run(net);
  for (const auto& rule : std::vector<RateRule>{FixedRates{std::vector<double>(6, 1e-6)}, ThesisRates{1e-3},
                                               ImpulseResponseRates{}, NormalisedRates{1e-3}}) {
    const auto rates = std::visit([&](const auto& v) { return v.on(net, all); }, rule);
    rates->prepare(run, signals);
    const long before = testing::allocations();
    for (Eigen::Index n = 0; n < x.rows(); ++n) {
      const double error = y[n] - run.advance(x.row(n).data());
      run.correct(rates->rates(run, x.row(n).data()), error);
    }
    EXPECT_EQ(testing::allocations(), before) << rule.index();
  }
}

TEST(RecurrentNetwork, RefusesBadParameters) {
  EXPECT_THROW(RecurrentNetwork(Vector::Ones(4), 1, Wavelet()), std::invalid_argument);
  EXPECT_THROW(RecurrentNetwork(Vector::Zero(6), 1, Wavelet()), std::invalid_argument);
}

}  // namespace
}  // namespace rwn
