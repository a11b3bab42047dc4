#include "rwn/fit/normal_equations.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rwn/fit/innovations.hpp"
#include "rwn/numerics/aligned.hpp"
#include "rwn/numerics/isa.hpp"
#include "rwn/kernels/normal_equations.hpp"

namespace rwn {

namespace baseline {
void accumulate(NormalSlice& slice);
}
#ifdef RWN_AVX2
namespace avx2 {
void accumulate(NormalSlice& slice);
}
#endif
#ifdef RWN_AVX512
namespace avx512 {
void accumulate(NormalSlice& slice);
}
#endif

namespace {

void accumulate(NormalSlice& slice) {
#ifdef RWN_AVX512
  if (isa() == Isa::avx512) return avx512::accumulate(slice);
#endif
#ifdef RWN_AVX2
  if (isa() == Isa::avx2) return avx2::accumulate(slice);
#endif
  return baseline::accumulate(slice);
}

}  // namespace

NormalEquations normal_equations(const SimulationTask& task, const Measurements& measured) {
  const std::size_t n = task.time.size();
  const std::size_t p = task.by.size();
  const bool differs = !measured.speed.empty() && measured.speed_measurement.is_difference();
  const bool wants_position = !measured.position.empty() || differs;
  const auto room = [&](bool wanted, std::size_t width) { return std::vector<double>(wanted ? n * width : 0); };
  std::vector<double> current = room(!measured.current.empty(), 1), d_current = room(!measured.current.empty(), p);
  std::vector<double> speed = room(!measured.speed.empty(), 1), d_speed = room(!measured.speed.empty(), p);
  std::vector<double> position = room(wants_position, 1), d_position = room(wants_position, p);

  NormalEquations sum;
  sum.gradient.assign(p, 0.0);
  sum.curvature.assign(p * p, 0.0);
  sum.status = simulate(task, {current, speed, position, d_current, d_speed, d_position});
  if (differs) {
    difference(measured.speed_measurement, task.time, position, speed, 1);
    difference(measured.speed_measurement, task.time, d_position, d_speed, p);
  }
  const int columns = static_cast<int>(p), stride = padded(columns);
  const auto row = static_cast<std::size_t>(stride);
  AlignedVector block(NormalSlice::block * row), lower(p * row);
  const auto every = static_cast<std::size_t>(std::max(task.restart_every, 0));
  const auto add = [&](std::span<const double> recorded, std::vector<double>& simulated, std::vector<double>& slopes,
                       double weight, const std::vector<double>& reflection) {
    std::vector<double>& errors = simulated;
    for (std::size_t k = 0; k < recorded.size(); ++k) errors[k] = recorded[k] - simulated[k];
    innovations(errors, reflection, every, slopes);
    NormalSlice slice{.errors = errors.data(),
                      .slopes = slopes.data(),
                      .rows = static_cast<int>(recorded.size()),
                      .columns = columns,
                      .weight = weight,
                      .stride = stride,
                      .room = block.data(),
                      .gradient = sum.gradient.data(),
                      .curvature = lower.data(),
                      .chi2 = 0.0,
                      .count = 0};
    accumulate(slice);
    sum.chi2 += slice.chi2;
    sum.count += slice.count;
  };
  add(measured.current, current, d_current, measured.current_weight, measured.reflection[0]);
  add(measured.speed, speed, d_speed, measured.speed_weight, measured.reflection[1]);
  add(measured.position, position, d_position, measured.position_weight, measured.reflection[2]);
  for (std::size_t i = 0; i < p; ++i) {
    for (std::size_t j = 0; j <= i; ++j) sum.curvature[i * p + j] = sum.curvature[j * p + i] = lower[i * row + j];
  }
  return sum;
}

}  // namespace rwn
