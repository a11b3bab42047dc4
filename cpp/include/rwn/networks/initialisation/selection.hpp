#pragma once

#include "rwn/networks/initialisation/shapes.hpp"

namespace rwn {

/// A library of wavelets over the data's domain: along every input, scale l has dilation zeta (high - low) / 2^l and
/// its centres half a dilation apart; all combinations of scales over the inputs are there (Oussar & Dreyfus 2000,
/// section 4).
Shapes wavelet_library(const RowMatrixRef& x, int levels, double zeta);

/// Orthogonal least squares over a library: after the regressors 1 and x, the wavelet that takes most of what is left
/// of y is chosen, and y and the others are taken orthogonal to it (Gram-Schmidt; Oussar & Dreyfus 2000).
/// \return the chosen rows of the library, in the order of choice; fewer if nothing independent is left
std::vector<int> select_wavelets(const Wavelet& wavelet, const Shapes& library, const RowMatrixRef& x,
                                 const RowMatrixRef& y, int wavelets);

}  // namespace rwn
