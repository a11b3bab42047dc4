// Run-time choice of instruction set: files of cpp/kernels exist once per instruction set, each in its namespace.
#pragma once

#include <string_view>

namespace rwn {

enum class Isa { baseline, avx2, avx512 };

/// The best instruction set of this processor; the environment variable RWN_ISA (baseline, avx2, avx512) lowers it.
Isa isa();

std::string_view to_string(Isa isa);

}  // namespace rwn
