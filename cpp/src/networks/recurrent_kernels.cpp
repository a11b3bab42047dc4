#include "rwn/numerics/isa.hpp"
#include "rwn/kernels/recurrent_step.hpp"

namespace rwn {

namespace baseline {
extern const RecurrentKernels recurrent_step;
}
#ifdef RWN_AVX2
namespace avx2 {
extern const RecurrentKernels recurrent_step;
}
#endif
#ifdef RWN_AVX512
namespace avx512 {
extern const RecurrentKernels recurrent_step;
}
#endif

const RecurrentKernels& recurrent_kernels() {
#ifdef RWN_AVX512
  if (isa() == Isa::avx512) {
    return avx512::recurrent_step;
  }
#endif
#ifdef RWN_AVX2
  if (isa() == Isa::avx2) {
    return avx2::recurrent_step;
  }
#endif
  return baseline::recurrent_step;
}

}  // namespace rwn
