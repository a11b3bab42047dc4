#pragma once

#include "rwn/networks/rates/rule.hpp"

namespace rwn {

/// Rates given by the user, one per group (structured: v1..v5, w, m, d, c; recurrent: b, a, w, m, d, c).
struct FixedRates {
  static constexpr std::string_view name = "fixed";
  static constexpr std::string_view guarantee =
      "None. The rates are the user's; a run that diverges stops with that status.";
  std::vector<double> values;

  std::unique_ptr<StructuredRates> on(const StructuredNetwork& network, const StructuredMask& learn) const;
  std::unique_ptr<RecurrentRates> on(const RecurrentNetwork& network, const RecurrentMask& learn) const;
};

}  // namespace rwn
