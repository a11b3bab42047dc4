// What the steps of a simulation are made of, as far as it differs in cost.
#pragma once

namespace rwn {

struct StepCounts {
  long linear = 0, nonlinear = 0;             // steps
  long electrical = 0;                        // nonlinear ones of a winding whose equation is not that of R, L and Ke
  long series = 0, series_of_values = 0;      // parts of a length gone along (rwn/numerics/flow.hpp)
  long matrices = 0, matrices_of_values = 0;  // sets of phi functions (rwn/numerics/exponential.hpp)
  long between = 0;                           // steps whose matrices lie between those of a grid
};

/// Cost, in the units of rwn/simulate/work.hpp, of a run with n states and with the derivatives that were asked for
/// (those that a kernel adds to fill its vectors differ by machine). Fitted to the times of runs of all kinds, within a
/// quarter for most; sets of phi functions count as if each were made by itself with every derivative, which costs up
/// to twice as much as they do. A template, as all that kernels call, so that each instruction set has its own.
template <class S, int n>
long cost_of(const StepCounts& c, int samples, int derivatives) {
  const long N = derivatives;
  const long linear = n > 2 ? 15 + 13 * N : 8 + 8 * N;
  const long nonlinear = n > 2 ? 250 + 40 * N : 130 + 30 * N;
  const long electrical = 80 + 25 * N;
  const long series_of_values = 90, series = 90 + 28 * N;
  const long matrices_of_values = 6 * n * n * n + 20 * n, matrices = matrices_of_values * (1 + N);
  const long between = 6 * n * n * (5 + N);
  return 20L * samples + between * c.between + linear * c.linear + nonlinear * c.nonlinear + electrical * c.electrical +
         series * c.series + series_of_values * c.series_of_values + matrices * c.matrices +
         matrices_of_values * c.matrices_of_values;
}

}  // namespace rwn
