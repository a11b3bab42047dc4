// The sums of normal_equations.hpp, several samples at a time: each sum is fetched once for all of them.
#include "rwn/kernels/normal_equations.hpp"

#include <cmath>

#include "rwn/numerics/pack.hpp"

namespace rwn::RWN_ISA {
namespace {

/// Adds the samples in `room`, whose errors are `error`.
void add(NormalSlice& s, const double* error) {
  constexpr int block = NormalSlice::block;
  for (int i = 0; i < s.columns; ++i) {
    double* sums = s.curvature + i * s.stride;
    for (int r = 0; r < block; ++r) s.gradient[i] += s.room[r * s.stride + i] * error[r];
    for (int j = 0; j <= i; j += width) {
      Pack sum = load(sums + j);
      for (int r = 0; r < block; ++r) sum += s.room[r * s.stride + i] * load(s.room + r * s.stride + j);
      store(sums + j, sum);
    }
  }
}

}  // namespace

void accumulate(NormalSlice& s) {
  constexpr int block = NormalSlice::block;
  double error[block];
  int filled = 0;
  for (int k = 0; k < s.rows; ++k) {
    const double e = s.weight * s.errors[k];
    if (std::isnan(e)) continue;
    s.chi2 += e * e;
    ++s.count;
    if (s.columns == 0) continue;
    const double* from = s.slopes + static_cast<long>(k) * s.columns;
    double* to = s.room + filled * s.stride;
    for (int j = 0; j < s.columns; ++j) to[j] = s.weight * from[j];
    error[filled++] = e;
    if (filled == block) {
      add(s, error);
      filled = 0;
    }
  }
  if (filled == 0) return;
  for (int r = filled; r < block; ++r) {
    error[r] = 0.0;
    for (int j = 0; j < s.columns; ++j) s.room[r * s.stride + j] = 0.0;
  }
  add(s, error);
}

}  // namespace rwn::RWN_ISA
