#include "rwn/numerics/isa.hpp"
#include "rwn/kernels/structured_step.hpp"

namespace rwn {

namespace baseline {
extern const StructuredKernels structured_step;
}
#ifdef RWN_AVX2
namespace avx2 {
extern const StructuredKernels structured_step;
}
#endif
#ifdef RWN_AVX512
namespace avx512 {
extern const StructuredKernels structured_step;
}
#endif

const StructuredKernels& structured_kernels() {
#ifdef RWN_AVX512
  if (isa() == Isa::avx512) {
    return avx512::structured_step;
  }
#endif
#ifdef RWN_AVX2
  if (isa() == Isa::avx2) {
    return avx2::structured_step;
  }
#endif
  return baseline::structured_step;
}

}  // namespace rwn
