#include "rwn/networks/wavelets.hpp"

#include <cmath>
#include <stdexcept>

namespace rwn {
namespace {

template <std::size_t I = 0>
VariantOf<Wavelets>::type by_name(std::string_view name, double omega0) {
  if constexpr (I == std::tuple_size_v<Wavelets>) {
    std::string known;
    for (const std::string& other : wavelet_names()) {
      known += (known.empty() ? "" : ", ") + other;
    }
    throw std::invalid_argument("unknown wavelet '" + std::string(name) + "'; known: " + known);
  } else {
    using W = std::tuple_element_t<I, Wavelets>;
    return name == W::name ? VariantOf<Wavelets>::type{with_omega0<W>(omega0)} : by_name<I + 1>(name, omega0);
  }
}

}  // namespace

std::vector<std::string> wavelet_names() {
  return std::apply([](auto... w) { return std::vector<std::string>{std::string(decltype(w)::name)...}; }, Wavelets{});
}

Wavelet::Wavelet(std::string_view name, double omega0) : kind_(by_name(name, omega0)), omega0_(omega0) {
  if (!(omega0 > 0.0) || !std::isfinite(omega0)) {
    throw std::invalid_argument("omega0 of a wavelet must be positive and finite, got " + std::to_string(omega0));
  }
}

std::string_view Wavelet::name() const {
  return visit([](const auto& w) { return w.name; });
}
double Wavelet::value(double z) const {
  return visit([z](const auto& w) { return w.value(z); });
}
double Wavelet::derivative(double z) const {
  return visit([z](const auto& w) { return w.derivative(z); });
}
double Wavelet::second_derivative(double z) const {
  return visit([z](const auto& w) { return w.second_derivative(z); });
}
double Wavelet::max_value() const {
  return visit([](const auto& w) { return w.max_value(); });
}
double Wavelet::max_derivative() const {
  return visit([](const auto& w) { return w.max_derivative(); });
}
double Wavelet::max_scaled_derivative() const {
  return visit([](const auto& w) { return w.max_scaled_derivative(); });
}

}  // namespace rwn
