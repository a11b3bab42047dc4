// One simulation kernel per instruction set; rwn/simulate/simulate.hpp chooses.
#include "rwn/simulate/simulate_kernel.hpp"

namespace rwn::RWN_ISA {

struct Tag {};

namespace {

#ifdef RWN_FEW_WIDTHS
constexpr bool few_widths = true;  // where it has to be compiled soon, not to run fast
#else
constexpr bool few_widths = false;
#endif

template <int N, class Drive, int masses>
int run_masses(const SimulationSlice& slice) {
  return Simulation<Dual<N, Tag>, N, Drive, masses>(slice).run();
}

template <int N>
int run(int drive, const SimulationSlice& slice) {
  return with_drive(drive, [&](auto d) {
    using Drive = decltype(d);
    if constexpr ((N == 0 || N == width_of_two_masses) && !Drive::coefficients) {
      if (slice.masses == 2) return run_masses<N, Drive, 2>(slice);
    }
    constexpr int whole =
        (N + RWN_VECTOR_WIDTH - 1) / RWN_VECTOR_WIDTH * RWN_VECTOR_WIDTH;  // vectors, the last half empty
    constexpr int width = N > 0 && few_widths ? width_for<Drive>(1000) : whole;
    if constexpr (width_for<Drive>(N) == N) return run_masses<width, Drive, 1>(slice);
    return 0;  // never called: no run of this drive asks for so many
  });
}

}  // namespace

/// Returns the number of samples that stayed finite.
int simulate_slice(int drive, const SimulationSlice& slice) {
  switch (slice.width) {
    case 0:
      return run<0>(drive, slice);
    case 4:
      return run<4>(drive, slice);
    case 8:
      return run<8>(drive, slice);
    case 12:
      return run<12>(drive, slice);
    default:
      return run<16>(drive, slice);
  }
}

}  // namespace rwn::RWN_ISA
