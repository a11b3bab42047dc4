// The motor's difference equation with a recurrent wavelet network for the friction torque (thesis chapter 4).
#pragma once

#include <Eigen/Core>

#include "rwn/numerics/aligned.hpp"
#include "rwn/kernels/structured_step.hpp"
#include "rwn/networks/wavelets.hpp"

namespace rwn {

using Vector = Eigen::VectorXd;
using VectorRef = Eigen::Ref<const Vector>;
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Parameters of the structured network (eq. 4.6, 4.10), flat: theta = [v1..v5, w, m, d, c].
/// v1 = B, v2 = T/J, v3 = Kt = Kb, v4 = T/L, v5 = 1 - R T/L; each of w, m, d, c is (N_w).
class StructuredNetwork {
 public:
  static constexpr Eigen::Index linear = 5;

  /// \throws std::invalid_argument if theta is not (5 + 4 N_w), not finite or has a zero dilation.
  StructuredNetwork(Vector theta, Wavelet wavelet);

  Eigen::Index wavelets() const { return (theta_.size() - linear) / 4; }
  const Vector& theta() const { return theta_; }
  const Wavelet& wavelet() const { return wavelet_; }
  /// First parameter and number of parameters of a group.
  Eigen::Index offset(int group) const { return group < kWeight ? group : linear + (group - kWeight) * wavelets(); }
  Eigen::Index size(int group) const { return group < kWeight ? 1 : wavelets(); }
  auto group(int g) const { return theta_.segment(offset(g), size(g)); }
  /// State matrix A of eq. 4.6.
  Eigen::Matrix2d plant() const;

 private:
  Vector theta_;
  Wavelet wavelet_;
};

/// One recording: input voltage u and measured speed y, (n) each, and the state [speed, current] it starts from.
struct StructuredSignals {
  VectorRef input, speed;
  Eigen::Vector2d start{0.0, 0.0};
  Eigen::Index samples() const { return speed.size(); }
};

/// Workspace of one run: what the kernels read and write. Nothing is allocated after construction.
class StructuredRun {
 public:
  explicit StructuredRun(const StructuredNetwork& network);
  StructuredRun(const StructuredRun&) = delete;
  StructuredRun& operator=(const StructuredRun&) = delete;

  void load(const StructuredNetwork& network);
  void save(Vector& theta) const;                // parameters as they stand
  void restart(const Eigen::Vector2d& start);    // state of a cycle's first sample, sensitivities 0
  void want(bool electrical, bool friction);     // which sensitivities are carried besides those of v1, v2, v3
  void follow(bool carry) { block_.carry = carry; }

  void advance(double input, double speed) { kernels_.advance(block_, input, speed); }
  void correct(const double* rates, double error);
  double train(const StructuredSignals& s, const double* rates);        // sum of squared errors of the cycle
  double train_thesis(const StructuredSignals& s, ThesisBounds& bounds);
  void simulate(const StructuredSignals& s, double* output);

  double linear(int row) const { return linear_[static_cast<std::size_t>(row)]; }
  double network(int row, Eigen::Index j) const { return network_[at(row, j)]; }
  Eigen::Index wavelets() const { return wavelets_; }
  /// dx1/dtheta of eq. 4.13-4.28 (5 + 4 N_w), or dx2/dtheta.
  void speed_sensitivity(double* out) const { sensitivity(kP, kPNet, out); }
  void current_sensitivity(double* out) const { sensitivity(kQ, kQNet, out); }
  double speed() const { return linear(kX1); }
  /// Moves parameters and state together: theta += change, x += (dx/dtheta) change.
  void shift(const Vector& change);

 private:
  std::size_t at(int row, Eigen::Index j) const;
  void sensitivity(int linear_row, int network_row, double* out) const;
  StructuredCycle cycle(const StructuredSignals& s);

  const StructuredKernels& kernels_;
  Eigen::Index wavelets_;
  AlignedVector linear_, network_, rates_, squares_;
  StructuredBlock block_;
};

/// Simulated speed (n), the network fed with the measured speed, parameters frozen.
Vector simulate(const StructuredNetwork& network, const StructuredSignals& signals);

/// Simulated speed (n) and its derivative by every parameter (n, 5 + 4 N_w), parameters frozen.
struct StructuredSensitivities {
  Vector speed;
  RowMatrix jacobian;
};
StructuredSensitivities sensitivities(const StructuredNetwork& network, const StructuredSignals& signals);

/// Mean squared error of the frozen network over a recording.
double mean_squared_error(const StructuredNetwork& network, const StructuredSignals& signals);

/// \throws std::invalid_argument if input and speed differ in length or are shorter than two samples.
void check(const StructuredSignals& signals);

}  // namespace rwn
