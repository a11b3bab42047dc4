// One simulation kernel per instruction set; rwn/simulate.hpp chooses.
#include "rwn/simulate_kernel.hpp"

namespace rwn::RWN_ISA {

struct Tag {};

namespace {

#ifdef RWN_FEW_WIDTHS
constexpr int least_width = 16;  // where it has to be compiled soon, not to run fast
#else
constexpr int least_width = 4;
#endif

template <int N, Kind kind, int masses>
int run(const SimulationSlice& slice) {
  return Simulation<Dual<N, Tag>, N, kind, masses>(slice).run();
}

template <int N>
int run(Kind kind, const SimulationSlice& slice) {
  if constexpr (N == 0 || N == width_of_two_masses) {
    if (slice.masses == 2) return kind == Kind::dc ? run<N, Kind::dc, 2>(slice) : run<N, Kind::axis, 2>(slice);
  }
  if constexpr (N % RWN_VECTOR_WIDTH == 0) {
    constexpr int width = N == 0 || N > least_width ? N : least_width;
    if (kind == Kind::lti) return run<width, Kind::lti, 1>(slice);
    return kind == Kind::dc ? run<width, Kind::dc, 1>(slice) : run<width, Kind::axis, 1>(slice);
  }
  return 0;  // never called: narrower vectors hold so many without a rest
}

}  // namespace

/// Returns the number of samples that stayed finite.
int simulate_slice(Kind kind, const SimulationSlice& slice) {
  switch (slice.width) {
    case 0:
      return run<0>(kind, slice);
    case 4:
      return run<4>(kind, slice);
    case 8:
      return run<8>(kind, slice);
    case 12:
      return run<12>(kind, slice);
    default:
      return run<16>(kind, slice);
  }
}

}  // namespace rwn::RWN_ISA
