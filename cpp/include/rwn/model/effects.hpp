// The table of effects. A new effect is a file in effects/, its include and its entry in the tuple; nothing else.
#pragma once

#include <string_view>
#include <tuple>

#include "rwn/model/effects/actuator_deadzone.hpp"
#include "rwn/model/effects/amplifier_gain_curve.hpp"
#include "rwn/model/effects/asymmetric_friction.hpp"
#include "rwn/model/effects/backlash.hpp"
#include "rwn/model/effects/brush_voltage_drop.hpp"
#include "rwn/model/effects/coasting_bridge.hpp"
#include "rwn/model/effects/cogging_torque.hpp"
#include "rwn/model/effects/constant_load.hpp"
#include "rwn/model/effects/coulomb_friction.hpp"
#include "rwn/model/effects/current_limit.hpp"
#include "rwn/model/effects/current_sensor_delay.hpp"
#include "rwn/model/effects/current_sensor_lag.hpp"
#include "rwn/model/effects/geared_unbalance.hpp"
#include "rwn/model/effects/inertia_variation.hpp"
#include "rwn/model/effects/input_delay.hpp"
#include "rwn/model/effects/load_dependent_friction.hpp"
#include "rwn/model/effects/load_disturbance.hpp"
#include "rwn/model/effects/load_encoder_backlash.hpp"
#include "rwn/model/effects/load_encoder_compliance.hpp"
#include "rwn/model/effects/load_spring.hpp"
#include "rwn/model/effects/magnetic_saturation.hpp"
#include "rwn/model/effects/position_dependent_friction.hpp"
#include "rwn/model/effects/power_law_drag.hpp"
#include "rwn/model/effects/power_law_load_friction.hpp"
#include "rwn/model/effects/presliding_hysteresis.hpp"
#include "rwn/model/effects/pwm_supply_sag.hpp"
#include "rwn/model/effects/quadratic_drag.hpp"
#include "rwn/model/effects/resistance_heating.hpp"
#include "rwn/model/effects/sensor_bias.hpp"
#include "rwn/model/effects/sensor_gain.hpp"
#include "rwn/model/effects/sensor_quantization.hpp"
#include "rwn/model/effects/sensor_rectification.hpp"
#include "rwn/model/effects/shaft_compliance.hpp"
#include "rwn/model/effects/slew_rate_limit.hpp"
#include "rwn/model/effects/speed_moving_average.hpp"
#include "rwn/model/effects/speed_sensor_delay.hpp"
#include "rwn/model/effects/speed_sensor_lag.hpp"
#include "rwn/model/effects/stribeck_friction.hpp"
#include "rwn/model/effects/supply_sag.hpp"
#include "rwn/model/effects/torque_ripple.hpp"
#include "rwn/model/effects/unbalance.hpp"
#include "rwn/model/effects/viscous_asymmetry.hpp"
#include "rwn/model/effects/viscous_friction.hpp"
#include "rwn/model/effects/voltage_saturation.hpp"

namespace rwn {

using Effects =
    std::tuple<ViscousFriction, CoulombFriction, StribeckFriction, AsymmetricFriction, ViscousAsymmetry, QuadraticDrag,
               PowerLawDrag, LoadDependentFriction, PowerLawLoadFriction, PreslidingHysteresis,
               PositionDependentFriction, CoggingTorque, Unbalance, GearedUnbalance, ConstantLoad, LoadSpring,
               LoadDisturbance, Backlash, ShaftCompliance, LoadEncoderBacklash, LoadEncoderCompliance, InertiaVariation,
               BrushVoltageDrop, CoastingBridge, ResistanceHeating, MagneticSaturation, TorqueRipple, ActuatorDeadzone,
               VoltageSaturation, SupplySag, PwmSupplySag, CurrentLimit, SlewRateLimit, AmplifierGainCurve, InputDelay,
               SpeedSensorLag, SpeedMovingAverage, SpeedSensorDelay, CurrentSensorLag, CurrentSensorDelay,
               SensorRectification, SensorGain, SensorBias, SensorQuantization>;

inline constexpr int effect_count = static_cast<int>(std::tuple_size_v<Effects>);

namespace detail {
template <class E, class... All>
consteval bool has_known_special_case() {
  constexpr std::string_view name = E::traits.special_case;
  return name.empty() || (name != E::info.name && ((name == All::info.name) || ...));
}
template <class... E>
consteval bool all_effects(const std::tuple<E...>*) {
  static_assert((0 + ... + E::traits.memories) <= max_memories, "there is no room for the memories of all effects");
  static_assert((has_known_special_case<E, E...>() && ...), "a special case is another effect of the table");
  return (Effect<E> && ...);
}
}  // namespace detail
static_assert(detail::all_effects(static_cast<const Effects*>(nullptr)));

}  // namespace rwn
