#include <algorithm>
#include <cmath>

#include "plant/plant.hpp"

namespace rwn {

namespace {

constexpr double two_pi = 6.283185307179586;

double sign(double x) { return x < 0.0 ? -1.0 : 1.0; }

}  // namespace

/// The driver: command to terminal voltage.
double Plant::applied(double command) const {
  double v = command * (1.0 - p_.compression * command * command);
  v = sign(v) * std::max(std::abs(v) - p_.deadzone, 0.0);
  return std::clamp(v, -limit_, limit_);
}

Plant::Electrics Plant::electrics(const State& x, double t) const {
  const double i = x[current];
  const double ratio = i / p_.saturation_current;
  const double saturation = 1.0 / (1.0 + ratio * ratio);
  double flux = saturation;
  if (p_.ripple_amplitude != 0.0) flux *= 1.0 + p_.ripple_amplitude * std::cos(p_.ripple_harmonic * x[position]);
  flux *= 1.0 + p_.flux_drift * t;
  if (p_.flux_temperature != 0.0) flux *= 1.0 - p_.flux_temperature * x[heat];
  const double resistance = p_.resistance * (1.0 + p_.temperature_coefficient * x[heat]);
  double terminal = voltage_ + slope_ * (t - voltage_time_);
  if (p_.supply_ripple != 0.0) terminal *= 1.0 + p_.supply_ripple * std::sin(two_pi * p_.supply_ripple_frequency * t);
  double v = terminal - resistance * i - p_.back_emf_constant * flux * x[speed];
  if (p_.brush_drop != 0.0) v -= p_.brush_drop * std::tanh(i / p_.brush_current);
  return {v / (p_.inductance * saturation), p_.torque_constant * flux * i, resistance * i * i};
}

double Plant::friction_level(const State& x, double t, double torque, double direction) const {
  double level = direction < 0.0 ? p_.coulomb_minus : p_.coulomb_plus;
  if (p_.stribeck_excess != 0.0) {
    const double slip = x[speed] / p_.stribeck_speed;
    level += p_.stribeck_excess * std::exp(-slip * slip);
  }
  if (p_.friction_variation != 0.0) level *= 1.0 + p_.friction_variation * std::cos(x[position] + p_.friction_phase);
  if (p_.friction_wave != 0.0) {
    const double turned = x[position];
    level *= 1.0 + p_.friction_wave * (std::cos(2.0 * turned + p_.friction_wave_phase_2) +
                                       std::cos(3.0 * turned + p_.friction_wave_phase_3) +
                                       std::cos(5.0 * turned + p_.friction_wave_phase_5));
  }
  if (p_.friction_drift != 0.0) level *= std::max(1.0 + p_.friction_drift * t, 0.0);
  level += p_.friction_ratio * std::abs(torque);
  if (p_.iron_loss != 0.0) level += p_.iron_loss * std::pow(std::abs(x[current]), p_.iron_exponent);
  return level;
}

/// From motor to load; through a gap it pushes and never pulls.
double Plant::shaft_torque(const State& x) const {
  const double twist = x[position] - x[load_position];
  const double bend = twist - std::clamp(twist, -0.5 * p_.gap, 0.5 * p_.gap);
  const double torque = p_.stiffness * bend + p_.damping * (x[speed] - x[load_speed]);
  if (p_.gap > 0.0 && torque * bend <= 0.0) return 0.0;
  return torque;
}

/// From rotor to the small mass on it.
double Plant::absorber_torque(const State& x) const {
  const double twist = x[position] - x[absorber_position];
  return p_.absorber_stiffness * twist + p_.absorber_damping * (x[speed] - x[absorber_speed]);
}

/// All braking torques on the rotor except dry friction.
double Plant::loads(const State& x, double t) const {
  const double w = x[speed];
  const double speed_now = std::abs(w);
  double torque = (p_.viscous_friction - p_.load_viscous) * w;
  torque += (p_.quadratic_drag * speed_now + p_.cubic_drag * w * w) * w;
  if (p_.root_drag != 0.0) torque += p_.root_drag * sign(w) * std::sqrt(speed_now);
  if (p_.cogging_amplitude != 0.0)
    torque += p_.cogging_amplitude * std::sin(p_.cogging_periods * x[position] + p_.cogging_phase);
  if (p_.unbalance_amplitude != 0.0) torque += p_.unbalance_amplitude * std::sin(x[position] + p_.unbalance_phase);
  if (loaded_) torque += p_.load_torque;
  if (p_.periodic_amplitude != 0.0)
    torque += p_.periodic_amplitude * std::sin(two_pi * p_.periodic_frequency * t + p_.periodic_phase);
  if (p_.viscous_excess != 0.0) torque += p_.viscous_excess * std::exp(-t / p_.viscous_time) * w;
  if (p_.reluctance_torque != 0.0) torque += p_.reluctance_torque * x[current] * x[current];
  if (p_.inertia_variation != 0.0) torque -= p_.inertia_variation * std::sin(2.0 * x[position]) * w * w;
  if (p_.band_drag != 0.0) {
    const double off = (speed_now - p_.band_speed) / p_.band_width;
    torque += p_.band_drag * sign(w) * std::exp(-off * off);
  }
  if (p_.eccentric_drag != 0.0) torque += p_.eccentric_drag * w * std::cos(x[position] + p_.eccentric_phase);
  if (p_.load_spring != 0.0) torque += p_.load_spring * x[position];
  if (!wander_.still()) torque += wander_.at(t);
  if (p_.absorber_inertia > 0.0) torque += absorber_torque(x);
  if (two_mass_) torque += shaft_torque(x);
  return torque;
}

Plant::State Plant::derivative(const State& x, double t) const {
  State d{};
  const Electrics e = electrics(x, t);
  d[current] = e.current_rate;
  if (p_.temperature_coefficient != 0.0 || p_.flux_temperature != 0.0)
    d[heat] = (e.heating - x[heat] / p_.thermal_resistance) / p_.heat_capacity;
  if (contact_ != Contact::sticks) {
    double torque = e.torque - loads(x, t);
    if (contact_ != Contact::frictionless) {
      const double direction = contact_ == Contact::forward ? 1.0 : -1.0;
      torque -= direction * friction_level(x, t, e.torque, direction);
    }
    if (lugre_) {
      const double level = friction_level(x, t, e.torque, x[speed]);
      d[bristle] = x[speed] - p_.bristle_stiffness * std::abs(x[speed]) * x[bristle] / level;
      torque -= p_.bristle_stiffness * x[bristle] + p_.bristle_damping * d[bristle];
    }
    double inertia = rotor_inertia() + p_.added_inertia * std::abs(x[speed]);
    if (p_.inertia_variation != 0.0) inertia += p_.inertia_variation * std::cos(2.0 * x[position]);
    d[speed] = torque / inertia;
    d[position] = x[speed];
  }
  if (two_mass_) {
    d[load_speed] = (shaft_torque(x) - p_.load_viscous * x[load_speed]) / p_.load_inertia;
    d[load_position] = x[load_speed];
  }
  if (p_.absorber_inertia > 0.0) {
    d[absorber_speed] = absorber_torque(x) / p_.absorber_inertia;
    d[absorber_position] = x[absorber_speed];
  }
  if (p_.speed_lag > 0.0) d[lagged] = (x[speed] - x[lagged]) / p_.speed_lag;
  return d;
}

}  // namespace rwn
