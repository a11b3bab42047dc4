// Eigenvalues and impulse responses of the state matrix A, as the learning-rate rules need them.
#pragma once

#include <Eigen/Core>

#include "rwn/kernels/plant_gain.hpp"

namespace rwn {

/// The reference for plant_gain: rho(A), and cond(M) in the 2-norm from Eigen's eigendecomposition with unit
/// eigenvectors.
PlantGain plant_gain_by_eigen(const Eigen::Matrix2d& a);

/// Sums over r >= 0 of |C A^r e1| and |C A^r e2|, C = [1 0]: the peak of the speed when a unit drive enters the first
/// (mechanical) or second (electrical) equation. Infinite if rho(A) >= 1.
struct ImpulseSums {
  double mechanical, electrical;
};
ImpulseSums impulse_sums(const Eigen::Matrix2d& a);

}  // namespace rwn
