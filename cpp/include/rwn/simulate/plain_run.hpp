// A run in which nothing but friction happens between samples, with its state in registers.
#pragma once

#include <cmath>

#include "rwn/simulate/simulation_slice.hpp"

namespace rwn {

/// Number of samples that stayed finite; each is shown by `show(k, state)`. `rest`: where it begins, and where friction
/// stops or holds it. `dry`: with friction.
template <bool dry, class S, class Integrator, class Show>
int plain_run(Integrator& integrator, typename Integrator::State& rest, const SimulationSlice& slice,
              const Show& show) {
  typename Integrator::State::Moving s = rest;  // its address goes nowhere, so that it stays in registers
  S steady = integrator.steady_acceleration(rest);
  for (int k = 0; k < slice.samples; ++k) {
    if (!std::isfinite(value_of(s.x[Integrator::w])) || !std::isfinite(value_of(s.position))) return k;
    show(k, s);
    if (k + 1 == slice.samples) break;
    const double h = slice.time[k + 1] - slice.time[k];
    const S input(slice.input[k]);
    if (!integrator.template slides_on<dry>(s, h, steady, input)) {
      static_cast<typename Integrator::State::Moving&>(rest) = s;
      integrator.advance(rest, S(h), input, 0.0);  // no term depends on the time
      steady = integrator.steady_acceleration(rest);
      s = rest;
    }
  }
  return slice.samples;
}

}  // namespace rwn
