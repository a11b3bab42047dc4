// One simulation kernel per instruction set; rwn/simulate.hpp chooses.
#include "rwn/simulate_kernel.hpp"

namespace rwn::RWN_ISA {

struct Tag {};

namespace {

template <int N>
int run(Kind kind, const SimulationSlice& slice) {
  if constexpr (N % RWN_VECTOR_WIDTH == 0) {
    using S = Dual<N, Tag>;
    if (kind == Kind::lti) return Simulation<S, N, Kind::lti>(slice).run();
    if (slice.masses == 2) {
      constexpr int wide = (N + 7) / 8 * 8;  // two masses are rare: half as many widths are compiled
      using Wide = Dual<wide, Tag>;
      if (kind == Kind::dc) return Simulation<Wide, wide, Kind::dc, 2>(slice).run();
      return Simulation<Wide, wide, Kind::axis, 2>(slice).run();
    }
    if (kind == Kind::dc) return Simulation<S, N, Kind::dc>(slice).run();
    return Simulation<S, N, Kind::axis>(slice).run();
  }
  return 0;  // never called: narrower vectors hold so many without a rest
}

}  // namespace

/// Derivatives by so many (0, 4, 8, 12 or 16) `columns`; returns the number of samples that stayed finite.
int simulate_slice(Kind kind, int columns, const SimulationSlice& slice) {
  switch (columns) {
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
