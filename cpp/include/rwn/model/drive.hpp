// What a kind of drive is. Each lives in drives/<drive>.hpp as a struct with static members:
//
//   name          as model files call it
//   coefficients  a transfer function, which has the coefficients of one in place of equations of motion
//   widths        derivatives at once that a run is compiled for
//
// and, where it has equations of motion:
//
//   states        of its electrical part, before the speed in x
//   forced        its input is the torque, and nothing stands before the shaft
//   Electrics<S>  what its electrical part does: see drives/dc.hpp, which has every member
//
// What is missing, or contradicts itself, does not compile.
#pragma once

#include <array>
#include <concepts>
#include <string_view>

#include "rwn/model/motor.hpp"

namespace rwn {

namespace detail {

/// States before and behind the speed: enough for every member to index.
using AnyState = std::array<double, 8>;

struct AnyMotion {
  AnyState x;
};

template <class E>
concept BeforeTheShaft = requires(const E& e, AnyState& x, const double& input) {
  { e.winding() } -> std::same_as<const Winding<double>&>;
  { e.begin(x) };
  { E::current(x) } -> std::convertible_to<double>;
  { e.torque(x, input, input) } -> std::convertible_to<double>;
};

template <class E>
concept WithStates = requires(const E& e, AnyState& x, const AnyMotion& s, const Terms<double>& t, const double& v) {
  { e.linear_torque(x) } -> std::convertible_to<double>;
  { e.couple(x, std::size_t{2}, std::size_t{1}, 1.0, v, false) };
  { e.drive(x, v) };
  { e.remainder(x, x, v, t, v, 1.0) };
  { e.unknown_voltage(x, v, t, v, 0.0) } -> std::convertible_to<double>;
  { e.resting_current(v, v) } -> std::convertible_to<double>;
  { e.settled(s, v, v) } -> std::same_as<AnyMotion>;
  { e.rate(t) } -> std::convertible_to<double>;
  { e.is_settled(x, v, x, t) } -> std::convertible_to<bool>;
  { e.speed_up(t, 0.0) } -> std::convertible_to<double>;
};

template <class D>
consteval bool has_widths() {
  int last = 0;
  for (int width : D::widths) {
    if (width <= last || width % 4 != 0) return false;
    last = width;
  }
  return last > 0;
}

}  // namespace detail

/// Refuses, with a sentence, what would compile and be simulated wrongly.
template <class D>
consteval bool is_drive() {
  static_assert(!std::string_view(D::name).empty(), "a drive has a `name`");
  static_assert(detail::has_widths<D>(), "the `widths` of a drive are multiples of 4, ascending");
  if constexpr (!D::coefficients) {
    static_assert(D::forced == (D::states == 0),
                  "a drive has electrical `states`, or its input is a torque (`forced`), and not both");
    static_assert(detail::BeforeTheShaft<typename D::template Electrics<double>>,
                  "`Electrics` of a drive has winding, begin, current and torque");
    if constexpr (D::states > 0) {
      static_assert(detail::WithStates<typename D::template Electrics<double>>,
                    "`Electrics` of a drive with states lacks a member: see drives/dc.hpp");
    }
  }
  return true;
}

template <class D>
concept DriveKind = is_drive<D>();

}  // namespace rwn
