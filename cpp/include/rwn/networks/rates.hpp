// Learning-rate rules; a new one is a file in rates/ and one entry in the tuple.
#pragma once

#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "rwn/networks/rates/fixed.hpp"
#include "rwn/networks/rates/impulse_response.hpp"
#include "rwn/networks/rates/normalised.hpp"
#include "rwn/networks/rates/thesis.hpp"
#include "rwn/networks/rates/tightened.hpp"

namespace rwn {

using RateRules = std::tuple<FixedRates, ThesisRates, TightenedRates, ImpulseResponseRates, NormalisedRates>;
using RateRule = VariantOf<RateRules>::type;

/// Name and guarantee of every rule.
inline std::vector<std::pair<std::string, std::string>> rate_rules() {
  return std::apply(
      [](auto... r) {
        return std::vector<std::pair<std::string, std::string>>{
            {std::string(decltype(r)::name), std::string(decltype(r)::guarantee)}...};
      },
      RateRules{});
}

}  // namespace rwn
