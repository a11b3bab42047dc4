#include "rwn/simulate/unknown_inputs.hpp"

#include "task.hpp"

namespace rwn::bind {
namespace {

/// What the equations leave over along a motion.
struct LeftOver {
  Array torque, voltage;
};

LeftOver left_over(const Task& task, const Array& parameters, const std::vector<int>& active, const Array& speed,
                   const Array& position, const Array& acceleration, const Array& current, const Array& current_slope) {
  Array torque(static_cast<py::ssize_t>(task.fixed.time.size())), voltage(current.size());
  unknown_inputs(task.with(parameters, active, {}, nullptr),
                 {.current = view(current),
                  .current_slope = view(current_slope),
                  .speed = view(speed),
                  .position = view(position),
                  .acceleration = view(acceleration)},
                 view(torque), view(voltage));
  return {.torque = torque, .voltage = voltage};
}

}  // namespace

void bind_unknown_inputs(py::module_& m) {
  py::class_<LeftOver>(m, "LeftOver", "Torque (n) and, where the current was given, voltage (n).")
      .def_readonly("torque", &LeftOver::torque)
      .def_readonly("voltage", &LeftOver::voltage);
  m.def("unknown_inputs", &left_over, "task"_a, "parameters"_a.noconvert(), "active"_a, py::kw_only(),
        "speed"_a.noconvert(), "position"_a.noconvert(), "acceleration"_a.noconvert(), "current"_a = Array(0),
        "current_slope"_a = Array(0),
        "What the equations leave over along a motion.");
}

}  // namespace rwn::bind
