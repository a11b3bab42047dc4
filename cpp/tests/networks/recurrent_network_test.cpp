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
        const Vector difference =
            (simulate({plus, columns, net.wavelet()}, x) - simulate({minus, columns, net.wavelet()}, x)) / 2e-6;
        EXPECT_LT((s.jacobian.col(k) - difference).cwiseAbs().maxCoeff(),
                  1e-6 * std::max(1.0, difference.cwiseAbs().maxCoeff()));
      }
    }
  }
}

/// The output by the scalar wavelet and the equations 3.1-3.4.
Vector by_hand(const RecurrentNetwork& net, const RowMatrix& x) {
  const RecurrentRun at(net);
  Vector phi = Vector::Zero(net.size(kShift)), out(x.rows());
  for (Eigen::Index n = 0; n < x.rows(); ++n) {
    out[n] = net.theta()[0] + at.parameters(kDirect).dot(x.row(n));
    for (Eigen::Index j = 0; j < net.wavelets(); ++j) {
      double product = 1.0;
      for (Eigen::Index i = 0; i < net.inputs(); ++i) {
        const Eigen::Index k = j * net.inputs() + i;
        phi[k] = net.wavelet().value((x(n, i) + at.parameters(kLoop)[k] * phi[k] - at.parameters(kShift)[k]) /
                                     at.parameters(kScale)[k]);
        product *= phi[k];
      }
      out[n] += at.parameters(kOutput)[j] * product;
    }
  }
  return out;
}

TEST(RecurrentNetwork, SimulatesItsEquations) {
  for (const char* name : {"gaussian-derivative", "mexican-hat", "morlet"}) {
    for (Eigen::Index columns : {1, 2, 5}) {
      for (Eigen::Index wavelets : {0, 3, 8, 17}) {
        const RecurrentNetwork net = network(columns, wavelets, Wavelet(name));
        const RowMatrix x = inputs(300, columns);
        EXPECT_LT((simulate(net, x) - by_hand(net, x)).cwiseAbs().maxCoeff(), 1e-12);
      }
    }
  }
}

TEST(RecurrentRun, TrainingSampleBySampleEqualsTheCycleKernel) {
  for (Eigen::Index columns : {1, 3}) {
    const RecurrentNetwork net = network(columns, 11, Wavelet());
    const RowMatrix x = inputs(900, columns);
    const Vector y = Vector::Ones(900);
    const double rates[kRecurrentGroups] = {1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-4};
    RecurrentRun cycle(net), steps(net);
    const double squares = cycle.train({x, y}, rates);
    steps.restart();
    double met = 0.0;
    for (Eigen::Index n = 0; n < x.rows(); ++n) {
      const double error = y[n] - steps.advance(x.row(n).data());
      met += error * error;
      steps.correct(rates, error);
    }
    EXPECT_GT((cycle.theta() - net.theta()).cwiseAbs().maxCoeff(), 1e-3);
    EXPECT_LT((cycle.theta() - steps.theta()).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_NEAR(squares / met, 1.0, 1e-12);
  }
}

TEST(RecurrentRun, AStepIsRateTimesErrorTimesDerivative) {
  const RecurrentNetwork net = network(2, 5, Wavelet());
  const RowMatrix x = inputs(40, 2);
  const double rates[kRecurrentGroups] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  RecurrentRun run(net);
  run.restart();
  for (Eigen::Index n = 0; n < x.rows(); ++n) {
    run.advance(x.row(n).data());
  }
  const Vector before = run.theta();
  run.correct(rates, -0.7);
  for (int g = 0; g < kRecurrentGroups; ++g) {
    const Vector step = run.parameters(g) - before.segment(net.offset(g), net.size(g));
    EXPECT_LT((step + 0.7 * rates[g] * run.sensitivity(g)).cwiseAbs().maxCoeff(), 1e-15) << g;
    EXPECT_GT(step.cwiseAbs().maxCoeff(), 1e-6) << g;
  }
}

TEST(RecurrentRun, FeedbackThatIsTooStrongIsCountedAndDoesNotLearn) {
  Vector theta = network(1, 5, Wavelet()).theta();
  theta[theta.size() - 5] = 1.2 * theta[theta.size() - 10];  // c = 1.2 d, of one wavelet
  const RecurrentNetwork net(theta, 1, Wavelet());
  const RowMatrix x = inputs(50, 1);
  const Vector y = Vector::Ones(50);
  RecurrentRun run(net);
  const auto rates = ThesisRates{1e-3}.on(net, {true, true, true, true, true, true});
  rates->train(run, {x, y});
  EXPECT_EQ(rates->report.recurrent, 50);
  EXPECT_NEAR(rates->report.recurrence, 1.2, 1e-12);
  EXPECT_NEAR(rates->report.smallest_dilation, theta.segment(theta.size() - 10, 5).cwiseAbs().minCoeff(), 1e-12);
  EXPECT_EQ((run.theta() - theta).tail(15).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_GT((run.theta() - theta).head(7).cwiseAbs().minCoeff(), 0.0);
}

TEST(RecurrentNetwork, PerSampleLoopsDoNotAllocate) {
  const RecurrentNetwork net = network(2, 5, Wavelet());
  const RowMatrix x = inputs(300, 2);
  const Vector y = Vector::Ones(300);
  const RecurrentSignals signals{x, y};
  const RecurrentMask all{true, true, true, true, true, true};
  RecurrentRun run(net);
  for (const auto& rule : std::vector<RateRule>{FixedRates{std::vector<double>(6, 1e-6)}, ThesisRates{1e-3},
                                               TightenedRates{1e-3}, ImpulseResponseRates{}, NormalisedRates{1e-3}}) {
    const auto rates = std::visit([&](const auto& v) { return v.on(net, all); }, rule);
    rates->prepare(run, signals);
    const long before = testing::allocations();
    rates->train(run, signals);
    EXPECT_EQ(testing::allocations(), before) << rule.index();
  }
}

TEST(RecurrentNetwork, RefusesBadParameters) {
  EXPECT_THROW(RecurrentNetwork(Vector::Ones(4), 1, Wavelet()), std::invalid_argument);
  EXPECT_THROW(RecurrentNetwork(Vector::Zero(6), 1, Wavelet()), std::invalid_argument);
}

}  // namespace
}  // namespace rwn
