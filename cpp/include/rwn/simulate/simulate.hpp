// Free-run simulation of a drive from its input signal alone, with exact derivatives by any chosen parameters.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "rwn/model/drives.hpp"
#include "rwn/model/effects.hpp"
#include "rwn/model/own_effect.hpp"
#include "rwn/simulate/run_settings.hpp"
#include "rwn/simulate/work.hpp"

namespace rwn {

enum class SimulationStatus { ok, diverged, formula_failed };

std::string_view to_string(SimulationStatus status);
std::string_view advice(SimulationStatus status);
/// The inverse of `to_string`. Throws std::invalid_argument for others.
SimulationStatus status_of(std::string_view name);

/// Parameters of motor and effects in one list: the motor's, then each effect's in the order of the table, then the
/// coefficients and the initial state of a transfer function, then `max_own_parameters` for each own effect.
int parameter_count();
/// Index of the first parameter of effect `effect` in that list.
int first_parameter(int effect);
/// Index of b_0 in that list; a_0 and x_1 follow max_order later each.
int first_coefficient();
/// Index of the first parameter of own effect 0.
int first_own_parameter();

/// Place of a kind of drive in the table. Throws std::invalid_argument for a name that is not there.
int drive_of(std::string_view name);

/// How many of the effects bring a second mass.
int joint_count(std::span<const int> active);

/// What to simulate; spans must outlive the call. A new field stands here, or in RunSettings where it is one number,
/// and in the list of keyword arguments in cpp/bind/bind_task.cpp; an array has its pointer in SimulationSlice.
struct SimulationTask : RunSettings {
  int drive = 0;                       // place in the table of drives
  std::span<const double> time;        // (n) [s], increasing
  std::span<const double> input;       // (m) voltage [V] or torque [N m], held from its instant to the next
  std::span<const double> input_time;  // (m) these instants [s], increasing; empty: the rows' own, m = n
  std::span<const double> parameters;  // (parameter_count()) SI
  std::span<const int> active;         // effects switched on, by index in the table; own effects count on behind it
  std::span<const int> by;             // (p) parameters to differentiate by
  std::span<const double> angle;       // (n) recorded position that angle-dependent effects follow instead of the
                                       // simulated one, which drifts; empty: free run
  std::span<const double> restart_speed, restart_position;  // (n) recorded motion; not read where restart_every is 0
  std::span<const OwnEffect> own;      // users' effects, by slot; none for drive lti
  Work* work = nullptr;                // what the run costs is added here
};

/// Signals at the rows' times, before the new input acts; derivatives are (n, p) row-major. Empty spans are not
/// written.
struct SimulationOutput {
  std::span<double> current, speed, position;        // (n)
  std::span<double> d_current, d_speed, d_position;  // (n, p)
};

/// Throws std::invalid_argument for lengths or indices that do not fit. A run that leaves the finite numbers stops
/// with `diverged`, one in which a user's formula has no finite value with `formula_failed`; the signals from there on
/// are held at the last finite value.
SimulationStatus simulate(const SimulationTask& task, const SimulationOutput& output);

}  // namespace rwn
