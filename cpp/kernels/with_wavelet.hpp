// From the index of a wavelet in rwn::Wavelets to its own type, once per call of a kernel.
#pragma once

#include "rwn/numerics/pack.hpp"
#include "rwn/networks/wavelets.hpp"

namespace rwn::RWN_ISA {

/// Calls f with the wavelet of that index.
template <int I = 0, class F>
RWN_INLINE auto with_wavelet(int index, double omega0, const F& f) {
  using W = std::tuple_element_t<I, Wavelets>;
  if constexpr (I + 1 < static_cast<int>(std::tuple_size_v<Wavelets>)) {
    if (index != I) {
      return with_wavelet<I + 1>(index, omega0, f);
    }
  }
  return f(with_omega0<W>(omega0));
}

}  // namespace rwn::RWN_ISA
