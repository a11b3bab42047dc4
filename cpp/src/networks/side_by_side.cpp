// Several runs in the lanes of the vectors: the latency of one run's chain is hidden behind the others.
#include "rwn/networks/side_by_side.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

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
  void get(Eigen::Index lane, Vector& theta) const {
    for (Eigen::Index k = 0; k < StructuredNetwork::linear; ++k) {
      theta[k] = linear_[static_cast<std::size_t>(k * width_ + lane)];
    }
    for (Eigen::Index k = 0; k < 4 * wavelets_; ++k) {
      theta[StructuredNetwork::linear + k] = network_[at(k, lane)];
    }
  }

 private:
  std::size_t size(Eigen::Index rows) const {
    return static_cast<std::size_t>(std::max<Eigen::Index>(rows, 1) * width_);
  }
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

/// What a lane has reached; a diverged one runs on in its lane, unheard.
struct Lane {
  Vector theta, next;
  double limit, mse = std::numeric_limits<double>::infinity();
  bool still = false, diverged = false;

  void see(double new_mse) {
    diverged = !(new_mse <= limit && next.allFinite() && usable());
    if (diverged) return;
    mse = new_mse;
    still = stands_still(theta, next);
    theta = next;
  }
  bool usable() const {
    const Eigen::Index wavelets = (next.size() - StructuredNetwork::linear) / 4;
    return (next.segment(StructuredNetwork::linear + 2 * wavelets, wavelets).array() != 0.0).all();
  }
};

void check_sizes(const Eigen::Ref<const RowMatrix>& theta, const Eigen::Ref<const RowMatrix>& rates, int cycles) {
  if (theta.rows() < 1 || rates.rows() != theta.rows() || rates.cols() != kStructuredGroups || cycles < 1) {
    throw std::invalid_argument("theta (N, 5 + 4 N_w), rates (N, 9) and cycles >= 1 are expected");
  }
}

}  // namespace

SideBySide train_side_by_side(const Eigen::Ref<const RowMatrix>& theta, const Wavelet& wavelet,
                              const Eigen::Ref<const RowMatrix>& rates, const StructuredSignals& signals, int cycles) {
  check(signals);
  check_sizes(theta, rates, cycles);
  const double samples = static_cast<double>(signals.samples());
  const double mean_square = signals.speed.squaredNorm() / samples;
  std::vector<Lane> runs;
  for (Eigen::Index row = 0; row < theta.rows(); ++row) {
    const Vector start = theta.row(row);
    const double first_mse = mean_squared_error({start, wavelet}, signals);
    runs.push_back({start, start, divergence_limit(mean_square, first_mse)});
  }
  const double first_error = signals.speed[0] - signals.start[0];
  const Eigen::Index width = structured_kernels().width;
  for (Eigen::Index first = 0; first < theta.rows(); first += width) {
    Batch batch(theta, rates, wavelet, first);
    for (int n = 0; n < cycles; ++n) {
      batch.train(signals);
      for (Eigen::Index row = first; row < std::min(first + width, theta.rows()); ++row) {
        Lane& lane = runs[static_cast<std::size_t>(row)];
        if (lane.diverged) continue;
        batch.get(row - first, lane.next);
        lane.see((batch.squares(row - first) + first_error * first_error) / samples);
      }
    }
  }
  SideBySide out{RowMatrix(theta.rows(), theta.cols()), Vector(theta.rows()), Vector(theta.rows()), {}};
  for (Eigen::Index row = 0; row < theta.rows(); ++row) {
    const Lane& lane = runs[static_cast<std::size_t>(row)];
    const StructuredNetwork network(lane.theta, wavelet);
    out.theta.row(row) = lane.theta;
    out.mse_learning[row] = lane.mse;
    out.mse_frozen[row] = mean_squared_error(network, signals);
    out.status.push_back(lane.diverged ? OnlineStatus::diverged
                                       : judge(network, lane.still, out.mse_frozen[row], mean_square));
  }
  return out;
}

}  // namespace rwn
