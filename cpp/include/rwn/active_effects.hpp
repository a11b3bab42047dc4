// The effects that a model has switched on, as calls for one scalar type: which are active is a run-time choice.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "rwn/effects.hpp"
#include "rwn/own_effect.hpp"

namespace rwn {

inline constexpr int max_active_effects = 8;
inline constexpr int max_active_parameters = max_active_effects * max_own_parameters;  // no effect has more
inline constexpr int max_breaks = 2;

/// The functions of one effect for scalar S; null where the effect has no such part.
template <class S>
struct EffectFunctions {
  void (*apply)(const S*, const Motor<S>&, const Motion<S>&, Terms<S>&) = nullptr;
  double (*rate)(const S*, const Motor<S>&, const Motion<S>&, double, double) = nullptr;
  Joint<S> (*joint)(const S*, const Motor<S>&) = nullptr;
  S (*actuate)(const S*, const S&) = nullptr;
  S (*delay)(const S*) = nullptr;
  std::array<S, max_breaks> (*breaks)(const S*) = nullptr;
  void (*begin)(const S*, const Reading<S>&, S*) = nullptr;
  void (*finish)(const S*, const Motor<S>&, const S&, const Motion<S>&, const Motion<S>&, S*) = nullptr;
  void (*sense)(const S*, Reading<S>&, const S*) = nullptr;
  bool varies = false;      // needs the nonlinear step
  bool dry = false;         // contributes to the dry friction level
  bool electrical = false;  // changes how fast the winding is
  bool replaces = false;    // takes over the nominal dry friction
  int memories = 0;
};

template <class S, class E>
constexpr EffectFunctions<S> functions_of() {
  EffectFunctions<S> f;
  if constexpr (requires { E::template apply<S>; }) {
    f.apply = &E::template apply<S>;
    f.varies = true;
    if constexpr (requires { E::varies; }) f.varies = E::varies;
  }
  if constexpr (requires { E::template rate<S>; }) f.rate = &E::template rate<S>;
  if constexpr (requires { E::template actuate<S>; }) f.actuate = &E::template actuate<S>;
  if constexpr (requires { E::template delay<S>; }) f.delay = &E::template delay<S>;
  if constexpr (requires { E::template breaks<S>; }) f.breaks = &E::template breaks<S>;
  if constexpr (requires { E::template begin<S>; }) f.begin = &E::template begin<S>;
  if constexpr (requires { E::template finish<S>; }) f.finish = &E::template finish<S>;
  if constexpr (requires { E::template sense<S>; }) f.sense = &E::template sense<S>;
  f.electrical = E::info.site == Site::voltage || E::info.site == Site::flux;
  if constexpr (requires { E::dry; }) f.dry = E::dry;
  if constexpr (requires { E::memories; }) f.memories = E::memories;
  if constexpr (requires { E::template joint<S>; }) f.joint = &E::template joint<S>;
  for (const Parameter& p : E::parameters) f.replaces = f.replaces || p.replaces == coulomb_friction;
  return f;
}

/// What the loops have to know of an own effect; its formula is called through ActiveEffect::own.
template <class S>
EffectFunctions<S> functions_of(const ActiveOwnEffect<S>& own) {
  EffectFunctions<S> f;
  f.varies = own.varies();
  f.dry = own.term() == Term::friction;
  f.electrical = own.term() == Term::drop || is_factor(own.term());
  return f;
}

template <class S, std::size_t... I>
constexpr auto effect_functions(std::index_sequence<I...>) {
  return std::array<EffectFunctions<S>, sizeof...(I)>{functions_of<S, std::tuple_element_t<I, Effects>>()...};
}

/// Functions of every effect for scalar S, in the order of the table.
template <class S>
inline constexpr auto all_effect_functions = effect_functions<S>(std::make_index_sequence<effect_count>{});

/// One switched-on effect.
template <class S>
struct ActiveEffect {
  EffectFunctions<S> call;
  const S* p = nullptr;
  int memory = 0;                           // first slot of its memory
  const ActiveOwnEffect<S>* own = nullptr;  // where it is a user's
};

}  // namespace rwn
