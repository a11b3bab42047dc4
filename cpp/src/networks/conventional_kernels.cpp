#include "rwn/numerics/isa.hpp"
#include "rwn/kernels/conventional_network.hpp"

namespace rwn {

namespace baseline {
extern const ConventionalKernels conventional_network;
}
#ifdef RWN_X86
namespace avx2 {
extern const ConventionalKernels conventional_network;
}
namespace avx512 {
extern const ConventionalKernels conventional_network;
}
#endif

const ConventionalKernels& conventional_kernels() {
#ifdef RWN_X86
  if (isa() == Isa::avx512) {
    return avx512::conventional_network;
  }
  if (isa() == Isa::avx2) {
    return avx2::conventional_network;
  }
#endif
  return baseline::conventional_network;
}

}  // namespace rwn
