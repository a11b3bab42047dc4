#include "rwn/numerics/isa.hpp"
#include "rwn/kernels/structured_step.hpp"

namespace rwn {

namespace baseline {
extern const StructuredKernels structured_step;
}
#ifdef RWN_X86
namespace avx2 {
extern const StructuredKernels structured_step;
}
namespace avx512 {
extern const StructuredKernels structured_step;
}
#endif

const StructuredKernels& structured_kernels() {
#ifdef RWN_X86
  if (isa() == Isa::avx512) {
    return avx512::structured_step;
  }
  if (isa() == Isa::avx2) {
    return avx2::structured_step;
  }
#endif
  return baseline::structured_step;
}

}  // namespace rwn
