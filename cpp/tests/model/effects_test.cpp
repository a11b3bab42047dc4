// What every row of the effect table has to keep.
#include "rwn/model/effects.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "rwn/simulate/active_effects.hpp"
#include "rwn/model/memory.hpp"

namespace rwn {
namespace {

Motor<double> small_motor() {
  Motor<double> m{};
  m[resistance] = m[inductance] = m[torque_constant] = m[back_emf_constant] = m[inertia] = 1.0;
  m[viscous_friction] = 0.1;
  return m;
}

/// Terms that an effect adds to where `x` is, its parameters at their start.
template <class E>
Terms<double> terms_of(const Motion<double>& x) {
  std::array<double, E::parameters.size()> p{};
  for (std::size_t k = 0; k < p.size(); ++k) p[k] = E::parameters[k].start;
  Terms<double> t;
  if constexpr (requires { E::template apply<double>; }) E::apply(p.data(), small_motor(), x, t);
  return t;
}

/// The rate that an effect asks for at `x`, and the sum of what it remembers after a step that ends there.
template <class E>
std::pair<double, double> rate_and_memory(const Motion<double>& x) {
  std::array<double, E::parameters.size()> p{};
  for (std::size_t k = 0; k < p.size(); ++k) p[k] = E::parameters[k].start;
  std::array<double, max_memories> memory{};
  double rate = 0.0;
  if constexpr (requires { E::template rate<double>; }) rate = E::rate(p.data(), small_motor(), x, 1.0, 1e-3);
  if constexpr (requires { E::template finish<double>; }) E::finish(p.data(), small_motor(), 1e-3, x, x, memory.data());
  return {rate, std::accumulate(memory.begin(), memory.end(), 0.0)};
}

Motion<double> somewhere(const Winding<double>& winding, const double* memory) {
  Motion<double> x;
  x.input = 9.0;
  x.current = 2.5;
  x.speed = x.position = x.angle = x.drive_torque = x.travel = 0.5;
  x.winding = &winding;
  x.memory = memory;
  return x;
}

template <class E>
double friction_of() {
  const Winding<double> winding{.resistance = 1.0, .inductance = 1.0, .torque_constant = 1.0, .back_emf_constant = 1.0};
  const std::array<double, max_memories> memory{};
  return terms_of<E>(somewhere(winding, memory.data())).friction;
}

// The integrator does not keep up to date what an effect does not say that it looks at, nor renews other terms than it
// says that it adds to.
template <class E>
void expect_to_say_what_it_looks_at_and_adds_to() {
  const Winding<double> winding{.resistance = 1.0, .inductance = 1.0, .torque_constant = 1.0, .back_emf_constant = 1.0};
  std::array<double, max_memories> memory{};
  memory.fill(0.3);
  const auto says = functions_of<double, E>();
  const Motion<double> whole = somewhere(winding, memory.data());
  Motion<double> kept = whole;
  const double stale = std::numeric_limits<double>::quiet_NaN();
  if (!says.turns) kept.angle = stale;
  if (!says.loaded) kept.drive_torque = stale;
  if (says.memories == 0) kept.travel = stale;
  const Terms<double> t = terms_of<E>(whole), same = terms_of<E>(kept), none;
  EXPECT_EQ(rate_and_memory<E>(whole), rate_and_memory<E>(kept)) << E::info.name;
  EXPECT_EQ(t.torque, same.torque) << E::info.name;
  EXPECT_EQ(t.friction, same.friction) << E::info.name;
  EXPECT_EQ(t.drop, same.drop) << E::info.name;
  EXPECT_EQ(t.flux, same.flux) << E::info.name;
  EXPECT_EQ(t.inertia, same.inertia) << E::info.name;
  const bool winds = t.drop != none.drop || t.drop_slope != none.drop_slope || t.resistance != none.resistance ||
                     t.inductance != none.inductance;
  const bool scales = t.flux != none.flux || t.inertia != none.inertia || t.inertia_slope != none.inertia_slope;
  EXPECT_TRUE(says.scales || !scales) << E::info.name;
  EXPECT_TRUE(says.electrical || !winds) << E::info.name;
}

TEST(Effects, EachSaysWhatItLooksAtAndAddsTo) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (expect_to_say_what_it_looks_at_and_adds_to<std::tuple_element_t<I, Effects>>(), ...);
  }(std::make_index_sequence<effect_count>{});
}

// An effect that sets a friction level but is not `dry` would never stick nor brake.
template <class E>
void expect_dry_where_it_brakes() {
  const bool is_dry = functions_of<double, E>().dry;
  EXPECT_TRUE(is_dry || friction_of<E>() == 0.0) << E::info.name;
}

TEST(Effects, EveryFrictionLevelIsIntegratedAsDryFriction) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (expect_dry_where_it_brakes<std::tuple_element_t<I, Effects>>(), ...);
  }(std::make_index_sequence<effect_count>{});
}

TEST(Effects, WhatASensorShowsTellsWhetherItRectifiesOrJumps) {
  EXPECT_TRUE(rectifies<SensorRectification>() && !jumps<SensorRectification>());
  EXPECT_TRUE(jumps<SensorQuantization>() && !rectifies<SensorQuantization>());
  EXPECT_FALSE(rectifies<SensorGain>() || jumps<SensorGain>() || rectifies<SensorBias>() || jumps<SensorBias>());
  EXPECT_FALSE(rectifies<SpeedSensorLag>() || jumps<SpeedSensorLag>() || rectifies<CoulombFriction>());
}

TEST(Effects, ATorqueThatChangesWithNothingIsSteady) {
  EXPECT_TRUE(is_steady_torque<ConstantLoad>());
  EXPECT_FALSE(is_steady_torque<CoulombFriction>() || is_steady_torque<LoadDisturbance>());
  EXPECT_FALSE(is_steady_torque<ViscousFriction>() || is_steady_torque<InputDelay>());
}

TEST(Effects, PowerLawDragOfPowerTwoIsItsSpecialCase) {
  const double general[] = {0.02, 2.0, 50.0};
  double special[1];
  PowerLawDrag::specialise(general, special);
  EXPECT_EQ(PowerLawDrag::traits.special_case, QuadraticDrag::info.name);
  for (const double speed : {-120.0, 50.0, 300.0}) {
    Motion<double> x;
    x.speed = speed;
    Terms<double> law, quadratic;
    PowerLawDrag::apply(general, small_motor(), x, law);
    QuadraticDrag::apply(special, small_motor(), x, quadratic);
    EXPECT_NEAR(law.torque / quadratic.torque, 1.0, 1e-4);  // viscous below a hundredth of the reference speed
  }
}

TEST(Effects, PowerLawLoadFrictionOfPowerOneIsItsSpecialCase) {
  const double general[] = {0.02, 1.0, 0.5};
  double special[1];
  PowerLawLoadFriction::specialise(general, special);
  EXPECT_EQ(PowerLawLoadFriction::traits.special_case, LoadDependentFriction::info.name);
  for (const double torque : {-0.4, 0.2, 2.0}) {
    Motion<double> x;
    x.drive_torque = torque;
    Terms<double> law, plain;
    PowerLawLoadFriction::apply(general, small_motor(), x, law);
    LoadDependentFriction::apply(special, small_motor(), x, plain);
    EXPECT_NEAR(law.friction / plain.friction, 1.0, 1e-3);  // level below a hundredth of the reference torque
  }
}

TEST(Effects, ALagAnswersAStepTooShortForItsDifferences) {
  const double lag[] = {5e-3};
  Motion<double> before, after;
  before.speed = after.speed = 40.0;
  for (const double h : {1e-18, 1e-12, 1e-7, 4e-6, 6e-6}) {  // the last two on either side of where the series ends
    after.travel = (1000.0 + h * before.speed) - 1000.0;  // as positions tell it, 0 over the shortest
    double memory = 10.0;
    SpeedSensorLag::finish(lag, small_motor(), h, before, after, &memory);
    EXPECT_NEAR(memory, 10.0 - 30.0 * std::expm1(-h / lag[0]), 1e-8);
  }
}

}  // namespace
}  // namespace rwn
