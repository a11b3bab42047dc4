#pragma once

#include "rwn/networks/rates/rule.hpp"

namespace rwn {

/// mu_g = fraction * 2 / bound_g^2 with ||P_g|| <= sum_r |C A^r e1| max||s1_g|| + sum_r |C A^r e2| max||s2_g||, where
/// s1, s2 drive the mechanical and the electrical equation of the group's sensitivity. Maxima from a pre-pass over the
/// first cycle, then held. The network's w is taken as at least the motor torque / sqrt(N_w), so that a network that
/// starts at zero does not get infinite rates.
struct ImpulseResponseRates {
  static constexpr std::string_view name = "impulse-response";
  static constexpr std::string_view guarantee =
      "sum_g mu_g ||dy/dtheta_g||^2 <= 2 fraction along the recording while the parameters stay near those of the "
      "pre-pass. With the default fraction (1 - rho)/4 the sum stays below (1 - rho)/2, half of the delay limit "
      "1 - rho of the slowest mode; not proved, and not safe by itself from a start whose plant is faster than the "
      "truth "
      "(Table 18 case 3 diverges): guarded-descent makes it safe.";
  double fraction = 0.0;  // 0: (1 - rho)/4
  bool shared = true;

  std::unique_ptr<StructuredRates> on(const StructuredNetwork& network, const StructuredMask& learn) const;
  std::unique_ptr<RecurrentRates> on(const RecurrentNetwork& network, const RecurrentMask& learn) const;
};

}  // namespace rwn
