#include "rwn/kernels/conventional_network.hpp"

#include "rwn/numerics/pack.hpp"
#include "with_wavelet.hpp"

namespace rwn::RWN_ISA {
namespace {

/// Phi = prod_i phi(z_i) (2.5), returned; slope_i = phi'(z_i) prod_{l != i} phi(z_l) (2.19), by products from both
/// ends.
template <class W, class Z>
RWN_INLINE Pack product(const W& wavelet, int inputs, const Z& z, double* row, double* slope, int stride) {
  Pack before = 1.0;
  for (int i = 0; i < inputs; ++i) {
    const Pack zi = z(i);
    const Pack value = wavelet.value(zi);
    store(slope + i * stride, before * wavelet.derivative(zi));
    store(row + i * width, value);
    before = before * value;
  }
  Pack after = 1.0;
  for (int i = inputs - 1; i > 0; --i) {
    after = after * load(row + i * width);
    store(slope + (i - 1) * stride, load(slope + (i - 1) * stride) * after);
  }
  return before;
}

template <class W>
double evaluate_with(const W& wavelet, const ConventionalView& n, const PatternsView& patterns,
                     const BatchView& batch) {
  const int stride = patterns.padded;
  Pack squares = 0.0;
  for (int p = 0; p < stride; p += width) {
    for (int k = 0; k < n.outputs; ++k) {
      Pack linear = n.b[k];
      for (int i = 0; i < n.inputs; ++i) {
        linear += Pack(n.a[k * n.inputs + i]) * load(patterns.x + i * stride + p);
      }
      store(batch.error + k * stride + p, load(patterns.y + k * stride + p) - linear);
    }
    for (int j = 0; j < n.wavelets; ++j) {
      const double* m = n.m + j * n.inputs;
      const double* d = n.d + j * n.inputs;
      const auto z = [&](int i) { return (load(patterns.x + i * stride + p) - m[i]) / Pack(d[i]); };
      const Pack phi = product(wavelet, n.inputs, z, batch.row, batch.slope + j * n.inputs * stride + p, stride);
      store(batch.phi + j * stride + p, phi);
      for (int k = 0; k < n.outputs; ++k) {
        double* error = batch.error + k * stride + p;
        store(error, load(error) - Pack(n.w[k * n.wavelets + j]) * phi);
      }
    }
    for (int k = 0; k < n.outputs; ++k) {
      double* error = batch.error + k * stride + p;
      const Pack e = load(error) * load(patterns.mask + p);
      store(error, e);
      squares += e * e;
    }
  }
  return sum(squares);
}

double evaluate(const ConventionalView& n, const PatternsView& patterns, const BatchView& batch) {
  return with_wavelet(n.wavelet, n.omega0, [&](const auto& w) { return evaluate_with(w, n, patterns, batch); });
}

RWN_INLINE double dot(const double* u, const double* v, int padded) {
  Pack s = 0.0;
  for (int p = 0; p < padded; p += width) {
    s += load(u + p) * load(v + p);
  }
  return sum(s);
}

/// The m and d gradients of one wavelet and input (2.17, 2.18), summed over outputs.
void shape_gradient(const ConventionalView& n, const PatternsView& patterns, const BatchView& batch, int j, int i,
                    double* gm, double* gd) {
  const int stride = patterns.padded;
  const int at = j * n.inputs + i;
  const double* slope = batch.slope + at * stride;
  Pack sm = 0.0;
  Pack sd = 0.0;
  for (int p = 0; p < stride; p += width) {
    Pack back = 0.0;
    for (int k = 0; k < n.outputs; ++k) {
      back += load(batch.error + k * stride + p) * Pack(n.w[k * n.wavelets + j]);
    }
    back = back * load(slope + p);
    sm += back;
    sd += back * (load(patterns.x + i * stride + p) - Pack(n.m[at]));
  }
  const double inverse = -1.0 / n.d[at];
  gm[at] = sum(sm) * inverse;
  gd[at] = sum(sd) * inverse / n.d[at];
}

void gradient(const ConventionalView& n, const PatternsView& patterns, const BatchView& batch, double* g) {
  double* ga = g + n.outputs;
  double* gw = ga + n.outputs * n.inputs;
  double* gm = gw + n.outputs * n.wavelets;
  double* gd = gm + n.wavelets * n.inputs;
  const int stride = patterns.padded;
  for (int k = 0; k < n.outputs; ++k) {
    const double* error = batch.error + k * stride;
    g[k] = dot(error, patterns.mask, stride);
    for (int i = 0; i < n.inputs; ++i) {
      ga[k * n.inputs + i] = dot(error, patterns.x + i * stride, stride);
    }
    for (int j = 0; j < n.wavelets; ++j) {
      gw[k * n.wavelets + j] = dot(error, batch.phi + j * stride, stride);
    }
  }
  for (int j = 0; j < n.wavelets; ++j) {
    for (int i = 0; i < n.inputs; ++i) {
      shape_gradient(n, patterns, batch, j, i, gm, gd);
    }
  }
}

/// Network output errors for one pattern; leaves z, phi and slope in the view.
template <class W>
RWN_INLINE double pattern_errors(const W& wavelet, const DescentView& s, const double* x, const double* y) {
  double* row = s.z + s.inputs * s.padded;
  for (int j = 0; j < s.padded; j += width) {
    const auto z = [&](int i) {
      const Pack zi = (Pack(x[i]) - load(s.m + i * s.padded + j)) / load(s.d + i * s.padded + j);
      store(s.z + i * s.padded + j, zi);
      return zi;
    };
    store(s.phi + j, product(wavelet, s.inputs, z, row, s.slope + j, s.padded) * load(s.mask + j));
  }
  double squares = 0.0;
  for (int k = 0; k < s.outputs; ++k) {
    double output = s.b[k] + dot(s.w + k * s.padded, s.phi, s.padded);
    for (int i = 0; i < s.inputs; ++i) {
      output += s.a[k * s.inputs + i] * x[i];
    }
    s.error[k] = y[k] - output;
    squares += s.error[k] * s.error[k];
  }
  return squares;
}

RWN_INLINE void move(double* theta, double* step, double descent, double momentum) {
  *step = descent + momentum * *step;
  *theta += *step;
}

RWN_INLINE void move(double* theta, double* step, Pack descent, double momentum) {
  const Pack s = descent + Pack(momentum) * load(step);
  store(step, s);
  store(theta, load(theta) + s);
}

/// Step (2.20) of the translations and dilations; it uses the weights of before the update.
RWN_INLINE void move_shapes(const DescentView& s) {
  for (int j = 0; j < s.padded; j += width) {
    Pack back = 0.0;
    for (int k = 0; k < s.outputs; ++k) {
      back += Pack(s.error[k]) * load(s.w + k * s.padded + j);
    }
    back = back * Pack(-s.rate);
    for (int i = 0; i < s.inputs; ++i) {
      const int at = i * s.padded + j;
      const Pack down = back * load(s.slope + at) / load(s.d + at);
      move(s.m + at, s.step_m + at, down, s.shape_momentum);
      move(s.d + at, s.step_d + at, down * load(s.z + at), s.shape_momentum);
    }
  }
}

RWN_INLINE void move_weights(const DescentView& s, const double* x) {
  for (int k = 0; k < s.outputs; ++k) {
    const double push = s.rate * s.error[k];
    move(s.b + k, s.step_b + k, push, s.momentum);
    for (int i = 0; i < s.inputs; ++i) {
      move(s.a + k * s.inputs + i, s.step_a + k * s.inputs + i, push * x[i], s.momentum);
    }
    for (int j = 0; j < s.padded; j += width) {
      const int at = k * s.padded + j;
      move(s.w + at, s.step_w + at, Pack(push) * load(s.phi + j), s.momentum);
    }
  }
}

template <class W>
double descend_with(const W& wavelet, const DescentView& s, int count, const double* x, const double* y) {
  double squares = 0.0;
  for (int p = 0; p < count; ++p, x += s.inputs, y += s.outputs) {
    squares += pattern_errors(wavelet, s, x, y);
    move_shapes(s);
    move_weights(s, x);
  }
  return squares;
}

double descend(const DescentView& s, int count, const double* x, const double* y) {
  return with_wavelet(s.wavelet, s.omega0, [&](const auto& w) { return descend_with(w, s, count, x, y); });
}

}  // namespace

extern const ConventionalKernels conventional_network;
const ConventionalKernels conventional_network{evaluate, gradient, descend};

}  // namespace rwn::RWN_ISA
