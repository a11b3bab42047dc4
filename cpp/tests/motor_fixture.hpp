// A motor under a chirp, and its speed.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "rwn/simulate/simulate.hpp"

namespace {

struct Case {
  std::vector<double> time, input, parameters, angle;
  std::vector<int> active, by;
  int drive = rwn::drive_of("dc");
  bool angle_from_speed = false;

  rwn::SimulationTask task() const {
    rwn::SimulationTask t;
    t.drive = drive;
    t.time = time;
    t.input = input;
    t.parameters = parameters;
    t.active = active;
    t.by = by;
    t.angle = angle;
    t.angle_from_speed = angle_from_speed;
    return t;
  }
};

/// A 24 V motor under a chirp.
inline Case motor(int samples = 400, double step = 1e-3) {
  Case c;
  for (int k = 0; k < samples; ++k) {
    const double t = step * k;
    c.time.push_back(t);
    c.input.push_back(12.0 * std::sin(2.0 * std::numbers::pi * (1.0 + 4.0 * t) * t));
  }
  c.parameters.assign(static_cast<std::size_t>(rwn::parameter_count()), 0.0);
  c.parameters[rwn::resistance] = 0.8;
  c.parameters[rwn::inductance] = 1.5e-3;
  c.parameters[rwn::torque_constant] = 0.1;
  c.parameters[rwn::back_emf_constant] = 0.1;
  c.parameters[rwn::inertia] = 3e-4;
  c.parameters[rwn::viscous_friction] = 7e-5;
  c.parameters[rwn::coulomb_friction] = 0.02;
  return c;
}

inline std::vector<double> speed_of(const Case& c) {
  std::vector<double> speed(c.time.size());
  EXPECT_EQ(rwn::simulate(c.task(), {{}, speed, {}, {}, {}, {}}), rwn::SimulationStatus::ok);
  return speed;
}

}  // namespace
