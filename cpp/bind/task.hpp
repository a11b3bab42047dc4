// What is simulated, as Python holds it: the arrays of one run and the equations that it obeys.
#pragma once

#include <optional>
#include <vector>

#include "bind.hpp"
#include "rwn/simulate/simulate.hpp"

namespace rwn::bind {

/// The part of a SimulationTask that stays while its parameters are tried; keeps its arrays.
struct Task {
  int drive = 0;
  Array time, input, input_time, angle, restart_speed, restart_position;
  double angle_per_position = 1.0, input_before = 0.0;
  bool angle_from_speed = false, angle_from_start = false;
  int restart_every = 0, order = 0;
  std::vector<OwnEffect> own;

  /// With parameters, the effects `active`, and derivatives by the parameters `by`; all of these outlive the call.
  SimulationTask with(const Array& parameters, const std::vector<int>& active, const std::vector<int>& by,
                      Work* work) const {
    return {.drive = drive,
            .time = view(time),
            .input = view(input),
            .input_time = view(input_time),
            .parameters = view(parameters),
            .active = active,
            .by = by,
            .angle_per_position = angle_per_position,
            .input_before = input_before,
            .angle = view(angle),
            .angle_from_speed = angle_from_speed,
            .angle_from_start = angle_from_start,
            .restart_every = restart_every,
            .restart_speed = view(restart_speed),
            .restart_position = view(restart_position),
            .order = order,
            .own = own,
            .work = work};
  }
};

}  // namespace rwn::bind
