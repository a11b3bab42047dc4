// The recurrent wavelet network (thesis chapter 3): wavelets with self-feedback, one output.
#pragma once

#include <Eigen/Core>

#include "rwn/kernels/recurrent_step.hpp"
#include "rwn/networks/structured_network.hpp"
#include "rwn/networks/wavelets.hpp"

namespace rwn {

/// Parameters of the recurrent network (eq. 3.1-3.4), flat: theta = [b, a, w, m, d, c] with a (N_i), w (N_w) and
/// m, d, c (N_w, N_i) row-major.
class RecurrentNetwork {
 public:
  /// \throws std::invalid_argument if theta does not have 1 + N_i + N_w + 3 N_w N_i finite entries, or a dilation is
  /// zero.
  RecurrentNetwork(Vector theta, Eigen::Index inputs, Wavelet wavelet);

  Eigen::Index inputs() const { return inputs_; }
  Eigen::Index wavelets() const { return (theta_.size() - 1 - inputs_) / (1 + 3 * inputs_); }
  const Vector& theta() const { return theta_; }
  const Wavelet& wavelet() const { return wavelet_; }
  Eigen::Index offset(int group) const;
  Eigen::Index size(int group) const;

 private:
  Vector theta_;
  Eigen::Index inputs_;
  Wavelet wavelet_;
};

/// One recording: inputs x (n, N_i) and the wanted output y (n).
struct RecurrentSignals {
  Eigen::Ref<const RowMatrix> inputs;
  VectorRef output;
  Eigen::Index samples() const { return output.size(); }
};

/// Workspace of one run: what the kernels read and write. Nothing is allocated after construction.
class RecurrentRun {
 public:
  explicit RecurrentRun(const RecurrentNetwork& network);
  RecurrentRun(const RecurrentRun&) = delete;
  RecurrentRun& operator=(const RecurrentRun&) = delete;

  /// phi and V1-V3 before the first sample: 0.
  void restart();
  /// Output for the inputs x (N_i) of the next sample (3.1-3.4); updates V1-V3 (3.16-3.18) and the gradient (3.7-3.15).
  double advance(const double* x);
  /// theta += rates e dy/dtheta (3.19).
  void correct(const double* rates, double error);
  /// A cycle of the two, with rates held or with the `thesis` rule at every sample; returns the sum of squared errors.
  /// The gradient is that of the last `advance`.
  double train(const RecurrentSignals& s, const double* rates);
  double train_thesis(const RecurrentSignals& s, RecurrentBounds& bounds);
  void simulate(const Eigen::Ref<const RowMatrix>& inputs, double* output);

  const Vector& theta() const { return theta_; }
  const Vector& gradient() const { return gradient_; }
  auto parameters(int group) const { return theta_.segment(network_.offset(group), network_.size(group)); }
  auto sensitivity(int group) const { return gradient_.segment(network_.offset(group), network_.size(group)); }
  const RecurrentNetwork& network() const { return network_; }

 private:
  std::size_t at(int row, Eigen::Index j) const;
  std::size_t at(Eigen::Index input, int row, Eigen::Index j) const;
  template <class F>
  void each(int output_row, int input_row, const F& f) const;
  void load();
  void save();
  RecurrentCycle cycle(const Eigen::Ref<const RowMatrix>& inputs, const double* output);

  RecurrentNetwork network_;  // shapes and wavelet; its parameters are those at the start
  const RecurrentKernels& kernels_;
  Vector theta_, gradient_;
  AlignedVector linear_, lanes_;
  long stride_ = 0;  // doubles between two vectors of wavelets
  RecurrentBlock block_{};
};

/// Output (n) with frozen parameters.
Vector simulate(const RecurrentNetwork& network, const Eigen::Ref<const RowMatrix>& inputs);
/// Output (n) and its derivative by every parameter (n, size of theta), parameters frozen.
struct RecurrentSensitivities {
  Vector output;
  RowMatrix jacobian;
};
RecurrentSensitivities sensitivities(const RecurrentNetwork& network, const Eigen::Ref<const RowMatrix>& inputs);
double mean_squared_error(const RecurrentNetwork& network, const RecurrentSignals& signals);
/// \throws std::invalid_argument if the lengths or the number of inputs do not fit.
void check(const RecurrentNetwork& network, const RecurrentSignals& signals);

}  // namespace rwn
