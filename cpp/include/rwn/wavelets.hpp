// The mother wavelets; a new one is a file in wavelets/ and one entry in the tuple.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>

#include "rwn/wavelets/gaussian_derivative.hpp"
#include "rwn/wavelets/mexican_hat.hpp"
#include "rwn/wavelets/morlet.hpp"

namespace rwn {

using Wavelets = std::tuple<GaussianDerivative, MexicanHat, Morlet>;

}  // namespace rwn
