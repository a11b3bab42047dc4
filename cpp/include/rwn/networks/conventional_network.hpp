// Conventional (static) wavelet network with several inputs and outputs, thesis section 2.2.
#pragma once

#include <Eigen/Core>

#include "rwn/numerics/aligned.hpp"
#include "rwn/kernels/conventional_network.hpp"
#include "rwn/networks/wavelets.hpp"

namespace rwn {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using RowMatrixRef = Eigen::Ref<const RowMatrix>;

/// Inputs and wanted outputs of a network, laid out for the kernels.
class Patterns {
 public:
  /// \param x (patterns, inputs)  \param y (patterns, outputs)
  Patterns(const RowMatrixRef& x, const RowMatrixRef& y);

  PatternsView view() const { return {count_, padded(count_), x_.data(), y_.data(), mask_.data()}; }
  int count() const { return count_; }
  int inputs() const { return inputs_; }
  int outputs() const { return outputs_; }
  auto outputs_matrix() const {  // (outputs, padded)
    return Eigen::Map<const RowMatrix>(y_.data(), outputs_, padded(count_));
  }

 private:
  int count_, inputs_, outputs_;
  AlignedVector x_, y_, mask_;
};

/// Sizes of a network and where each group starts in its parameter vector b, a, w, m, d.
struct ConventionalShape {
  int inputs, wavelets, outputs;

  int a() const { return outputs; }
  int w() const { return a() + outputs * inputs; }
  int m() const { return w() + outputs * wavelets; }
  int d() const { return m() + wavelets * inputs; }
  int size() const { return d() + wavelets * inputs; }
};

/// yhat_k = b_k + sum_j w_kj Phi_j + sum_i a_ki x_i, Phi_j = prod_i phi((x_i - m_ji) / d_ji) (2.4-2.5).
class ConventionalNetwork {
 public:
  /// \param parameters b, a (outputs, inputs), w (outputs, wavelets), m and d (wavelets, inputs), one after the other
  ConventionalNetwork(Wavelet wavelet, ConventionalShape shape, Eigen::VectorXd parameters);

  const Wavelet& wavelet() const { return wavelet_; }
  const ConventionalShape& shape() const { return shape_; }
  const Eigen::VectorXd& parameters() const { return parameters_; }
  Eigen::VectorXd& parameters() { return parameters_; }
  ConventionalView view() const;

  /// \return (patterns, outputs)
  RowMatrix output(const RowMatrixRef& x) const;
  /// Gradient of 1/2 sum_kp e_kp^2 (2.12) with respect to all parameters, (2.13-2.19) with m and d summed over outputs.
  Eigen::VectorXd gradient(const RowMatrixRef& x, const RowMatrixRef& y) const;
  /// dyhat/dtheta (2.23), rows ordered output by output: (outputs * patterns, parameters).
  Eigen::MatrixXd jacobian(const RowMatrixRef& x) const;

 private:
  Wavelet wavelet_;
  ConventionalShape shape_;
  Eigen::VectorXd parameters_;
};

/// Memory of a pass over all patterns, allocated once, and what the pass computes.
class Batch {
 public:
  Batch(const ConventionalShape& shape, const Patterns& patterns);

  /// Fills errors, wavelet values and slopes; returns the sum of squared errors.
  double evaluate(const ConventionalNetwork& network);
  /// sum e dyhat/dtheta at the last evaluated network: minus the gradient of 1/2 sum e^2.
  void descent(const ConventionalNetwork& network, Eigen::VectorXd& g);
  /// dyhat/dtheta at the last evaluated network, (outputs * patterns, parameters), without padding.
  void jacobian(const ConventionalNetwork& network, Eigen::MatrixXd& jacobian) const;
  /// Values of wavelet j at all patterns.
  auto phi(int j) const { return Eigen::Map<const Eigen::VectorXd>(phi_.data() + j * stride_, patterns_.count()); }
  /// y - yhat of output k at all patterns.
  auto error(int k) const { return Eigen::Map<const Eigen::VectorXd>(error_.data() + k * stride_, patterns_.count()); }
  auto input(int i) const {
    return Eigen::Map<const Eigen::VectorXd>(patterns_.view().x + i * stride_, patterns_.count());
  }
  auto target(int k) const {
    return Eigen::Map<const Eigen::VectorXd>(patterns_.view().y + k * stride_, patterns_.count());
  }
  /// dPhi_j/dz_ji at all patterns.
  auto slope(int j, int i) const {
    return Eigen::Map<const Eigen::VectorXd>(slope_.data() + (j * shape_.inputs + i) * stride_, patterns_.count());
  }

 private:
  BatchView view() { return {phi_.data(), slope_.data(), error_.data(), row_.data()}; }

  ConventionalShape shape_;
  const Patterns& patterns_;
  int stride_;
  AlignedVector phi_, slope_, error_, row_;
};

}  // namespace rwn
