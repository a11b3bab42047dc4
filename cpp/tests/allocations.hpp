// Counts heap allocations of this test program, so that a test can assert that a loop makes none.
#pragma once

namespace rwn::testing {

/// Number of calls of malloc and aligned_alloc so far; always 0 under the address sanitizer, which owns them.
long allocations();

}  // namespace rwn::testing
