#include "rwn/networks/recurrent_network.hpp"

#include <stdexcept>
#include <string>

namespace rwn {

RecurrentNetwork::RecurrentNetwork(Vector theta, Eigen::Index inputs, Wavelet wavelet)
    : theta_(std::move(theta)), inputs_(inputs), wavelet_(wavelet) {
  if (inputs_ < 1 || theta_.size() < 1 + inputs_ || (theta_.size() - 1 - inputs_) % (1 + 3 * inputs_) != 0) {
    throw std::invalid_argument("theta: expected 1 + N_i + N_w (1 + 3 N_i) parameters [b, a, w, m, d, c] for N_i = " +
                                std::to_string(inputs_) + ", got " + std::to_string(theta_.size()));
  }
  if (!theta_.allFinite()) {
    throw std::invalid_argument("theta: every parameter must be finite");
  }
  if ((theta_.segment(offset(kScale), size(kScale)).array() == 0.0).any()) {
    throw std::invalid_argument("theta: a dilation is zero; z = (u - m)/d needs d != 0");
  }
}

Eigen::Index RecurrentNetwork::size(int group) const {
  switch (group) {
    case kBias:
      return 1;
    case kDirect:
      return inputs_;
    case kOutput:
      return wavelets();
    default:
      return wavelets() * inputs_;
  }
}

Eigen::Index RecurrentNetwork::offset(int group) const {
  Eigen::Index first = 0;
  for (int g = 0; g < group; ++g) {
    first += size(g);
  }
  return first;
}

RecurrentRun::RecurrentRun(const RecurrentNetwork& network)
    : network_(network), inputs_(network.inputs()), wavelets_(network.wavelets()), theta_(network.theta()),
      gradient_(theta_.size()), phi_(wavelets_ * inputs_), V1_(phi_.size()), V2_(phi_.size()), V3_(phi_.size()),
      products_(inputs_ + 1) {
  restart();
}

void RecurrentRun::restart() {
  for (Vector* v : {&gradient_, &phi_, &V1_, &V2_, &V3_}) {
    v->setZero();
  }
}

/// Fills the gradient's w, m, d, c of wavelet j; its w entry is Phi_j (3.9).
template <class W>
void RecurrentRun::wavelet(const W& kind, const double* x, Eigen::Index j) {
  const Eigen::Index count = wavelets_ * inputs_;
  const double* m = theta_.data() + 1 + inputs_ + wavelets_;
  double* gm = gradient_.data() + 1 + inputs_ + wavelets_;
  const double weight = theta_[1 + inputs_ + j];
  products_[0] = 1.0;
  for (Eigen::Index i = 0; i < inputs_; ++i) {
    const Eigen::Index k = j * inputs_ + i;
    const double d = m[count + k];
    const double c = m[2 * count + k];
    const double z = (x[i] + c * phi_[k] - m[k]) / d;
    const double slope = kind.derivative(z) / d;
    V1_[k] = slope * (c * V1_[k] - 1.0);
    V2_[k] = slope * (c * V2_[k] - z);
    V3_[k] = slope * (c * V3_[k] + phi_[k]);
    phi_[k] = kind.value(z);
    products_[i + 1] = products_[i] * phi_[k];
  }
  gradient_[1 + inputs_ + j] = products_[inputs_];
  double after = weight;  // w_j times the product of the factors behind i
  for (Eigen::Index i = inputs_ - 1; i >= 0; --i) {
    const Eigen::Index k = j * inputs_ + i;
    const double others = products_[i] * after;
    gm[k] = others * V1_[k];
    gm[count + k] = others * V2_[k];
    gm[2 * count + k] = others * V3_[k];
    after *= phi_[k];
  }
}

double RecurrentRun::advance(const double* x) {
  network_.wavelet().visit([&](const auto& kind) {
    for (Eigen::Index j = 0; j < wavelets_; ++j) {
      wavelet(kind, x, j);
    }
  });
  gradient_[0] = 1.0;
  double y = theta_[0];
  for (Eigen::Index i = 0; i < inputs_; ++i) {
    gradient_[1 + i] = x[i];
  }
  for (Eigen::Index k = 1; k < 1 + inputs_ + wavelets_; ++k) {
    y += theta_[k] * gradient_[k];
  }
  return y;
}

void RecurrentRun::correct(const double* rates, double error) {
  for (int g = 0; g < kRecurrentGroups; ++g) {
    const Eigen::Index first = network_.offset(g);
    const Eigen::Index size = network_.size(g);
    theta_.segment(first, size) += (rates[g] * error) * gradient_.segment(first, size);
  }
}

void check(const RecurrentNetwork& network, const RecurrentSignals& signals) {
  if (signals.inputs.cols() != network.inputs() || signals.inputs.rows() != signals.output.size() ||
      signals.output.size() < 1) {
    throw std::invalid_argument("inputs: expected (" + std::to_string(signals.output.size()) + ", " +
                                std::to_string(network.inputs()) + ") to go with the output, got (" +
                                std::to_string(signals.inputs.rows()) + ", " + std::to_string(signals.inputs.cols()) + ")");
  }
}

Vector simulate(const RecurrentNetwork& network, const Eigen::Ref<const RowMatrix>& inputs) {
  RecurrentRun run(network);
  Vector output(inputs.rows());
  for (Eigen::Index n = 0; n < inputs.rows(); ++n) {
    output[n] = run.advance(inputs.row(n).data());
  }
  return output;
}

RecurrentSensitivities sensitivities(const RecurrentNetwork& network, const Eigen::Ref<const RowMatrix>& inputs) {
  RecurrentRun run(network);
  RecurrentSensitivities out{Vector(inputs.rows()), RowMatrix(inputs.rows(), network.theta().size())};
  for (Eigen::Index n = 0; n < inputs.rows(); ++n) {
    out.output[n] = run.advance(inputs.row(n).data());
    out.jacobian.row(n) = run.gradient();
  }
  return out;
}

double mean_squared_error(const RecurrentNetwork& network, const RecurrentSignals& signals) {
  check(network, signals);
  return (signals.output - simulate(network, signals.inputs)).squaredNorm() / static_cast<double>(signals.samples());
}

}  // namespace rwn
