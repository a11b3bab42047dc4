// What a winding does with a current, a speed and an input.
#include "rwn/model/winding.hpp"

#include <gtest/gtest.h>

#include "rwn/model/drives.hpp"

namespace rwn {
namespace {

constexpr Winding<double> small{
    .resistance = 0.8, .inductance = 1.5e-3, .torque_constant = 0.1, .back_emf_constant = 0.11};

TEST(Winding, ACurrentAtRestTakesTheVoltageThatTheSpeedLeaves) {
  const double speed = 30.0, input = 12.0, current = small.resting_current(speed, input);
  EXPECT_NEAR(small.resting_voltage(current), small.driving_voltage(speed, input), 1e-14);
  EXPECT_NEAR(small.resting_voltage(current) + small.back_emf(speed), input, 1e-14);
}

TEST(Winding, TheBackEmfBrakesWithTheTorqueOfTheCurrentThatItDrives) {
  const double speed = 30.0, inertia = 3e-4;
  EXPECT_NEAR(small.torque(small.resting_current(speed, 0.0)), -small.braking_rate(inertia) * inertia * speed, 1e-14);
}

TEST(Winding, TheResistanceTurnsTheSquareOfTheCurrentToHeat) { EXPECT_DOUBLE_EQ(small.heat(4.0), 3.2); }

TEST(Winding, EveryDriveShowsItsOwn) {
  Motor<double> motor{};
  motor[resistance] = small.resistance;
  motor[inductance] = small.inductance;
  motor[torque_constant] = small.torque_constant;
  motor[back_emf_constant] = small.back_emf_constant;
  const DcDrive::Electrics<double> electrics(motor);
  EXPECT_EQ(electrics.winding().resting_current(30.0, 12.0), small.resting_current(30.0, 12.0));
  EXPECT_EQ(AxisDrive::Electrics<double>(motor).winding().resistance, 0.0);
}

}  // namespace
}  // namespace rwn
