#pragma once

#include "rwn/networks/rates/rule.hpp"

namespace rwn {

/// The adaptive learning rates of the thesis, mu_g = fraction * 2 / bound_g^2: eq. 3.31-3.89 for the recurrent network,
/// 4.30-4.124 and E.1-E.24 for the structured one, with the printed constants max|phi| = max|phi'| = 1 and (3.73).
struct ThesisRates {
  static constexpr std::string_view name = "thesis";
  static constexpr std::string_view guarantee =
      "mu_g ||dy/dtheta_g||^2 < 2 for each group by itself, provided rho(A) < 1, |c/d| < 1 and |phi'| <= 1, which the "
      "Gaussian derivative keeps and the other wavelets do not. That is not convergence: groups move together (share "
      "the "
      "rates), and a change of the parameters needs 1/(1 - rho) samples to act, which the derivation ignores. Where "
      "eigenvalues of A meet, the bound is infinite and learning freezes.";
  double fraction = 0.5;
  Maxima maxima = Maxima::running;
  bool shared = true;     // divide the fraction among the groups that learn
  bool misprint = false;  // |v3| in place of |v2| in the bound of v3 (4.66-4.75), which is then no bound
  bool eigen = false;     // rho(A) and cond(M) by Eigen's eigendecomposition at every sample; false: the closed form

  std::unique_ptr<StructuredRates> on(const StructuredNetwork& network, const StructuredMask& learn) const;
  std::unique_ptr<RecurrentRates> on(const RecurrentNetwork& network, const RecurrentMask& learn) const;
};

}  // namespace rwn
