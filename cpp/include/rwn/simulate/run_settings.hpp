// What is one number of a run that is simulated: the task and its slice for a kernel hold it alike.
#pragma once

namespace rwn {

struct RunSettings {
  double angle_per_position = 1.0;  // 2 pi for a linear axis
  double input_before = 0.0;        // input before the first row (matters with an input delay)
  bool angle_from_speed = false;    // the angle is the integral of a recorded speed, with what its sensor adds
  bool angle_from_start = false;    // the angle is counted from the initial position
  int restart_every = 0;            // samples after which the motion restarts from the recorded one; 0: never
  int order = 0;                    // of a transfer function (drive lti)
};

}  // namespace rwn
