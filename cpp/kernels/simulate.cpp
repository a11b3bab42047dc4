// One simulation kernel per instruction set; rwn/simulate.hpp chooses.
#include "rwn/simulate_kernel.hpp"

namespace rwn::RWN_ISA {

struct Tag {};

namespace {

// Two masses are rare: half as many widths are compiled for them.
#ifdef RWN_FEW_WIDTHS
constexpr int of_one_mass = 16, of_two_masses = 16;  // where it has to be compiled soon, not to run fast
#else
constexpr int of_one_mass = 4, of_two_masses = 8;
#endif

/// N derivatives, or a few more.
template <int N, Kind kind, int masses>
int run(const SimulationSlice& slice) {
  constexpr int step = masses == 2 ? of_two_masses : of_one_mass;
  constexpr int width = (N + step - 1) / step * step;
  return Simulation<Dual<width, Tag>, width, kind, masses>(slice).run();
}

template <int N>
int run(Kind kind, const SimulationSlice& slice) {
  if constexpr (N % RWN_VECTOR_WIDTH == 0) {
    if (kind == Kind::lti) return run<N, Kind::lti, 1>(slice);
    if (slice.masses == 2) return kind == Kind::dc ? run<N, Kind::dc, 2>(slice) : run<N, Kind::axis, 2>(slice);
    return kind == Kind::dc ? run<N, Kind::dc, 1>(slice) : run<N, Kind::axis, 1>(slice);
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
