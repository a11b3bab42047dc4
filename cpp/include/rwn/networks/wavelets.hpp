// The mother wavelets; a new one is a file in wavelets/ and one entry in the tuple.
#pragma once

#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "rwn/networks/wavelets/gaussian_derivative.hpp"
#include "rwn/networks/wavelets/mexican_hat.hpp"
#include "rwn/networks/wavelets/morlet.hpp"

namespace rwn {

using Wavelets = std::tuple<GaussianDerivative, MexicanHat, Morlet>;

template <class Tuple>
struct VariantOf;
template <class... W>
struct VariantOf<std::tuple<W...>> {
  using type = std::variant<W...>;
};

/// A wavelet with its parameter; omega0 is ignored by those that have none.
template <class W>
[[gnu::always_inline]] constexpr W with_omega0([[maybe_unused]] double omega0) {
  if constexpr (requires(W w) { w.omega0; }) {
    return W{omega0};
  } else {
    return W{};
  }
}

/// m and d of the wavelets that fill a vector up: z = -1e10 wherever the input is, so that they neither answer nor
/// learn, and 1/|d| is nothing, so that they do not count among the steepest.
inline constexpr double kPaddingTranslation = 1e60;
inline constexpr double kPaddingDilation = 1e50;

std::vector<std::string> wavelet_names();

/// A mother wavelet chosen at run time by its name.
class Wavelet {
 public:
  /// \throws std::invalid_argument for an unknown name (the message lists the known ones) or omega0 not positive.
  explicit Wavelet(std::string_view name = GaussianDerivative::name, double omega0 = Morlet{}.omega0);

  std::string_view name() const;
  double omega0() const { return omega0_; }
  int index() const { return static_cast<int>(kind_.index()); }  // place in Wavelets: how kernels choose

  double value(double z) const;
  double derivative(double z) const;
  double second_derivative(double z) const;
  double max_value() const;              // max |phi|
  double max_derivative() const;         // max |phi'|
  double max_scaled_derivative() const;  // max |z phi'|

  /// Calls f with the wavelet's own type, so that the loop inside f is compiled for it.
  template <class F>
  decltype(auto) visit(F&& f) const {
    return std::visit(std::forward<F>(f), kind_);
  }

 private:
  VariantOf<Wavelets>::type kind_;
  double omega0_;
};

}  // namespace rwn
