// One training step per sample of the recurrent network (thesis eq. 3.1-3.19); built once per instruction set.
#include "rwn/kernels/recurrent_step.hpp"

#include "recurrent_bounds.hpp"
#include "with_wavelet.hpp"

namespace rwn::RWN_ISA {
namespace {

struct Unbounded {
  RWN_INLINE void include(long, Pack, Pack, Pack, Pack) {}
};
struct Bounded {
  const RecurrentBounds& thesis;
  WaveletBounds seen{};
  RWN_INLINE void include(long i, Pack w, Pack m, Pack c, Pack inverse_d) {
    seen.include(thesis, thesis.input[i], w, m, c, inverse_d);
  }
};

/// A run whose number of inputs is known where it is 1 (I = 1), the thesis's friction, and else read (I = 0).
template <class W, int I>
struct Run {
  W wavelet;
  RecurrentBlock& block;

  RWN_INLINE Run(RecurrentBlock& b, W w) : wavelet(w), block(b) {}
  RWN_INLINE long inputs() const { return I > 0 ? I : block.inputs; }
  RWN_INLINE double* vector(long p) const { return block.network + p * (kOutputRows + inputs() * kInputRows) * width; }
  RWN_INLINE static double* input(double* v, long i) { return v + (kOutputRows + i * kInputRows) * width; }

  /// phi (3.3) of one vector of wavelets at input i; with `Learn` V1-V3 (3.16-3.18) too. Returns phi.
  template <bool Learn, class B>
  RWN_INLINE Pack factor(double* at, long i, double x, Pack w, B& bounds) {
    const Pack m = load(at + kShape * width), d = load(at + (kShape + 1) * width), c = load(at + (kShape + 2) * width);
    const Pack before = load(at + kFactor * width);
    const Pack inverse_d = 1.0 / d;
    const Pack z = ((x - m) + c * before) * inverse_d;
    const Pack phi = wavelet.value(z);
    store(at + kFactor * width, phi);
    if constexpr (Learn) {
      const Pack slope = wavelet.derivative(z) * inverse_d;
      double* V = at + kRecursion * width;
      store(V, slope * (c * load(V) - 1.0));
      store(V + width, slope * (c * load(V + width) - z));
      store(V + 2 * width, slope * (c * load(V + 2 * width) + before));
      bounds.include(i, w, m, c, inverse_d);
    }
    return phi;
  }

  /// The derivatives by m, d, c (3.13-3.15) of one vector of wavelets: w times the other factors times V1-V3.
  RWN_INLINE void slopes(double* v, Pack w) {
    Pack behind = w;
    for (long i = inputs() - 1; i >= 0; --i) {
      double* at = input(v, i);
      const Pack others = inputs() == 1 ? behind : load(at + kAhead * width) * behind;
      for (int k = 0; k < 3; ++k) store(at + (kSlopes + k) * width, others * load(at + (kRecursion + k) * width));
      if (inputs() > 1) behind = behind * load(at + kFactor * width);
    }
  }

  /// y (3.1) for the inputs x; with `Learn` the derivatives of y.
  template <bool Learn, class B>
  RWN_INLINE double output(const double* x, B& bounds) {
    Pack total{0.0};
    for (long p = 0; p < block.vectors; ++p) {
      double* v = vector(p);
      const Pack w = load(v + kWeightRow * width);
      Pack product{1.0};
      for (long i = 0; i < inputs(); ++i) {
        if (Learn && inputs() > 1) store(input(v, i) + kAhead * width, product);
        const Pack phi = factor<Learn>(input(v, i), i, x[i], w, bounds);
        product = inputs() == 1 ? phi : product * phi;
      }
      total += w * product;
      if constexpr (Learn) {
        store(v + kProduct * width, product);
        slopes(v, w);
      }
    }
    double y = block.linear[0];
    for (long i = 0; i < inputs(); ++i) y += block.linear[1 + i] * x[i];
    return y + sum(total);
  }

  /// theta += mu e dy/dtheta (3.19), at the inputs x.
  RWN_INLINE void correct(const double* x, const double* mu, double error) {
    block.linear[0] += mu[kBias] * error;
    const double direct = mu[kDirect] * error;
    for (long i = 0; i < inputs(); ++i) block.linear[1 + i] += direct * x[i];
    const Pack output_step = mu[kOutput] * error;
    const Pack step[3] = {mu[kShift] * error, mu[kScale] * error, mu[kLoop] * error};
    for (long p = 0; p < block.vectors; ++p) {
      double* v = vector(p);
      store(v + kWeightRow * width, load(v + kWeightRow * width) + output_step * load(v + kProduct * width));
      for (long i = 0; i < inputs(); ++i) {
        double* at = input(v, i);
        for (int k = 0; k < 3; ++k) {
          store(at + (kShape + k) * width,
                load(at + (kShape + k) * width) + step[k] * load(at + (kSlopes + k) * width));
        }
      }
    }
  }
};

/// Calls body(Run) for the wavelet and the number of inputs of the block.
template <class Body>
RWN_INLINE auto with_run(RecurrentBlock& b, const Body& body) {
  return with_wavelet(b.wavelet, b.omega0, [&](const auto& w) {
    using W = std::remove_cvref_t<decltype(w)>;
    if (b.inputs == 1) {
      Run<W, 1> run{b, w};
      return body(run);
    }
    Run<W, 0> run{b, w};
    return body(run);
  });
}

double advance(RecurrentBlock& b, const double* x) {
  for (long i = 0; i < b.inputs; ++i) b.linear[1 + b.inputs + i] = x[i];
  return with_wavelet(b.wavelet, b.omega0, [&](const auto& w) {
    Unbounded none;
    Run<std::remove_cvref_t<decltype(w)>, 0> run{b, w};
    return run.template output<true>(x, none);
  });
}

void correct(RecurrentBlock& b, double error) {
  Run<GaussianDerivative, 0> run{b, {}};
  run.correct(b.linear + 1 + b.inputs, b.rates, error);
}

void simulate(RecurrentBlock& b, const RecurrentCycle& c, double* output) {
  with_run(b, [&](auto& run) {
    Unbounded none;
    for (long n = 0; n < c.samples; ++n) output[n] = run.template output<false>(c.inputs + n * c.stride, none);
  });
}

double train(RecurrentBlock& b, const RecurrentCycle& c) {
  return with_run(b, [&](auto& run) {
    Unbounded none;
    double squares = 0.0;
    for (long n = 0; n < c.samples; ++n) {
      const double* x = c.inputs + n * c.stride;
      const double error = c.output[n] - run.template output<true>(x, none);
      squares += error * error;
      run.correct(x, b.rates, error);
    }
    return squares;
  });
}

double train_thesis(RecurrentBlock& b, const RecurrentCycle& c, RecurrentBounds& shared) {
  RecurrentBounds t = shared;
  const double squares = with_run(b, [&](auto& run) {
    double sum_of_squares = 0.0;
    double rates[kRecurrentGroups];
    for (long n = 0; n < c.samples; ++n) {
      const double* x = c.inputs + n * c.stride;
      const double largest_input = see_inputs(t, x, run.inputs());
      Bounded bounds{t};
      const double error = c.output[n] - run.template output<true>(x, bounds);
      thesis_rates(t, largest_input, bounds.seen, rates);
      sum_of_squares += error * error;
      run.correct(x, rates, error);
    }
    return sum_of_squares;
  });
  shared = t;
  return squares;
}

}  // namespace

extern const RecurrentKernels recurrent_step;
const RecurrentKernels recurrent_step{width, advance, correct, simulate, train, train_thesis};

}  // namespace rwn::RWN_ISA
