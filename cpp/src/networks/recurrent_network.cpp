#include "rwn/networks/recurrent_network.hpp"

#include <algorithm>
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
    : network_(network), kernels_(recurrent_kernels()), theta_(network.theta()), gradient_(theta_.size()),
      linear_(static_cast<std::size_t>(1 + 2 * network.inputs())) {
  const long width = kernels_.width;
  const long vectors = (network.wavelets() + width - 1) / width;
  stride_ = (kOutputRows + network.inputs() * kInputRows) * width;
  lanes_.resize(static_cast<std::size_t>(vectors * stride_));
  block_ = {linear_.data(),
            lanes_.data(),
            vectors,
            network.inputs(),
            network.wavelet().index(),
            network.wavelet().omega0(),
            {}};
  for (Eigen::Index j = 0; j < vectors * width; ++j) {
    for (Eigen::Index i = 0; i < network.inputs(); ++i) {
      lanes_[at(i, kShape, j)] = kPaddingTranslation;
      lanes_[at(i, kShape + 1, j)] = kPaddingDilation;
    }
  }
  load();
}

std::size_t RecurrentRun::at(int row, Eigen::Index j) const {
  const Eigen::Index width = kernels_.width;
  return static_cast<std::size_t>((j / width) * stride_ + row * width + j % width);
}

std::size_t RecurrentRun::at(Eigen::Index input, int row, Eigen::Index j) const {
  return at(static_cast<int>(kOutputRows + input * kInputRows + row), j);
}

/// Calls f(index in the flat vector, place in the lanes) for w, m, d, c or for the derivatives by them.
template <class F>
void RecurrentRun::each(int output_row, int input_row, const F& f) const {
  for (Eigen::Index j = 0; j < network_.wavelets(); ++j) {
    f(network_.offset(kOutput) + j, at(output_row, j));
    for (int k = 0; k < 3; ++k) {
      for (Eigen::Index i = 0; i < network_.inputs(); ++i) {
        f(network_.offset(kShift + k) + j * network_.inputs() + i, at(i, input_row + k, j));
      }
    }
  }
}

void RecurrentRun::load() {
  std::copy_n(theta_.data(), 1 + network_.inputs(), linear_.begin());
  each(kWeightRow, kShape, [&](Eigen::Index k, std::size_t lane) { lanes_[lane] = theta_[k]; });
}

void RecurrentRun::save() {
  std::copy_n(linear_.begin(), 1 + network_.inputs(), theta_.data());
  each(kWeightRow, kShape, [&](Eigen::Index k, std::size_t lane) { theta_[k] = lanes_[lane]; });
}

void RecurrentRun::restart() {
  const long width = kernels_.width;
  for (long p = 0; p < block_.vectors; ++p) {
    for (long i = 0; i < block_.inputs; ++i) {
      const auto first = lanes_.begin() + p * stride_ + (kOutputRows + i * kInputRows + kFactor) * width;
      std::fill(first, first + (kInputRows - kFactor) * width, 0.0);
    }
  }
}

double RecurrentRun::advance(const double* x) {
  const double y = kernels_.advance(block_, x);
  gradient_[0] = 1.0;
  std::copy_n(x, network_.inputs(), gradient_.data() + 1);
  each(kProduct, kSlopes, [&](Eigen::Index k, std::size_t lane) { gradient_[k] = lanes_[lane]; });
  return y;
}

void RecurrentRun::correct(const double* rates, double error) {
  std::copy_n(rates, kRecurrentGroups, block_.rates);
  kernels_.correct(block_, error);
  save();
}

RecurrentCycle RecurrentRun::cycle(const Eigen::Ref<const RowMatrix>& inputs, const double* output) {
  restart();
  return {inputs.data(), inputs.outerStride(), output, inputs.rows()};
}

double RecurrentRun::train(const RecurrentSignals& s, const double* rates) {
  std::copy_n(rates, kRecurrentGroups, block_.rates);
  const double squares = kernels_.train(block_, cycle(s.inputs, s.output.data()));
  save();
  return squares;
}

double RecurrentRun::train_thesis(const RecurrentSignals& s, RecurrentBounds& bounds) {
  const double squares = kernels_.train_thesis(block_, cycle(s.inputs, s.output.data()), bounds);
  save();
  return squares;
}

void RecurrentRun::simulate(const Eigen::Ref<const RowMatrix>& inputs, double* output) {
  kernels_.simulate(block_, cycle(inputs, nullptr), output);
}

void check(const RecurrentNetwork& network, const RecurrentSignals& signals) {
  if (signals.inputs.cols() != network.inputs() || signals.inputs.rows() != signals.output.size() ||
      signals.output.size() < 1) {
    throw std::invalid_argument("inputs: expected (" + std::to_string(signals.output.size()) + ", " +
                                std::to_string(network.inputs()) + ") to go with the output, got (" +
                                std::to_string(signals.inputs.rows()) + ", " + std::to_string(signals.inputs.cols()) +
                                ")");
  }
}

Vector simulate(const RecurrentNetwork& network, const Eigen::Ref<const RowMatrix>& inputs) {
  RecurrentRun run(network);
  Vector output(inputs.rows());
  run.simulate(inputs, output.data());
  return output;
}

RecurrentSensitivities sensitivities(const RecurrentNetwork& network, const Eigen::Ref<const RowMatrix>& inputs) {
  RecurrentRun run(network);
  run.restart();
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
