#pragma once

#include "rwn/networks/rates/rule.hpp"

namespace rwn {

/// The `thesis` rule with the wavelet's own max|phi|, max|phi'| and max|z phi'| in place of 1, 1 and (3.73).
struct TightenedRates {
  static constexpr std::string_view name = "tightened";
  static constexpr std::string_view guarantee =
      "mu_g ||dy/dtheta_g||^2 < 2 for each group by itself, provided rho(A) < 1 and |c/d| max|phi'| < 1, whatever the "
      "wavelet. Not convergence, for the reasons of `thesis`; its rates are larger, and so are the starts and "
      "fractions "
      "from which several groups together diverge.";
  double fraction = 0.5;
  Maxima maxima = Maxima::running;
  bool shared = true;
  bool eigen = false;

  std::unique_ptr<StructuredRates> on(const StructuredNetwork& network, const StructuredMask& learn) const;
  std::unique_ptr<RecurrentRates> on(const RecurrentNetwork& network, const RecurrentMask& learn) const;
};

}  // namespace rwn
