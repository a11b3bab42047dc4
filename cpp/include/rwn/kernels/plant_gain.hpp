// Spectral radius and eigenvector condition of a real 2 x 2 matrix in closed form, for the hot loop.
#pragma once

namespace rwn {

/// What the bounds of thesis eq. 4.50 need of A = [a11 a12; a21 a22].
struct PlantGain {
  double spectral_radius;  // rho(A)
  double condition;        // norm(M) norm(M^-1), 2-norm, M = unit eigenvectors; infinite where A is defective
};

/// With unit eigenvectors at the angle whose cosine is s, M^H M has the eigenvalues 1 +- s, so
/// cond = (1+s)/sqrt(1-s^2) = (sqrt(departure + gap) + sqrt(departure)) / sqrt(gap), where gap = |l1 - l2|^2 and
/// departure = norm_F(A)^2 - |l1|^2 - |l2|^2, written here without cancellation: (a12-a21)^2 for real eigenvalues,
/// (a11-a22)^2 + (a12+a21)^2 for complex ones. A multiple of the identity has condition 1.
[[gnu::always_inline]] inline PlantGain plant_gain(double a11, double a12, double a21, double a22) {
  const double mean = 0.5 * (a11 + a22);
  const double half = 0.5 * (a11 - a22);
  const double discriminant = half * half + a12 * a21;
  const bool real = discriminant >= 0.0;
  const double root = __builtin_sqrt(__builtin_fabs(discriminant));
  const double skew = a12 - a21;
  const double sum = a12 + a21;
  const double departure = real ? skew * skew : 4.0 * half * half + sum * sum;
  const double total = departure + 4.0 * __builtin_fabs(discriminant);
  const double radius = real ? __builtin_fabs(mean) + root : __builtin_sqrt(mean * mean - discriminant);
  const double condition = (__builtin_sqrt(total) + __builtin_sqrt(departure)) / (2.0 * root);
  return {radius, total == 0.0 ? 1.0 : condition};
}

}  // namespace rwn
