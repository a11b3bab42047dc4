#include "rwn/networks/structured_network.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace rwn {

StructuredNetwork::StructuredNetwork(Vector theta, Wavelet wavelet) : theta_(std::move(theta)), wavelet_(wavelet) {
  if (theta_.size() < linear || (theta_.size() - linear) % 4 != 0) {
    throw std::invalid_argument("theta: expected 5 + 4 N_w parameters [v1..v5, w, m, d, c], got " +
                                std::to_string(theta_.size()));
  }
  if (!theta_.allFinite()) {
    throw std::invalid_argument("theta: every parameter must be finite");
  }
  if ((group(kDilation).array() == 0.0).any()) {
    throw std::invalid_argument("theta: a dilation is zero; z = (u - m)/d needs d != 0");
  }
}

Eigen::Matrix2d StructuredNetwork::plant() const {
  const double v1 = theta_[0], v2 = theta_[1], v3 = theta_[2], v4 = theta_[3], v5 = theta_[4];
  return Eigen::Matrix2d{{1.0 - v1 * v2, v2 * v3}, {-v3 * v4, v5}};
}

StructuredRun::StructuredRun(const StructuredNetwork& network)
    : kernels_(structured_kernels()), wavelets_(network.wavelets()), linear_(kLinearRows), rates_(kStructuredGroups),
      squares_(static_cast<std::size_t>(lanes)) {
  const long width = kernels_.width;
  const long vectors = (wavelets_ + width - 1) / width;
  network_.resize(static_cast<std::size_t>(vectors * kNetworkRows * width));
  block_ = {linear_.data(), network_.data(), vectors, network.wavelet().index(), network.wavelet().omega0(),
            rates_.data(),  true,            true,    false};
  want(true, true);
  for (long j = 0; j < vectors * width; ++j) {
    network_[at(kTheta + 1, j)] = kPaddingTranslation;
    network_[at(kTheta + 2, j)] = kPaddingDilation;
  }
  load(network);
}

std::size_t StructuredRun::at(int row, Eigen::Index j) const {
  const Eigen::Index width = kernels_.width;
  return static_cast<std::size_t>(((j / width) * kNetworkRows + row) * width + j % width);
}

void StructuredRun::load(const StructuredNetwork& network) {
  std::copy_n(network.theta().data(), StructuredNetwork::linear, linear_.begin());
  for (int g = 0; g < 4; ++g) {
    for (Eigen::Index j = 0; j < wavelets_; ++j) {
      network_[at(kTheta + g, j)] = network.group(kWeight + g)[j];
    }
  }
}

void StructuredRun::save(Vector& theta) const {
  std::copy_n(linear_.begin(), StructuredNetwork::linear, theta.data());
  for (int g = 0; g < 4; ++g) {
    for (Eigen::Index j = 0; j < wavelets_; ++j) {
      theta[StructuredNetwork::linear + g * wavelets_ + j] = network(kTheta + g, j);
    }
  }
}

void StructuredRun::restart(const Eigen::Vector2d& start) {
  std::fill(linear_.begin() + kX1, linear_.end(), 0.0);
  linear_[kX1] = start[0];
  linear_[kX2] = start[1];
  const long width = kernels_.width;
  for (long p = 0; p < block_.vectors; ++p) {
    const auto first = network_.begin() + (p * kNetworkRows + kPhi) * width;
    std::fill(first, first + (kNetworkRows - kPhi) * width, 0.0);
  }
}

void StructuredRun::want(bool electrical, bool friction) {
  block_.electrical = electrical;
  block_.friction = friction && wavelets_ > 0;
}

void StructuredRun::correct(const double* rates, double error) {
  std::copy_n(rates, rates_.size(), rates_.begin());
  kernels_.correct(block_, error);
}

StructuredCycle StructuredRun::cycle(const StructuredSignals& s) {
  restart(s.start);
  return {s.input.data(), s.speed.data(), s.samples(), squares_.data()};
}

double StructuredRun::train(const StructuredSignals& s, const double* rates) {
  std::copy_n(rates, rates_.size(), rates_.begin());
  const double first = s.speed[0] - s.start[0];
  kernels_.train(block_, cycle(s));
  return first * first + squares_[0];
}

double StructuredRun::train_thesis(const StructuredSignals& s, ThesisBounds& bounds) {
  const double first = s.speed[0] - s.start[0];
  kernels_.train_thesis(block_, cycle(s), bounds);
  return first * first + squares_[0];
}

void StructuredRun::simulate(const StructuredSignals& s, double* output) {
  const bool friction = block_.friction;
  block_.friction = false;
  kernels_.simulate(block_, cycle(s), output);
  block_.friction = friction;
}

void StructuredRun::sensitivity(int linear_row, int network_row, double* out) const {
  std::copy_n(linear_.begin() + linear_row, StructuredNetwork::linear, out);
  out += StructuredNetwork::linear;
  for (int g = 0; g < 4; ++g) {
    for (Eigen::Index j = 0; j < wavelets_; ++j) {
      *out++ = network(network_row + g, j);
    }
  }
}

void StructuredRun::shift(const Vector& change) {
  double follow1 = 0.0;
  double follow2 = 0.0;
  for (int k = 0; k < static_cast<int>(StructuredNetwork::linear); ++k) {
    linear_[static_cast<std::size_t>(kV + k)] += change[k];
    follow1 += linear(kP + k) * change[k];
    follow2 += linear(kQ + k) * change[k];
  }
  const double* step = change.data() + StructuredNetwork::linear;
  for (int g = 0; g < 4; ++g) {
    for (Eigen::Index j = 0; j < wavelets_; ++j, ++step) {
      network_[at(kTheta + g, j)] += *step;
      follow1 += network(kPNet + g, j) * *step;
      follow2 += network(kQNet + g, j) * *step;
    }
  }
  if (block_.carry) {
    linear_[kX1] += follow1;
    linear_[kX2] += follow2;
  }
}

void check(const StructuredSignals& signals) {
  if (signals.input.size() != signals.speed.size() || signals.speed.size() < 2) {
    throw std::invalid_argument("input and speed: expected two arrays of one length, at least 2 samples; got " +
                                std::to_string(signals.input.size()) + " and " + std::to_string(signals.speed.size()));
  }
}

Vector simulate(const StructuredNetwork& network, const StructuredSignals& signals) {
  check(signals);
  StructuredRun run(network);
  Vector output(signals.samples());
  run.simulate(signals, output.data());
  return output;
}

StructuredSensitivities sensitivities(const StructuredNetwork& network, const StructuredSignals& signals) {
  check(signals);
  StructuredRun run(network);
  run.restart(signals.start);
  StructuredSensitivities out{Vector(signals.samples()), RowMatrix(signals.samples(), network.theta().size())};
  out.speed[0] = run.speed();
  out.jacobian.row(0).setZero();
  for (Eigen::Index n = 1; n < signals.samples(); ++n) {
    run.advance(signals.input[n - 1], signals.speed[n - 1]);
    out.speed[n] = run.speed();
    run.speed_sensitivity(out.jacobian.row(n).data());
  }
  return out;
}

double mean_squared_error(const StructuredNetwork& network, const StructuredSignals& signals) {
  const Vector output = simulate(network, signals);
  return (signals.speed - output).squaredNorm() / static_cast<double>(signals.samples());
}

}  // namespace rwn
