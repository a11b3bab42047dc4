#include "plant/plant.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "allocations.hpp"

namespace rwn {
namespace {

constexpr double sample_time = 1e-3;
constexpr int fine = 24;
constexpr double fineness = 0.15;

PlantParameters motor() {
  PlantParameters p;
  p.resistance = 1.1;
  p.inductance = 4.5e-4;
  p.torque_constant = p.back_emf_constant = 0.037;
  p.inertia = 2.9e-5;
  p.viscous_friction = 6e-6;
  return p;
}

PlantSample after(const PlantParameters& p, double voltage, int rows, int substeps = fine) {
  Plant plant(p, sample_time, std::abs(voltage), substeps, fineness);
  for (int k = 0; k < rows; ++k) plant.step(voltage);
  return plant.sample();
}

/// Runs up at `voltage` for half a second, then sees the same rows at 0 V.
Plant coasting(const PlantParameters& p, double voltage, int rows) {
  Plant plant(p, sample_time, std::abs(voltage), fine, fineness);
  for (int k = 0; k < 500; ++k) plant.step(voltage);
  for (int k = 0; k < rows; ++k) plant.step(0.0);
  return plant;
}

TEST(Plant, StepResponseIsThatOfTheLinearMotor) {
  // di/dt and dw/dt with constant v: x(t) = x_inf + sum of two exponentials, written with the eigenvalues.
  const PlantParameters p = motor();
  const double a = -p.resistance / p.inductance, b = -p.back_emf_constant / p.inductance;
  const double c = p.torque_constant / p.inertia, d = -p.viscous_friction / p.inertia;
  const double mean = 0.5 * (a + d), root = std::sqrt(0.25 * (a - d) * (a - d) + b * c);
  const double slow = mean + root, fast = mean - root;
  const double v = 6.0, t = 20 * sample_time;
  const double settled =
      v * p.torque_constant / (p.resistance * p.viscous_friction + p.torque_constant * p.back_emf_constant);
  // w(0) = 0 and dw/dt(0) = 0.
  const double expected = settled * (1.0 + (fast * std::exp(slow * t) - slow * std::exp(fast * t)) / (slow - fast));
  EXPECT_NEAR(after(p, v, 20).speed, expected, 1e-7 * settled);
}

TEST(Plant, SticksBelowBreakawayAndSlidesAbove) {
  PlantParameters p = motor();
  p.coulomb_plus = p.coulomb_minus = 0.01;
  const double breakaway = p.coulomb_plus * p.resistance / p.torque_constant;
  EXPECT_EQ(after(p, 0.99 * breakaway, 500).speed, 0.0);
  EXPECT_EQ(after(p, -0.99 * breakaway, 500).position, 0.0);
  EXPECT_GT(after(p, 1.01 * breakaway, 500).speed, 0.05);
  EXPECT_LT(after(p, -1.01 * breakaway, 500).speed, -0.05);
}

TEST(Plant, CoulombFrictionStopsACoastingRotorWhenItShould) {
  // No back-EMF current (tiny Kt after spin-up is not possible, so the winding is almost open): dw/dt = -Tc/J.
  PlantParameters p = motor();
  p.resistance = 1e4;
  p.inductance = 1.0;
  p.viscous_friction = 0.0;
  p.load_torque = -0.005;  // spins it up for 0.1 s
  p.load_end = 0.1;
  p.coulomb_plus = p.coulomb_minus = 0.001;
  const double top = (0.005 - 0.001) / p.inertia * 0.1;
  const double stops = 0.1 + top * p.inertia / 0.001;
  const double braking = p.torque_constant * p.back_emf_constant / p.resistance / p.inertia;  // 1/s, small
  Plant plant(p, sample_time, 1.0, fine, fineness);
  int row = 0;
  for (; row < 100; ++row) plant.step(0.0);
  EXPECT_NEAR(plant.sample().speed, top, 2.0 * braking * 0.1 * top);
  while (plant.sample().speed > 0.0 && row < 2000) plant.step(0.0), ++row;
  EXPECT_NEAR(row * sample_time, stops, 3e-3);
  for (int k = 0; k < 50; ++k) plant.step(0.0);
  EXPECT_EQ(plant.sample().speed, 0.0);
}

TEST(Plant, StribeckNeedsTheStaticTorqueToBreakAway) {
  PlantParameters p = motor();
  p.coulomb_plus = p.coulomb_minus = 0.01;
  p.stribeck_excess = 0.005;
  p.stribeck_speed = 0.5;
  EXPECT_EQ(after(p, 0.0149 * p.resistance / p.torque_constant, 500).speed, 0.0);
  // Once it slides fast the torque left over is 0.0151 - 0.01 N m, and the back-EMF takes it.
  const double settled = 0.0051 / (p.torque_constant * p.back_emf_constant / p.resistance + p.viscous_friction);
  EXPECT_NEAR(after(p, 0.0151 * p.resistance / p.torque_constant, 2000).speed, settled, 1e-6 * settled);
}

TEST(Plant, BristlesGiveWayElasticallyAndSlideAtTheCoulombLevel) {
  PlantParameters p = motor();
  p.coulomb_plus = p.coulomb_minus = 0.01;
  p.bristle_stiffness = 0.2;
  p.bristle_damping = 2e-3;
  // Loaded slowly in one direction: s0 z = torque with z = g/s0 (1 - exp(-s0 theta/g)).
  const double torque = 0.004;
  Plant plant(p, sample_time, 1.0, fine, fineness);
  for (int k = 0; k <= 20000; ++k) plant.step(k / 20000.0 * torque * p.resistance / p.torque_constant);
  const double angle = -std::log(1.0 - torque / 0.01) * 0.01 / p.bristle_stiffness;
  EXPECT_NEAR(plant.sample().position, angle, 2e-3 * angle);
  const PlantSample slides = after(p, 3.0, 1000);
  EXPECT_NEAR(p.torque_constant * slides.current, 0.01 + p.viscous_friction * slides.speed, 1e-8);
}

TEST(Plant, BacklashPushesOnlyWhenTheGapIsClosed) {
  PlantParameters p = motor();
  p.load_inertia = 0.5 * p.inertia;
  p.gap = 10.0;  // far open: only the motor side moves
  p.stiffness = 40.0;
  p.damping = 0.01;
  PlantParameters light = motor();
  light.inertia *= 0.5;
  EXPECT_NEAR(after(p, 1.0, 10).speed, after(light, 1.0, 10).speed, 1e-9);
  p.gap = 1e-9;  // closed: one stiff body
  EXPECT_NEAR(after(p, 1.0, 400).speed, after(motor(), 1.0, 400).speed, 1e-3);
}

TEST(Plant, FractionalDelayMovesTheVoltageByPartOfASample) {
  PlantParameters p = motor();
  p.delay = 2.3 * sample_time;
  PlantParameters fresh = motor();
  // 5 rows with the delay are 2.7 rows without it; compare with a plant of a tenth of the sample time.
  Plant tenth(fresh, 0.1 * sample_time, 3.0, fine, fineness);
  for (int k = 0; k < 27; ++k) tenth.step(3.0);
  EXPECT_NEAR(after(p, 3.0, 5).speed, tenth.sample().speed, 1e-6);
}

TEST(Plant, HalvingTheStepChangesNothingThatMatters) {
  PlantParameters p = motor();
  p.coulomb_plus = p.coulomb_minus = 0.01;
  p.stribeck_excess = 0.005;
  p.stribeck_speed = 3.0;
  p.cogging_amplitude = 0.004;
  p.cogging_periods = 14;
  Plant coarse(p, sample_time, 2.0, fine, fineness), halved(p, sample_time, 2.0, 2 * fine, 0.5 * fineness);
  double worst = 0.0, largest = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const double v = 1.5 * std::sin(0.02 * k);
    coarse.step(v);
    halved.step(v);
    worst = std::max(worst, std::abs(coarse.sample().speed - halved.sample().speed));
    largest = std::max(largest, std::abs(coarse.sample().speed));
  }
  EXPECT_LT(worst, 2e-3 * largest);
}

TEST(Plant, CoastsDownThroughTheShortedWinding) {
  const PlantParameters p = motor();
  const double first = coasting(p, 5.0, 20).sample().speed, second = coasting(p, 5.0, 40).sample().speed;
  const double electrical = p.inductance / p.resistance;
  const double mechanical =
      p.inertia * p.resistance / (p.torque_constant * p.back_emf_constant + p.resistance * p.viscous_friction);
  EXPECT_NEAR(std::log(first / second), 20 * sample_time / (mechanical - electrical), 0.01);
}

TEST(Plant, StepAllocatesNothing) {
  PlantParameters p = motor();
  p.coulomb_plus = p.coulomb_minus = 0.01;
  p.delay = 3.4e-3;
  Plant plant(p, sample_time, 5.0, fine, fineness);
  const long before = testing::allocations();
  for (int k = 0; k < 1000; ++k) plant.step(k % 100 < 50 ? 5.0 : -5.0);
  EXPECT_EQ(testing::allocations(), before);
}

TEST(Plant, RefusesAMachineWithoutSense) {
  PlantParameters p = motor();
  p.load_inertia = 2.0 * p.inertia;
  EXPECT_THROW(Plant(p, sample_time, 5.0, fine, fineness), std::invalid_argument);
  EXPECT_THROW(Plant(motor(), 0.0, 5.0, fine, fineness), std::invalid_argument);
  EXPECT_THROW(Plant(motor(), sample_time, 5.0, 0, fineness), std::invalid_argument);
  EXPECT_THROW(Plant(motor(), sample_time, 5.0, fine, 0.0), std::invalid_argument);
  p = motor();
  p.inductance = 0.0;
  EXPECT_THROW(Plant(p, sample_time, 5.0, fine, fineness), std::invalid_argument);
  p = motor();
  p.delay = -1e-3;
  EXPECT_THROW(Plant(p, sample_time, 5.0, fine, fineness), std::invalid_argument);
  p = motor();
  p.wander_torque = 0.01;
  p.wander_time = 0.0;
  EXPECT_THROW(Plant(p, sample_time, 5.0, fine, fineness), std::invalid_argument);
}

TEST(Plant, FrictionHoldsInTheDirectionsThatHaveSome) {
  // 0.4 V turn a motor of 0.0135 N m stall torque; a level of 0.02 N m holds it.
  for (const bool forward : {false, true}) {
    PlantParameters p = motor();
    (forward ? p.coulomb_plus : p.coulomb_minus) = 0.02;
    EXPECT_EQ(after(p, forward ? 0.4 : -0.4, 200).speed, 0.0);
    EXPECT_GT(std::abs(after(p, forward ? -0.4 : 0.4, 200).speed), 1.0);
  }
  PlantParameters p = motor();
  p.stribeck_excess = 0.02;  // at standstill alone
  p.stribeck_speed = 2.0;
  EXPECT_EQ(after(p, 0.4, 200).speed, 0.0);
  EXPECT_NEAR(after(p, 1.0, 800).speed, after(motor(), 1.0, 800).speed, 1e-3);
}

}  // namespace
}  // namespace rwn
