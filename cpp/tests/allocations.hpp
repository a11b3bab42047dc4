// Counts heap allocations of this test program, so that a test can assert that a loop makes none.
#pragma once

namespace rwn::testing {

/// Number of heap allocations so far.
long allocations();

}  // namespace rwn::testing
