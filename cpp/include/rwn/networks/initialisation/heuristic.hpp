#pragma once

#include "rwn/networks/initialisation/shapes.hpp"

namespace rwn {

/// Every wavelet in the middle of the domain: m = (low + high) / 2, d = 0.2 (high - low) (2.8, 2.9; the thesis's text
/// swaps the two ends). All wavelets are equal, so their weights must not be.
Shapes heuristic(const RowMatrixRef& x, int wavelets);

}  // namespace rwn
