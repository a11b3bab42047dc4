#pragma once

#include <vector>

#include "rwn/networks/initialisation/shapes.hpp"

namespace rwn {

/// Nodes of the last scale of a dyadic grid, and how many of them a network of that size takes (0: the scales before
/// the last hold it exactly).
struct FinestScale {
  int nodes, taken;
};
FinestScale finest_scale(int wavelets);

/// Dyadic grid (2.10, 2.11): every interval [a, b] gets m = p, d = (b - a) / 2 and is divided at p, the centre of
/// gravity of the data in it (its middle where there are no data). All inputs of a wavelet sit at the same node of
/// their grids.
/// \param finest distinct nodes of the last scale that are used, as many as finest_scale(wavelets).taken; the thesis
///               draws them at random
Shapes dyadic_grid(const RowMatrixRef& x, int wavelets, const std::vector<int>& finest);

}  // namespace rwn
