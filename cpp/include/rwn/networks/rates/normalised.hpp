#pragma once

#include "rwn/networks/rates/rule.hpp"

namespace rwn {

/// Normalisation by the actual sensitivity (as in NLMS), with one scale s_g per group so that groups of different units
/// move together: mu_g(n) = fraction s_g^2 / (regularisation M + S(n)), S = sum_g s_g^2 ||P_g||^2, M = max S of a
/// pre-pass.
struct NormalisedRates {
  static constexpr std::string_view name = "normalised";
  static constexpr std::string_view guarantee =
      "sum_g mu_g ||dy/dtheta_g||^2 <= fraction at every sample, whatever the parameters: with follow_state (the state "
      "moves with its parameters, so that a change acts at once) each correction shrinks the error of its own sample "
      "for "
      "0 < fraction < 2, to first order. Without follow_state take a fraction of the order of 1 - rho.";
  double fraction = 0.5;
  double regularisation = 0.01;
  std::vector<double> scales{};  // one per group; empty: from the network and the recording

  std::unique_ptr<StructuredRates> on(const StructuredNetwork& network, const StructuredMask& learn) const;
  std::unique_ptr<RecurrentRates> on(const RecurrentNetwork& network, const RecurrentMask& learn) const;
};

}  // namespace rwn
