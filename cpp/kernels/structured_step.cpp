// One training step per sample of the structured network; built once per instruction set.
#include "structured_run.hpp"
#include "structured_side_by_side.hpp"

namespace rwn::RWN_ISA {
namespace {

/// Calls body(Run) for the wavelet of the block, with the number of vectors known at compile time where it is usual.
template <class Body>
RWN_INLINE void with_run(StructuredBlock& b, const Body& body) {
  constexpr int usual = 16 / width;  // 9 to 16 wavelets, the thesis's choice
  with_wavelet(b.wavelet, b.omega0, [&](const auto& w) {
    using W = std::remove_cvref_t<decltype(w)>;
    if (b.vectors == usual) {
      Run<W, double, usual> run{b, w};
      body(run);
      run.save();
    } else {
      Run<W, double, 0> run{b, w};
      body(run);
      run.save();
    }
  });
}

void advance(StructuredBlock& b, double input, double speed) {
  with_wavelet(b.wavelet, b.omega0, [&](const auto& w) {
    NoBounds none;
    Run<std::remove_cvref_t<decltype(w)>, double, 0> run{b, w};
    run.advance(input, speed, none);
    run.save();
  });
}

void correct(StructuredBlock& b, double error) {
  Run<GaussianDerivative, double, 0> run{b, {}};
  b.carry ? run.template correct<true>(error, b.rates) : run.template correct<false>(error, b.rates);
  run.save();
}

void simulate(StructuredBlock& b, const StructuredCycle& c, double* output) {
  with_run(b, [&](auto& run) {
    NoBounds none;
    run.plant();
    output[0] = run.x1;
    for (long n = 1; n < c.samples; ++n) {
      run.torque(c.speed[n - 1], none);
      run.move(c.input[n - 1]);
      output[n] = run.x1;
    }
  });
}

template <bool Carry>
void train_held(StructuredBlock& b, const StructuredCycle& c) {
  with_run(b, [&](auto& run) {
    NoBounds none;
    double squares = 0.0;
    for (long n = 1; n < c.samples; ++n) {
      run.advance(c.input[n - 1], c.speed[n - 1], none);
      const double error = c.speed[n] - run.x1;
      squares += error * error;
      run.template correct<Carry>(error, b.rates);
    }
    *c.squared_error = squares;
  });
}

void train(StructuredBlock& b, const StructuredCycle& c) { b.carry ? train_held<true>(b, c) : train_held<false>(b, c); }

/// Decompose: cond(M) and rho(A) by the function of the bounds. A call, even one that is not taken, costs the loop its
/// registers, so the loop without it is compiled by itself.
template <bool Carry, bool Decompose>
void train_bounded(StructuredBlock& b, const StructuredCycle& c, ThesisBounds& shared) {
  ThesisBounds t = shared;
  with_run(b, [&](auto& run) {
    double squares = 0.0;
    for (long n = 1; n < c.samples; ++n) {
      const double u = c.input[n - 1], speed = c.speed[n - 1];
      const double x1 = run.x1, x2 = run.x2;
      t.input = max(t.input, magnitude(speed));
      WithBounds bounds{t};
      run.advance(u, speed, bounds);
      see_signals(t, x1, x2, u, run.tau);
      const PlantGain gain = Decompose ? t.decompose(run.a11, run.a12, run.a21, run.a22)
                                       : plant_gain(run.a11, run.a12, run.a21, run.a22);
      const double* rates = thesis_rates(t, run.v, gain, bounds.bounds, run.electrical, run.friction);
      const double error = c.speed[n] - run.x1;
      squares += error * error;
      run.template correct<Carry>(error, rates);
    }
    *c.squared_error = squares;
  });
  shared = t;
}

void train_thesis(StructuredBlock& b, const StructuredCycle& c, ThesisBounds& t) {
  if (t.decompose) {
    b.carry ? train_bounded<true, true>(b, c, t) : train_bounded<false, true>(b, c, t);
  } else {
    b.carry ? train_bounded<true, false>(b, c, t) : train_bounded<false, false>(b, c, t);
  }
}

void train_side_by_side(StructuredBlock& b, const StructuredCycle& c) {
  with_wavelet(b.wavelet, b.omega0, [&](const auto& w) {
    SideBySideRun<std::remove_cvref_t<decltype(w)>> run{b, w};
    Pack squares{0.0};
    for (long n = 1; n < c.samples; ++n) {
      run.advance(c.input[n - 1], c.speed[n - 1]);
      const Pack error = c.speed[n] - run.x1;
      squares += error * error;
      run.correct(error);
    }
    run.save();
    store(c.squared_error, squares);
  });
}

}  // namespace

extern const StructuredKernels structured_step;
const StructuredKernels structured_step{width, advance, correct, simulate, train, train_thesis, train_side_by_side};

}  // namespace rwn::RWN_ISA
