// The table of effects. A new effect is a file in effects/, its include and its entry in the tuple; nothing else.
#pragma once

#include <tuple>

#include "rwn/effects/actuator_deadzone.hpp"
#include "rwn/effects/asymmetric_friction.hpp"
#include "rwn/effects/backlash.hpp"
#include "rwn/effects/brush_voltage_drop.hpp"
#include "rwn/effects/cogging_torque.hpp"
#include "rwn/effects/constant_load.hpp"
#include "rwn/effects/coulomb_friction.hpp"
#include "rwn/effects/inertia_variation.hpp"
#include "rwn/effects/input_delay.hpp"
#include "rwn/effects/load_dependent_friction.hpp"
#include "rwn/effects/load_disturbance.hpp"
#include "rwn/effects/magnetic_saturation.hpp"
#include "rwn/effects/position_dependent_friction.hpp"
#include "rwn/effects/presliding_hysteresis.hpp"
#include "rwn/effects/quadratic_drag.hpp"
#include "rwn/effects/resistance_heating.hpp"
#include "rwn/effects/sensor_bias.hpp"
#include "rwn/effects/sensor_quantization.hpp"
#include "rwn/effects/sensor_rectification.hpp"
#include "rwn/effects/shaft_compliance.hpp"
#include "rwn/effects/speed_sensor_lag.hpp"
#include "rwn/effects/stribeck_friction.hpp"
#include "rwn/effects/torque_ripple.hpp"
#include "rwn/effects/unbalance.hpp"
#include "rwn/effects/viscous_asymmetry.hpp"
#include "rwn/effects/viscous_friction.hpp"
#include "rwn/effects/voltage_saturation.hpp"

namespace rwn {

using Effects =
    std::tuple<ViscousFriction, CoulombFriction, StribeckFriction, AsymmetricFriction, ViscousAsymmetry, QuadraticDrag,
               LoadDependentFriction, PreslidingHysteresis, PositionDependentFriction, CoggingTorque, Unbalance,
               ConstantLoad, LoadDisturbance, Backlash, ShaftCompliance, InertiaVariation, BrushVoltageDrop,
               ResistanceHeating, MagneticSaturation, TorqueRipple, ActuatorDeadzone, VoltageSaturation, InputDelay,
               SpeedSensorLag, SensorRectification, SensorBias, SensorQuantization>;

inline constexpr int effect_count = static_cast<int>(std::tuple_size_v<Effects>);

}  // namespace rwn
