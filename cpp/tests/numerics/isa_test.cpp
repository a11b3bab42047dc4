#include "rwn/numerics/isa.hpp"

#include <gtest/gtest.h>

TEST(Isa, HasAName) { EXPECT_FALSE(rwn::to_string(rwn::isa()).empty()); }
