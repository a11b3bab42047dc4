#include "plant/plant.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rwn {

namespace {

constexpr double two_pi = 6.283185307179586;
constexpr int most_substeps = 2000;
constexpr int most_events = 8;  // reversals located in one Runge-Kutta step

double sign(double x) { return x < 0.0 ? -1.0 : 1.0; }

}  // namespace

Plant::Plant(const PlantParameters& parameters, double sample_time, double voltage_scale, int substeps, double fineness)
    : p_(parameters),
      sample_time_(sample_time),
      wander_(parameters.wander_torque, parameters.wander_time, parameters.wander_seed) {
  if (!(sample_time > 0.0) || substeps < 1 || !(fineness > 0.0)) {
    throw std::invalid_argument("plant: sample time, substeps and fineness must be positive");
  }
  const double elsewhere = p_.load_inertia + p_.absorber_inertia + std::abs(p_.inertia_variation);
  if (!(p_.inductance > 0.0) || !(p_.inertia > elsewhere) || !(p_.delay >= 0.0)) {
    throw std::invalid_argument(
        "plant: inductance and the inertia left on the motor side must be positive, delay not negative");
  }
  two_mass_ = p_.load_inertia > 0.0;
  lugre_ = p_.bristle_stiffness > 0.0;
  dry_ = !lugre_ && (p_.coulomb_plus > 0.0 || p_.coulomb_minus > 0.0 || p_.stribeck_excess > 0.0 ||
                     p_.friction_ratio > 0.0 || p_.iron_loss > 0.0);
  const double stiff =
      1.0 / std::max(p_.speed_lag, 1e-12) * (p_.speed_lag > 0.0) +
      (lugre_ ? p_.bristle_stiffness * 1.2 * voltage_scale / p_.back_emf_constant / p_.coulomb_plus : 0.0);
  const double needed = sample_time * std::max(fastest_rate(voltage_scale) / fineness, stiff / 1.5);
  substeps_ = static_cast<int>(std::clamp(std::ceil(needed), double(substeps), double(most_substeps)));
  whole_delay_ = static_cast<std::size_t>(p_.delay / sample_time);
  fraction_delay_ = p_.delay - double(whole_delay_) * sample_time;
  commands_.resize(whole_delay_ + 2);
  edges_.reserve(8);  // those of a step without samples between its ends
  reset();
}

/// An upper bound of how fast the states move [1/s].
double Plant::fastest_rate(double voltage_scale) const {
  const double top_speed = 1.2 * voltage_scale / p_.back_emf_constant;
  const double saturating = std::isfinite(p_.saturation_current) ? 4.0 : 1.0;
  const double electrical = saturating * p_.resistance / p_.inductance +
                            p_.brush_drop / (p_.brush_current * p_.inductance);
  const double coupled = std::sqrt(p_.torque_constant * p_.back_emf_constant / (p_.inertia * p_.inductance));
  double angular = 0.0;
  if (p_.cogging_amplitude != 0.0) angular = p_.cogging_periods;
  if (p_.ripple_amplitude != 0.0) angular = std::max(angular, p_.ripple_harmonic);
  if (p_.inertia_variation != 0.0) angular = std::max(angular, 2.0);
  if (p_.friction_wave != 0.0) angular = std::max(angular, 5.0);
  double rate = std::max(
      {electrical, coupled, angular * top_speed, two_pi * p_.periodic_frequency * (p_.periodic_amplitude != 0.0)});
  const double motor_side = rotor_inertia();
  const double supply = two_pi * p_.supply_ripple_frequency * (p_.supply_ripple != 0.0);
  rate = std::max({rate, supply, std::sqrt(p_.load_spring / motor_side)});
  if (p_.absorber_inertia > 0.0) {
    const double damped = p_.absorber_damping / p_.absorber_inertia;
    rate = std::max(rate, std::sqrt(p_.absorber_stiffness / p_.absorber_inertia) + damped);
  }
  if (two_mass_) {
    const double reduced = motor_side * p_.load_inertia / p_.inertia;
    const double impacts = p_.gap > 0.0 ? 4.0 : 1.0;  // the contact force jumps
    rate = std::max(rate, impacts * (std::sqrt(p_.stiffness / reduced) + p_.damping / reduced));
  }
  if (lugre_) rate = std::max(rate, std::sqrt(p_.bristle_stiffness / motor_side) + p_.bristle_damping / motor_side);
  return std::max(rate, p_.stribeck_excess / (p_.stribeck_speed * motor_side));
}

void Plant::reset() {
  x_.fill(0.0);
  std::fill(commands_.begin(), commands_.end(), 0.0);
  voltage_ = slope_ = voltage_time_ = 0.0;
  row_ = 0;
  loaded_ = false;
  contact_ = dry_ ? Contact::sticks : Contact::frictionless;
}

PlantSample Plant::sample() const {
  double seen = p_.speed_lag > 0.0 ? x_[lagged] : x_[speed];
  if (p_.rectification != 0.0) seen = std::abs(seen);
  if (p_.eccentricity != 0.0) seen *= 1.0 + p_.eccentricity * std::sin(x_[position] + p_.eccentricity_phase);
  seen += p_.speed_offset;
  if (p_.speed_quantum > 0.0) seen = p_.speed_quantum * std::round(seen / p_.speed_quantum);
  return {x_[current], x_[speed], x_[position], x_[current] + p_.current_offset, seen, x_[heat]};
}

Plant::State Plant::runge_kutta(const State& x, double t, double h) const {
  const auto moved = [&x](const State& slope, double by) {
    State y;
    for (std::size_t k = 0; k < size; ++k) y[k] = x[k] + by * slope[k];
    return y;
  };
  const State a = derivative(x, t);
  const State b = derivative(moved(a, 0.5 * h), t + 0.5 * h);
  const State c = derivative(moved(b, 0.5 * h), t + 0.5 * h);
  const State d = derivative(moved(c, h), t + h);
  State y;
  for (std::size_t k = 0; k < size; ++k) y[k] = x[k] + h / 6.0 * (a[k] + 2.0 * (b[k] + c[k]) + d[k]);
  return y;
}

/// Torque on the rotor at rest without dry friction.
double Plant::free_torque(const State& x, double t) const { return electrics(x, t).torque - loads(x, t); }

/// With the rotor at rest: does it stick or slide, and which way.
void Plant::settle_contact(double t) {
  const double torque = free_torque(x_, t);
  const double level = friction_level(x_, t, electrics(x_, t).torque, torque);
  if (std::abs(torque) <= level) {
    contact_ = Contact::sticks;
  } else {
    contact_ = torque > 0.0 ? Contact::forward : Contact::backward;
  }
}

/// Part of the step h after which the sliding rotor stands still (regula falsi, Illinois); `landed` is the state there.
double Plant::reversal(double t, double h, State& landed) const {
  double low = 0.0, high = h;
  double at_low = x_[speed], at_high = landed[speed];
  double part = 0.0;
  for (int k = 0; k < 12; ++k) {
    part = low + (high - low) * at_low / (at_low - at_high);
    landed = runge_kutta(x_, t, part);
    const double now = landed[speed];
    if (std::abs(now) < 1e-12 * (1.0 + std::abs(x_[speed])) || high - low < 1e-12 * h) break;
    if (now * at_high > 0.0) {
      high = part, at_high = now, at_low *= 0.5;
    } else {
      low = part, at_low = now, at_high *= 0.5;
    }
  }
  landed[speed] = 0.0;
  return part;
}

void Plant::advance(double t, double h) {
  for (int event = 0; event < most_events; ++event) {
    if (contact_ == Contact::sticks) settle_contact(t);
    State next = runge_kutta(x_, t, h);
    const bool slides = contact_ == Contact::forward || contact_ == Contact::backward;
    const bool reverses = slides && next[speed] * static_cast<double>(contact_) < 0.0;
    if (!reverses) {
      x_ = next;
      return;
    }
    if (x_[speed] == 0.0) {  // pushed back at once: it never left
      contact_ = Contact::sticks;
      x_ = runge_kutta(x_, t, h);
      return;
    }
    const double part = reversal(t, h, next);
    x_ = next;
    t += part;
    h -= part;
    settle_contact(t);
  }
  x_ = runge_kutta(x_, t, h);
}

/// From `begin` to `end` with one command: ramps up to it if the driver must, then holds it.
void Plant::segment(double begin, double end, double command) {
  const double target = applied(command);
  while (end - begin > 1e-12 * sample_time_) {
    double until = end;
    const double gap = target - (voltage_ + slope_ * (begin - voltage_time_));
    const double arrival = begin + std::abs(gap) / p_.slew_rate;
    if (arrival - begin <= 1e-9 * sample_time_) {  // what rounding leaves would be approached for ever
      voltage_ = target;
      slope_ = 0.0;
    } else {
      voltage_ = target - gap;
      slope_ = sign(gap) * p_.slew_rate;
      until = std::min(end, arrival);
    }
    voltage_time_ = begin;
    const int steps = std::max(1, static_cast<int>(std::ceil((until - begin) / sample_time_ * substeps_ - 1e-9)));
    const double h = (until - begin) / steps;
    for (int k = 0; k < steps; ++k) advance(begin + k * h, h);
    begin = until;
  }
}

void Plant::wait() {
  commands_[static_cast<std::size_t>(row_ % static_cast<long long>(commands_.size()))] = 0.0;
  ++row_;
}

void Plant::step(double voltage, std::span<PlantSample> seen) {
  const auto ring = static_cast<long long>(commands_.size());
  commands_[static_cast<std::size_t>(row_ % ring)] = voltage;
  const auto command = [&](long long row) { return row < 0 ? 0.0 : commands_[static_cast<std::size_t>(row % ring)]; };
  const long long newest = row_ - static_cast<long long>(whole_delay_);
  const double begin = double(row_) * sample_time_;
  const double end = begin + sample_time_;
  const double switches = begin + fraction_delay_;
  wander_.extend(end);

  limit_ = std::max(p_.voltage_limit - p_.supply_resistance * std::abs(x_[current]), 0.0);

  edges_.assign({begin, switches, p_.load_start, p_.load_end, end});
  const double apart = seen.empty() ? sample_time_ : sample_time_ / double(seen.size());
  for (std::size_t k = 1; k < seen.size(); ++k) edges_.push_back(begin + double(k) * apart);
  for (double& edge : edges_) edge = std::clamp(edge, begin, end);
  std::sort(edges_.begin(), edges_.end());
  std::size_t next = 0;
  for (std::size_t k = 0; k + 1 < edges_.size(); ++k) {
    while (next < seen.size() && begin + double(next) * apart <= edges_[k]) seen[next++] = sample();
    const double middle = 0.5 * (edges_[k] + edges_[k + 1]);
    loaded_ = p_.load_torque != 0.0 && middle > p_.load_start && middle < p_.load_end;
    segment(edges_[k], edges_[k + 1], command(middle < switches ? newest - 1 : newest));
  }
  ++row_;
}

}  // namespace rwn
