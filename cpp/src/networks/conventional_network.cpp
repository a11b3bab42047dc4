#include "rwn/networks/conventional_network.hpp"

#include <stdexcept>
#include <string>

namespace rwn {
namespace {

void expect(bool good, const std::string& message) {
  if (!good) {
    throw std::invalid_argument(message);
  }
}

/// One padded row per column of the matrix.
AlignedVector by_column(const RowMatrixRef& matrix) {
  const int stride = padded(static_cast<int>(matrix.rows()));
  AlignedVector out(static_cast<std::size_t>(stride * matrix.cols()), 0.0);
  for (Eigen::Index i = 0; i < matrix.cols(); ++i) {
    Eigen::Map<Eigen::VectorXd>(out.data() + i * stride, matrix.rows()) = matrix.col(i);
  }
  return out;
}

}  // namespace

Patterns::Patterns(const RowMatrixRef& x, const RowMatrixRef& y)
    : count_(static_cast<int>(x.rows())),
      inputs_(static_cast<int>(x.cols())),
      outputs_(static_cast<int>(y.cols())),
      x_(by_column(x)),
      y_(by_column(y)),
      mask_(static_cast<std::size_t>(padded(count_)), 0.0) {
  expect(x.rows() == y.rows(), "x and y must hold the same number of patterns, got " + std::to_string(x.rows()) +
                                   " and " + std::to_string(y.rows()));
  expect(count_ > 0, "at least one pattern is needed");
  std::fill_n(mask_.begin(), count_, 1.0);
}

ConventionalNetwork::ConventionalNetwork(Wavelet wavelet, ConventionalShape shape, Eigen::VectorXd parameters)
    : wavelet_(wavelet), shape_(shape), parameters_(std::move(parameters)) {
  expect(shape.inputs > 0 && shape.outputs > 0 && shape.wavelets >= 0,
         "a network needs at least one input and one output");
  expect(parameters_.size() == shape.size(), "a network with " + std::to_string(shape.inputs) + " inputs, " +
                                                 std::to_string(shape.wavelets) + " wavelets and " +
                                                 std::to_string(shape.outputs) + " outputs has " +
                                                 std::to_string(shape.size()) + " parameters, got " +
                                                 std::to_string(parameters_.size()));
}

ConventionalView ConventionalNetwork::view() const {
  const double* p = parameters_.data();
  return {wavelet_.index(), wavelet_.omega0(), shape_.inputs,   shape_.wavelets, shape_.outputs,
          p,                p + shape_.a(),    p + shape_.w(), p + shape_.m(),  p + shape_.d()};
}

RowMatrix ConventionalNetwork::output(const RowMatrixRef& x) const {
  const Patterns patterns(x, RowMatrix::Zero(x.rows(), shape_.outputs));
  Batch batch(shape_, patterns);
  batch.evaluate(*this);
  RowMatrix y(x.rows(), shape_.outputs);
  for (int k = 0; k < shape_.outputs; ++k) {
    y.col(k) = -batch.error(k);
  }
  return y;
}

Eigen::VectorXd ConventionalNetwork::gradient(const RowMatrixRef& x, const RowMatrixRef& y) const {
  const Patterns patterns(x, y);
  Batch batch(shape_, patterns);
  batch.evaluate(*this);
  Eigen::VectorXd g(shape_.size());
  batch.descent(*this, g);
  return -g;
}

Eigen::MatrixXd ConventionalNetwork::jacobian(const RowMatrixRef& x) const {
  const Patterns patterns(x, RowMatrix::Zero(x.rows(), shape_.outputs));
  Batch batch(shape_, patterns);
  batch.evaluate(*this);
  Eigen::MatrixXd out(shape_.outputs * x.rows(), shape_.size());
  batch.jacobian(*this, out);
  return out;
}

Batch::Batch(const ConventionalShape& shape, const Patterns& patterns)
    : shape_(shape),
      patterns_(patterns),
      stride_(padded(patterns.count())),
      phi_(static_cast<std::size_t>(shape.wavelets * stride_)),
      slope_(static_cast<std::size_t>(shape.wavelets * shape.inputs * stride_)),
      error_(static_cast<std::size_t>(shape.outputs * stride_)),
      row_(static_cast<std::size_t>(shape.inputs * lanes)) {
  expect(patterns.inputs() == shape.inputs, "the network has " + std::to_string(shape.inputs) +
                                                " inputs, the patterns " + std::to_string(patterns.inputs()));
  expect(patterns.outputs() == shape.outputs, "the network has " + std::to_string(shape.outputs) +
                                                  " outputs, the patterns " + std::to_string(patterns.outputs()));
}

double Batch::evaluate(const ConventionalNetwork& network) {
  return conventional_kernels().evaluate(network.view(), patterns_.view(), view());
}

void Batch::descent(const ConventionalNetwork& network, Eigen::VectorXd& g) {
  conventional_kernels().gradient(network.view(), patterns_.view(), view(), g.data());
}

void Batch::jacobian(const ConventionalNetwork& network, Eigen::MatrixXd& out) const {
  const ConventionalView n = network.view();
  const int count = patterns_.count();
  out.setZero();
  for (int k = 0; k < n.outputs; ++k) {
    auto block = out.middleRows(k * count, count);
    block.col(k).setOnes();
    for (int i = 0; i < n.inputs; ++i) {
      block.col(shape_.a() + k * n.inputs + i) = input(i);
    }
    for (int j = 0; j < n.wavelets; ++j) {
      const double w = n.w[k * n.wavelets + j];
      block.col(shape_.w() + k * n.wavelets + j) = phi(j);
      for (int i = 0; i < n.inputs; ++i) {
        const int at = j * n.inputs + i;
        block.col(shape_.m() + at) = (-w / n.d[at]) * slope(j, i);
        block.col(shape_.d() + at) =
            block.col(shape_.m() + at).cwiseProduct((input(i).array() - n.m[at]).matrix()) / n.d[at];
      }
    }
  }
}

}  // namespace rwn
