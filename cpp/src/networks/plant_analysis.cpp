#include "rwn/networks/plant_analysis.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

namespace rwn {

PlantGain plant_gain_by_eigen(const Eigen::Matrix2d& a) {
  const Eigen::EigenSolver<Eigen::Matrix2d> solver(a);
  const Eigen::Matrix2cd m = solver.eigenvectors();
  // unit columns with the cosine g between them have singular values sqrt(1 +- |g|)
  const double cosine = std::abs(m.col(0).dot(m.col(1))) / (m.col(0).norm() * m.col(1).norm());
  return {solver.eigenvalues().cwiseAbs().maxCoeff(), std::sqrt((1.0 + cosine) / (1.0 - cosine))};
}

ImpulseSums impulse_sums(const Eigen::Matrix2d& a) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double rho = plant_gain(a(0, 0), a(0, 1), a(1, 0), a(1, 1)).spectral_radius;
  if (!(rho < 1.0)) {
    return {infinity, infinity};
  }
  // The tail after r terms is below |row| cond / (1 - rho), and row shrinks like rho^r.
  Eigen::RowVector2d row(1.0, 0.0);
  Eigen::RowVector2d sum(0.0, 0.0);
  const double negligible = 1e-15 * (1.0 - rho);
  for (long r = 0; r < 100'000'000 && row.norm() > negligible; ++r) {
    sum += row.cwiseAbs();
    row *= a;
  }
  return {sum[0], sum[1]};
}

}  // namespace rwn
