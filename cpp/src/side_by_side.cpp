// Several runs in the lanes of the vectors: the latency of one run's chain is hidden behind the others.
#include <algorithm>
#include <stdexcept>

#include "rwn/online_training.hpp"

namespace rwn {
namespace {

/// The blocks of `width` runs, filled from rows first, first+1, ... of theta (the last row is repeated to fill up).
class Batch {
 public:
  Batch(const Eigen::Ref<const RowMatrix>& theta, const Eigen::Ref<const RowMatrix>& rates, const Wavelet& wavelet,
        Eigen::Index first)
      : width_(structured_kernels().width), wavelets_((theta.cols() - StructuredNetwork::linear) / 4),
        linear_(size(kLinearRows)), network_(size(kNetworkRows * wavelets_)), rates_(size(kStructuredGroups)),
        squares_(size(1)) {
    block_ = {linear_.data(), network_.data(), wavelets_, wavelet.index(), wavelet.omega0(), rates_.data(), true,
              wavelets_ > 0,  false};
    block_.electrical = (rates.col(kV4).array() != 0.0).any() || (rates.col(kV5).array() != 0.0).any();
    for (Eigen::Index k = 0; k < width_; ++k) {
      const Eigen::Index row = std::min(first + k, theta.rows() - 1);
      put(theta.row(row), rates.row(row), k);
    }
  }

  void train(const StructuredSignals& s) {
    std::fill(linear_.begin() + kX1 * width_, linear_.end(), 0.0);
    std::fill_n(linear_.begin() + kX1 * width_, width_, s.start[0]);
    std::fill_n(linear_.begin() + kX2 * width_, width_, s.start[1]);
    for (Eigen::Index j = 0; j < wavelets_; ++j) {
      std::fill_n(network_.begin() + (j * kNetworkRows + kPhi) * width_, (kNetworkRows - kPhi) * width_, 0.0);
    }
    structured_kernels().train_side_by_side(block_, {s.input.data(), s.speed.data(), s.samples(), squares_.data()});
  }

  double squares(Eigen::Index lane) const { return squares_[static_cast<std::size_t>(lane)]; }
  void get(Eigen::Ref<RowMatrix> theta, Eigen::Index row, Eigen::Index lane) const {
    for (Eigen::Index k = 0; k < StructuredNetwork::linear; ++k) {
      theta(row, k) = linear_[static_cast<std::size_t>(k * width_ + lane)];
    }
    for (Eigen::Index k = 0; k < 4 * wavelets_; ++k) {
      theta(row, StructuredNetwork::linear + k) = network_[at(k, lane)];
    }
  }

 private:
  std::size_t size(Eigen::Index rows) const { return static_cast<std::size_t>(std::max<Eigen::Index>(rows, 1) * width_); }
  std::size_t at(Eigen::Index k, Eigen::Index lane) const {
    const Eigen::Index group = k / wavelets_;
    return static_cast<std::size_t>(((k % wavelets_) * kNetworkRows + kTheta + group) * width_ + lane);
  }
  template <class Row>
  void put(const Row& theta, const Row& rates, Eigen::Index lane) {
    for (Eigen::Index k = 0; k < StructuredNetwork::linear; ++k) {
      linear_[static_cast<std::size_t>(k * width_ + lane)] = theta[k];
    }
    for (Eigen::Index k = 0; k < 4 * wavelets_; ++k) {
      network_[at(k, lane)] = theta[StructuredNetwork::linear + k];
    }
    for (Eigen::Index g = 0; g < kStructuredGroups; ++g) {
      rates_[static_cast<std::size_t>(g * width_ + lane)] = rates[g];
    }
  }

  Eigen::Index width_, wavelets_;
  AlignedVector linear_, network_, rates_, squares_;
  StructuredBlock block_;
};

}  // namespace

SideBySide train_side_by_side(const Eigen::Ref<const RowMatrix>& theta, const Wavelet& wavelet,
                              const Eigen::Ref<const RowMatrix>& rates, const StructuredSignals& signals, int cycles) {
  check(signals);
  if (theta.rows() < 1 || rates.rows() != theta.rows() || rates.cols() != kStructuredGroups || cycles < 1) {
    throw std::invalid_argument("theta (N, 5 + 4 N_w), rates (N, 9) and cycles >= 1 are expected");
  }
  for (Eigen::Index row = 0; row < theta.rows(); ++row) {
    StructuredNetwork(theta.row(row), wavelet);  // checks the parameters
  }
  SideBySide out{RowMatrix(theta.rows(), theta.cols()), Vector(theta.rows())};
  const double first_error = signals.speed[0] - signals.start[0];
  const Eigen::Index width = structured_kernels().width;
  for (Eigen::Index first = 0; first < theta.rows(); first += width) {
    Batch batch(theta, rates, wavelet, first);
    for (int n = 0; n < cycles; ++n) {
      batch.train(signals);
    }
    for (Eigen::Index row = first; row < std::min(first + width, theta.rows()); ++row) {
      batch.get(out.theta, row, row - first);
      out.mse_learning[row] =
          (batch.squares(row - first) + first_error * first_error) / static_cast<double>(signals.samples());
    }
  }
  return out;
}

}  // namespace rwn
