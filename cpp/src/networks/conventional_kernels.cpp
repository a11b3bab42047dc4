#include "rwn/numerics/isa.hpp"
#include "rwn/kernels/conventional_network.hpp"

namespace rwn {

namespace baseline {
extern const ConventionalKernels conventional_network;
}
#ifdef RWN_AVX2
namespace avx2 {
extern const ConventionalKernels conventional_network;
}
#endif
#ifdef RWN_AVX512
namespace avx512 {
extern const ConventionalKernels conventional_network;
}
#endif

const ConventionalKernels& conventional_kernels() {
#ifdef RWN_AVX512
  if (isa() == Isa::avx512) {
    return avx512::conventional_network;
  }
#endif
#ifdef RWN_AVX2
  if (isa() == Isa::avx2) {
    return avx2::conventional_network;
  }
#endif
  return baseline::conventional_network;
}

}  // namespace rwn
