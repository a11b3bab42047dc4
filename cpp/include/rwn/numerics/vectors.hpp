// How wide the vectors are of the instruction set that the including file is compiled for. Macros, since a constant of
// one name must not differ between the files that the linker joins.
#pragma once

#define RWN_INLINE [[gnu::always_inline]] inline

#if defined(__AVX512F__)
#define RWN_VECTOR_WIDTH 8
#elif defined(__AVX2__)
#define RWN_VECTOR_WIDTH 4
#else
#define RWN_VECTOR_WIDTH 2
#endif
