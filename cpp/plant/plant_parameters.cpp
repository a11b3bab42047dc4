#include "plant/plant_parameters.hpp"

namespace rwn {

const std::vector<PlantParameterName>& plant_parameter_names() {
  using P = PlantParameters;
  static const std::vector<PlantParameterName> names{
#define RWN_NAME(member) {#member, &P::member}
      RWN_NAME(resistance), RWN_NAME(inductance), RWN_NAME(torque_constant), RWN_NAME(back_emf_constant),
      RWN_NAME(inertia), RWN_NAME(viscous_friction), RWN_NAME(coulomb_plus), RWN_NAME(coulomb_minus),
      RWN_NAME(stribeck_excess), RWN_NAME(stribeck_speed), RWN_NAME(friction_variation), RWN_NAME(friction_phase),
      RWN_NAME(friction_ratio), RWN_NAME(bristle_stiffness), RWN_NAME(bristle_damping), RWN_NAME(quadratic_drag),
      RWN_NAME(cubic_drag), RWN_NAME(root_drag), RWN_NAME(cogging_amplitude), RWN_NAME(cogging_periods),
      RWN_NAME(cogging_phase), RWN_NAME(unbalance_amplitude), RWN_NAME(unbalance_phase), RWN_NAME(load_torque),
      RWN_NAME(load_start), RWN_NAME(load_end), RWN_NAME(inertia_variation), RWN_NAME(periodic_amplitude),
      RWN_NAME(periodic_frequency), RWN_NAME(periodic_phase), RWN_NAME(reluctance_torque), RWN_NAME(viscous_excess),
      RWN_NAME(viscous_time), RWN_NAME(load_inertia), RWN_NAME(load_viscous), RWN_NAME(stiffness), RWN_NAME(damping),
      RWN_NAME(gap), RWN_NAME(brush_drop), RWN_NAME(brush_current), RWN_NAME(thermal_resistance),
      RWN_NAME(heat_capacity),
      RWN_NAME(temperature_coefficient), RWN_NAME(saturation_current), RWN_NAME(ripple_amplitude),
      RWN_NAME(ripple_harmonic), RWN_NAME(flux_drift), RWN_NAME(delay), RWN_NAME(compression), RWN_NAME(deadzone),
      RWN_NAME(voltage_limit), RWN_NAME(slew_rate), RWN_NAME(speed_lag), RWN_NAME(rectification),
      RWN_NAME(speed_offset), RWN_NAME(current_offset), RWN_NAME(speed_quantum),
      RWN_NAME(friction_drift), RWN_NAME(friction_wave), RWN_NAME(friction_wave_phase_2),
      RWN_NAME(friction_wave_phase_3), RWN_NAME(friction_wave_phase_5), RWN_NAME(iron_loss), RWN_NAME(iron_exponent),
      RWN_NAME(band_drag), RWN_NAME(band_speed), RWN_NAME(band_width), RWN_NAME(eccentric_drag),
      RWN_NAME(eccentric_phase), RWN_NAME(load_spring), RWN_NAME(added_inertia), RWN_NAME(wander_torque),
      RWN_NAME(wander_time), RWN_NAME(wander_seed), RWN_NAME(absorber_inertia), RWN_NAME(absorber_stiffness),
      RWN_NAME(absorber_damping), RWN_NAME(flux_temperature), RWN_NAME(supply_resistance), RWN_NAME(supply_ripple),
      RWN_NAME(supply_ripple_frequency), RWN_NAME(eccentricity), RWN_NAME(eccentricity_phase)
#undef RWN_NAME
  };
  return names;
}

}  // namespace rwn
