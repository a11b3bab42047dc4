// What an effect is. Each lives in effects/<effect>.hpp as a struct with static members:
//
//   info          name, site, equation, meaning, source
//   parameters    std::array<Parameter, n>
//   traits        which of the functions below it has, and what the integrator and the first guesses have to know
//
// and functions ("hooks"), all templates on the scalar, which carries the derivatives; p points to the parameters:
//
//   apply(p, motor, motion, terms)    its share of the motor equations
//   rate(p, motor, motion, acceleration, h)   fastest rate of change it brings over the next h [1/s]: sets the step
//   joint(p, motor)                   what couples the motor to the second mass that it brings
//   actuate(p, input)                 maps the commanded input to what acts
//   follow(p, h, input, memory)       mean over the next h of what acts in place of an input, where that lasts
//   delay(p)                          input delay [s]
//   late(p)                           how late a sensor shows a signal, and what goes with it, [s]
//   breaks(p)                         instants at which its terms jump [s]
//   begin(p, reading, memory)         its memory at the first sample
//   finish(p, motor, h, before, after, memory)     its memory after a step
//   sense(p, reading, memory)         maps the true signals to what is recorded
//
// and, on doubles alone, where the traits name a special case:
//
//   specialise(p, special)            parameters to start the special case from
//
// Of the motion it sees the angle, the drive's torque and the travel only where it says so: by `turns`, `loaded`, or by
// having memories.
//
// A function that is listed and not there, or there and not listed, or of another signature, does not compile.
#pragma once

#include <array>
#include <string_view>
#include <type_traits>

#include "rwn/model/joint.hpp"
#include "rwn/model/memory.hpp"
#include "rwn/model/motor.hpp"
#include "rwn/numerics/dual.hpp"

namespace rwn {

inline constexpr int max_effect_parameters = 12;
inline constexpr int max_breaks = 2;

enum class Site { torque, voltage, flux, actuator, sensor, load };

constexpr std::string_view to_string(Site site) {
  constexpr std::string_view names[] = {"torque", "voltage", "flux", "actuator", "sensor", "load"};
  return names[static_cast<int>(site)];
}

/// The equation that an effect of this site belongs to, as diagnosis reports it.
constexpr std::string_view equation_of(Site site) {
  constexpr std::string_view names[] = {"mechanical", "electrical", "electrical", "actuator", "sensor", "mechanical"};
  return names[static_cast<int>(site)];
}

struct EffectInfo {
  std::string_view name;
  Site site;
  std::string_view equation;
  std::string_view meaning;
  std::string_view source;
};

enum class Hook : unsigned {
  apply = 1,
  rate = 2,
  joint = 4,
  actuate = 8,
  delay = 16,
  breaks = 32,
  begin = 64,
  finish = 128,
  sense = 256,
  follow = 512,
  late = 1024
};
constexpr Hook operator|(Hook a, Hook b) { return Hook{static_cast<unsigned>(a) | static_cast<unsigned>(b)}; }
constexpr bool has(Hook all, Hook one) { return (static_cast<unsigned>(all) & static_cast<unsigned>(one)) != 0; }

/// Where first guesses come from: what the parameters scan; a spectrum over the angle; a change of the residual in
/// time, as of every effect with `breaks`; a resonance of the residual, as of every spring; or nowhere, as no residual
/// is searched for the effect.
enum class Guess { scan, spectrum, window, resonance, none };

constexpr std::string_view to_string(Guess guess) {
  constexpr std::string_view names[] = {"scan", "spectrum", "window", "resonance", "none"};
  return names[static_cast<int>(guess)];
}

struct EffectTraits {
  Hook hooks;
  bool varies = true;             // false: terms change only with direction and at `breaks`
  bool dry = false;               // contributes to the level of dry friction
  bool turns = false;             // depends on the angle
  bool loaded = false;            // depends on the torque that the drive transmits
  bool inertial = false;          // changes the inertia
  bool one_sided = false;         // tells a direction from the other, or an angle from its opposite
  bool holds = false;             // nothing moves under it while the input is small
  std::string_view filters{};     // the signal of which it is the first-order filter, of one time constant
  std::string_view shows_late{};  // the signal that its hook `late` is about: a current, or a speed with its position
  int memories = 0;               // numbers that it remembers from step to step
  Guess guess = Guess::scan;
  std::string_view special_case{};  // the simpler effect that it is at one value of a parameter, tried in its place
};

/// Signatures of the hooks for scalar S.
template <class S>
struct HookTypes {
  using Apply = void (*)(const S*, const Motor<S>&, const Motion<S>&, Terms<S>&);
  using Rate = double (*)(const S*, const Motor<S>&, const Motion<S>&, double, double);
  using JointOf = Joint<S> (*)(const S*, const Motor<S>&);
  using Actuate = S (*)(const S*, const S&);
  using Follow = S (*)(const S*, const S&, const S&, S*);
  using Delay = S (*)(const S*);
  using Late = S (*)(const S*);
  using Breaks = std::array<S, max_breaks> (*)(const S*);
  using Begin = void (*)(const S*, const Reading<S>&, S*);
  using Finish = void (*)(const S*, const Motor<S>&, const S&, const Motion<S>&, const Motion<S>&, S*);
  using Sense = void (*)(const S*, Reading<S>&, const S*);
};

using Specialise = void (*)(const double*, double*);

template <class Wanted, class Given>
consteval bool is_signature() {
  static_assert(std::is_same_v<Wanted, Given>, "a hook of this effect has another signature: see effect.hpp");
  return std::is_same_v<Wanted, Given>;
}

/// True where every parameter has a symbol that occurs in the equation, or is an idealisation that it does without; the
/// equation is that of the first line of a periodic effect.
template <class E>
consteval bool is_written_in_symbols() {
  for (const Parameter& p : E::parameters) {
    if (p.line > 0) continue;
    if (p.symbol.empty() ? !p.idealised : E::info.equation.find(p.symbol) == std::string_view::npos) return false;
  }
  return true;
}

/// Whether it is a torque that never changes: usual on a machine axis, rare on a bench.
template <class E>
consteval bool is_steady_torque() {
  return E::traits.hooks == Hook::apply && !E::traits.varies && !E::traits.dry &&
         equation_of(E::info.site) == "mechanical";
}

/// Whether it is a spring with a mass behind it, which rings: both, and the damping, are numbers of its own.
template <class E>
consteval bool is_spring() {
  const auto measured_by = [](const Scale& scale) {
    for (const Parameter& p : E::parameters) {
      if (p.scale == scale) return true;
    }
    return false;
  };
  return has(E::traits.hooks, Hook::joint) && measured_by(scale::stiffness) && measured_by(scale::damping) &&
         measured_by(scale::inertia);
}

/// Refuses, with a sentence, what would compile and do nothing.
template <class E>
consteval bool is_effect() {
  using T = HookTypes<double>;
  constexpr Hook hooks = E::traits.hooks;
  static_assert(std::is_same_v<decltype(E::info), const EffectInfo>, "an effect has `info`");
  static_assert(E::parameters.size() >= 1 && E::parameters.size() <= max_effect_parameters,
                "an effect has one to max_effect_parameters parameters");
  static_assert(is_written_in_symbols<E>(), "a parameter of an effect has a `symbol`, as its equation writes it");
  static_assert((E::traits.filters.empty() && !is_steady_torque<E>()) || E::parameters.size() == 1,
                "a filter of a sensor and a steady torque have one parameter");
  static_assert(E::traits.guess != Guess::window, "an effect with `breaks` is sought in time without saying so");
  static_assert(E::traits.guess != Guess::resonance, "a spring is sought by its resonance without saying so");
  static_assert(!has(hooks, Hook::delay) || E::parameters.size() == 1, "a delay has one parameter");
  static_assert(has(hooks, Hook::late) == (E::traits.shows_late == "current" || E::traits.shows_late == "speed"),
                "a sensor that is late says of which signal");
  static_assert(E::traits.memories >= 0 && E::traits.memories <= max_memories, "an effect has at most max_memories");
  static_assert(static_cast<unsigned>(hooks) != 0, "an effect does something: it lists at least one hook");
#define RWN_HOOK(name, Type)                                                                                          \
  if constexpr (has(hooks, Hook::name)) {                                                                             \
    static_assert(requires { &E::template name<double>; }, "hook `" #name "` is listed in traits and not there");     \
    if constexpr (requires { &E::template name<double>; }) is_signature<Type, decltype(&E::template name<double>)>(); \
  } else {                                                                                                            \
    static_assert(!requires { &E::template name<double>; }, "hook `" #name "` is there and not listed in traits");    \
  }
  RWN_HOOK(apply, T::Apply)
  RWN_HOOK(rate, T::Rate)
  RWN_HOOK(joint, T::JointOf)
  RWN_HOOK(actuate, T::Actuate)
  RWN_HOOK(follow, T::Follow)
  RWN_HOOK(delay, T::Delay)
  RWN_HOOK(late, T::Late)
  RWN_HOOK(breaks, T::Breaks)
  RWN_HOOK(begin, T::Begin)
  RWN_HOOK(finish, T::Finish)
  RWN_HOOK(sense, T::Sense)
#undef RWN_HOOK
  if constexpr (requires { &E::specialise; }) {
    static_assert(!E::traits.special_case.empty(), "`specialise` is there and no special case is named in traits");
    is_signature<Specialise, decltype(&E::specialise)>();
  } else {
    static_assert(E::traits.special_case.empty(), "a special case is named in traits and `specialise` is not there");
  }
  static_assert(
      E::traits.memories == 0 || has(hooks, Hook::finish) || has(hooks, Hook::begin) || has(hooks, Hook::follow),
      "an effect that remembers something says how its memory changes");
  return true;
}

template <class E>
concept Effect = is_effect<E>();

template <Effect E>
constexpr Guess guess_of() {
  if (has(E::traits.hooks, Hook::breaks)) return Guess::window;
  return is_spring<E>() ? Guess::resonance : E::traits.guess;
}

/// The speed that a sensor shows of a true one, where it shows it at once, with its parameters at `start`.
template <Effect E>
double shown_speed(double speed) {
  std::array<double, E::parameters.size()> p{};
  for (std::size_t k = 0; k < p.size(); ++k) p[k] = E::parameters[k].start;
  Reading<double> y{.speed = speed};
  if constexpr (has(E::traits.hooks, Hook::sense) && E::traits.memories == 0) {
    E::template sense<double>(p.data(), y, nullptr);
  }
  return y.speed;
}

inline constexpr double some_speed = 1.37;  // between the steps that a sensor may show

/// Whether a sensor shows the same of a speed and of its opposite.
template <Effect E>
bool rectifies() {
  return shown_speed<E>(some_speed) == shown_speed<E>(-some_speed);
}

/// Whether what a sensor shows jumps from value to value, so that it has no slope to fit by.
template <Effect E>
bool jumps() {
  return shown_speed<E>(some_speed) == shown_speed<E>(some_speed * (1.0 + 1e-9));
}

}  // namespace rwn
