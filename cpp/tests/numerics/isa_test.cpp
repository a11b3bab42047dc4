#include "rwn/numerics/isa.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace rwn {
namespace {

TEST(Isa, EachHasItsName) {
  EXPECT_EQ(to_string(Isa::baseline), "baseline");
  EXPECT_EQ(to_string(Isa::avx2), "avx2");
  EXPECT_EQ(to_string(Isa::avx512), "avx512");
}

TEST(Isa, IsNeverBetterThanTheOneAskedFor) {
  const char* asked = std::getenv("RWN_ISA");
  const std::string name = asked == nullptr ? "avx512" : asked;
  const Isa most = name == "baseline" ? Isa::baseline : name == "avx2" ? Isa::avx2 : Isa::avx512;
  EXPECT_LE(isa(), most);
}

}  // namespace
}  // namespace rwn
