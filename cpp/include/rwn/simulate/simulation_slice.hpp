// What src/simulate/simulate.cpp hands to the kernel of its instruction set.
#pragma once

#include "rwn/model/own_effect.hpp"
#include "rwn/simulate/run_settings.hpp"

namespace rwn {

/// Derivatives by which a motion of two masses is run at a time: a run with 12 takes longer than two with 8.
inline constexpr int width_of_two_masses = 8;

/// As SimulationTask, in plain pointers (files of cpp/kernels use no std containers); derivatives by columns
/// [column, column + N) of `by`.
struct SimulationSlice {
  RunSettings settings;
  const double* time;
  const double* input;
  const double* input_time;  // instants from which the inputs are held
  int inputs;
  int samples;
  const double* parameters;
  const int* active;
  int active_count;
  const int* first_parameter;  // per effect of the table
  const int* column_of;        // per parameter: its column, or -1
  int column;
  const double* angle;  // recorded position, or null
  const double* restart_speed;
  const double* restart_position;
  double *current, *speed, *position, *d_current, *d_speed, *d_position;
  int columns;             // row length of the derivative arrays
  int masses;              // 1, or 2 where an effect brings a joint
  int first_coefficient;   // place of its coefficients among the parameters
  const OwnProgram* own;   // by slot
  int first_own;           // place of the parameters of slot 0
  bool* formula_failed;    // set where a user's formula gave no finite number
  long* work;              // what the run costs is added here
  int width;               // derivatives at once: 0, 4, 8, 12 or 16; a kernel may hold more
};

}  // namespace rwn
