#include "rwn/networks/trainers/pattern_descent.hpp"

namespace rwn {
namespace {

/// A network's parameters with the wavelets along the lanes, their last steps, and scratch.
class Lanes {
 public:
  Lanes(const ConventionalNetwork& network, const PatternDescent& options)
      : shape_(network.shape()), padded_(padded(shape_.wavelets)), block_(total(), 0.0), mask_(size(padded_), 0.0) {
    std::fill_n(mask_.begin(), shape_.wavelets, 1.0);
    double* p = block_.data();
    const auto take = [&p](int n) {
      double* start = p;
      p += padded(n);
      return start;
    };
    const int no = shape_.outputs;
    const int ni = shape_.inputs;
    view_ = {.wavelet = network.wavelet().index(),
             .omega0 = network.wavelet().omega0(),
             .inputs = ni,
             .wavelets = shape_.wavelets,
             .outputs = no,
             .padded = padded_,
             .b = take(no),
             .a = take(no * ni),
             .w = take(no * padded_),
             .m = take(ni * padded_),
             .d = take(ni * padded_),
             .step_b = take(no),
             .step_a = take(no * ni),
             .step_w = take(no * padded_),
             .step_m = take(ni * padded_),
             .step_d = take(ni * padded_),
             .z = take(ni * (padded_ + lanes)),
             .phi = take(padded_),
             .slope = take(ni * padded_),
             .error = take(no),
             .mask = mask_.data(),
             .rate = options.rate,
             .momentum = options.momentum,
             .shape_momentum = options.shape_momentum};
    std::fill_n(view_.d, ni * padded_, 1.0);
    copy(network.parameters(), [](double& lane, const double& flat) { lane = flat; });
  }

  const DescentView& view() const { return view_; }
  void read(Eigen::VectorXd& parameters) {
    copy(parameters, [](double& lane, double& flat) { flat = lane; });
  }

 private:
  static std::size_t size(int n) { return static_cast<std::size_t>(n); }
  std::size_t total() const {
    const int ni = shape_.inputs;
    const int no = shape_.outputs;
    return size(3 * padded(no) + 2 * padded(no * ni) + 2 * no * padded_ + 6 * ni * padded_ + padded(ni * lanes) +
                padded_);
  }

  template <class Parameters, class Move>
  void copy(Parameters& flat, Move move) {
    for (int k = 0; k < shape_.outputs; ++k) {
      move(view_.b[k], flat[k]);
      for (int i = 0; i < shape_.inputs; ++i) {
        move(view_.a[k * shape_.inputs + i], flat[shape_.a() + k * shape_.inputs + i]);
      }
      for (int j = 0; j < shape_.wavelets; ++j) {
        move(view_.w[k * padded_ + j], flat[shape_.w() + k * shape_.wavelets + j]);
      }
    }
    for (int j = 0; j < shape_.wavelets; ++j) {
      for (int i = 0; i < shape_.inputs; ++i) {
        move(view_.m[i * padded_ + j], flat[shape_.m() + j * shape_.inputs + i]);
        move(view_.d[i * padded_ + j], flat[shape_.d() + j * shape_.inputs + i]);
      }
    }
  }

  ConventionalShape shape_;
  int padded_;
  AlignedVector block_, mask_;
  DescentView view_;
};

}  // namespace

Training PatternDescent::train(ConventionalNetwork network, const RowMatrixRef& x, const RowMatrixRef& y) const {
  const Patterns patterns(x, y);
  Batch batch(network.shape(), patterns);  // refuses patterns of another shape
  Watch watch(mean_square(patterns), target, stall, iterations);
  Lanes run(network, *this);
  const double per_error = 1.0 / (patterns.count() * patterns.outputs());
  for (int n = 0; n < iterations; ++n) {
    const double squares = conventional_kernels().descend(run.view(), patterns.count(), x.data(), y.data());
    run.read(network.parameters());
    if (watch.stop(squares * per_error, network.parameters())) {
      break;
    }
  }
  return watch.finish(std::move(network), patterns);
}

}  // namespace rwn
