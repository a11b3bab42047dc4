#include "task.hpp"

namespace rwn::bind {

void bind_task(py::module_& m) {
  py::class_<Task>(m, "Task", "What is simulated: a drive, the input of one run, and what its effects follow.")
      .def(py::init([](const std::string& drive, const Array& time, const Array& input, const Array& input_time,
                       double angle_per_position,
                       double input_before, const Array& angle, bool angle_from_speed, bool angle_from_start,
                       int restart_every, const Array& restart_speed, const Array& restart_position, int order,
                       const std::vector<OwnEffect>& own) {
             return Task{.drive = drive_of(drive),
                         .time = time,
                         .input = input,
                         .input_time = input_time,
                         .angle = angle,
                         .restart_speed = restart_speed,
                         .restart_position = restart_position,
                         .angle_per_position = angle_per_position,
                         .input_before = input_before,
                         .angle_from_speed = angle_from_speed,
                         .angle_from_start = angle_from_start,
                         .restart_every = restart_every,
                         .order = order,
                         .own = own};
           }),
           "drive"_a, py::kw_only(), "time"_a.noconvert(), "input"_a.noconvert(), "input_time"_a = Array(0), "angle_per_position"_a = 1.0,
           "input_before"_a = 0.0, "angle"_a = Array(0), "angle_from_speed"_a = false, "angle_from_start"_a = false,
           "restart_every"_a = 0, "restart_speed"_a = Array(0), "restart_position"_a = Array(0), "order"_a = 0,
           "own"_a = std::vector<OwnEffect>{});
}

}  // namespace rwn::bind
