// What the steps of a simulation are made of, as far as it differs in cost.
#pragma once

namespace rwn {

struct StepCounts {
  long linear = 0, nonlinear = 0;                  // steps
  long series = 0, series_of_values = 0;           // parts of a length gone along (rwn/flow.hpp)
  long matrices = 0, matrices_of_values = 0;       // sets made for a length (rwn/operators.hpp)
};

/// In the units of rwn/work.hpp, of runs with N derivatives: fitted to what runs of all kinds took (a quarter of them
/// took less than 0.9 or more than 1.1 of it). A template like all of the kernels, so that no two of them share it.
template <class S, int N, int masses>
long cost_of(const StepCounts& c, int samples) {
  constexpr long linear = masses == 2 ? 55 + 7 * N : 10 + 8 * N;
  constexpr long nonlinear = masses == 2 ? 260 + 40 * N : 150 + 25 * N;
  constexpr long series = 90 + 28 * N, series_of_values = 90;
  constexpr long matrices = masses == 2 ? 1000 + 800 * N : 200 + 200 * N;
  constexpr long matrices_of_values = masses == 2 ? 450 : 220;
  return 20L * samples + linear * c.linear + nonlinear * c.nonlinear + series * c.series +
         series_of_values * c.series_of_values + matrices * c.matrices + matrices_of_values * c.matrices_of_values;
}

}  // namespace rwn
