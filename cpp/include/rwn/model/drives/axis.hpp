// A machine axis: the input is the torque (or force) that drives it.
#pragma once

#include <cstddef>
#include <string_view>

#include "rwn/model/motor.hpp"

namespace rwn {

struct AxisDrive {
  static constexpr std::string_view name = "axis";
  static constexpr int states = 0;
  static constexpr bool forced = true;
  static constexpr bool coefficients = false;
  static constexpr int widths[] = {4, 8};

  template <class S>
  class Electrics {
   public:
    explicit Electrics(const Motor<S>&) {}

    static const Winding<S>& winding() { return no_winding<S>; }
    void begin(auto&) const {}
    static S current(const auto&) { return S(0.0); }
    S torque(const auto&, const S& flux, const S& input) const { return input * flux; }
  };
};

}  // namespace rwn
