// The effects that a model has switched on, as calls for one scalar type: which are active is a run-time choice.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "rwn/model/effects.hpp"
#include "rwn/model/own_effect.hpp"

namespace rwn {

inline constexpr int max_active_effects = 8;
inline constexpr int max_active_parameters = max_active_effects * max_effect_parameters;
static_assert(max_own_parameters <= max_effect_parameters);

/// The functions of one effect for scalar S; null where the effect has no such part.
template <class S>
struct EffectFunctions {
  typename HookTypes<S>::Apply apply = nullptr;
  typename HookTypes<S>::Rate rate = nullptr;
  typename HookTypes<S>::JointOf joint = nullptr;
  typename HookTypes<S>::Actuate actuate = nullptr;
  typename HookTypes<S>::Follow follow = nullptr;
  typename HookTypes<S>::Delay delay = nullptr;
  typename HookTypes<S>::Late late = nullptr;
  typename HookTypes<S>::Breaks breaks = nullptr;
  typename HookTypes<S>::Begin begin = nullptr;
  typename HookTypes<S>::Finish finish = nullptr;
  typename HookTypes<S>::Sense sense = nullptr;
  bool late_current = false;  // its signal is the current, not the speed
  bool varies = false;        // needs the nonlinear step
  bool dry = false;           // contributes to the dry friction level
  bool electrical = false;    // changes how fast the winding is
  bool loaded = false;        // changes with the current while the winding settles
  bool turns = false;         // looks at the angle
  bool scales = false;        // changes the flux or the inertia
  bool replaces = false;      // takes over the nominal dry friction
  int memories = 0;
};

template <class S, Effect E>
constexpr EffectFunctions<S> functions_of() {
  EffectFunctions<S> f;
  constexpr Hook hooks = E::traits.hooks;
  if constexpr (has(hooks, Hook::apply)) f.apply = &E::template apply<S>;
  if constexpr (has(hooks, Hook::rate)) f.rate = &E::template rate<S>;
  if constexpr (has(hooks, Hook::joint)) f.joint = &E::template joint<S>;
  if constexpr (has(hooks, Hook::actuate)) f.actuate = &E::template actuate<S>;
  if constexpr (has(hooks, Hook::follow)) f.follow = &E::template follow<S>;
  if constexpr (has(hooks, Hook::delay)) f.delay = &E::template delay<S>;
  if constexpr (has(hooks, Hook::late)) f.late = &E::template late<S>;
  f.late_current = E::traits.shows_late == "current";
  if constexpr (has(hooks, Hook::breaks)) f.breaks = &E::template breaks<S>;
  if constexpr (has(hooks, Hook::begin)) f.begin = &E::template begin<S>;
  if constexpr (has(hooks, Hook::finish)) f.finish = &E::template finish<S>;
  if constexpr (has(hooks, Hook::sense)) f.sense = &E::template sense<S>;
  f.varies = has(hooks, Hook::apply) && E::traits.varies;
  f.electrical = E::info.site == Site::voltage || E::info.site == Site::flux;
  f.loaded = E::traits.loaded;
  f.turns = E::traits.turns;
  f.scales = E::info.site == Site::flux || E::traits.inertial;
  f.dry = E::traits.dry;
  f.memories = E::traits.memories;
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
  f.scales = own.term() == Term::flux;
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
