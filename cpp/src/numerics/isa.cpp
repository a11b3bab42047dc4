#include "rwn/numerics/isa.hpp"

#include <algorithm>
#include <cstdlib>

namespace rwn {
namespace {

Isa best_isa() {
#ifdef RWN_AVX512
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512bw")) {
    return Isa::avx512;
  }
#endif
#ifdef RWN_AVX2
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    return Isa::avx2;
  }
#endif
  return Isa::baseline;
}

Isa chosen_isa() {
  const char* wish = std::getenv("RWN_ISA");
  const Isa best = best_isa();
  if (wish == nullptr) {
    return best;
  }
  const std::string_view name{wish};
#ifdef RWN_AVX2
  constexpr Isa avx2 = Isa::avx2;
#else
  constexpr Isa avx2 = Isa::baseline;  // the best below AVX-512 that was built
#endif
  const Isa asked = name == "baseline" ? Isa::baseline : name == "avx2" ? avx2 : Isa::avx512;
  return std::min(asked, best);
}

}  // namespace

Isa isa() {
  static const Isa chosen = chosen_isa();
  return chosen;
}

std::string_view to_string(Isa isa) {
  switch (isa) {
    case Isa::avx512:
      return "avx512";
    case Isa::avx2:
      return "avx2";
    case Isa::baseline:
      break;
  }
  return "baseline";
}

}  // namespace rwn
