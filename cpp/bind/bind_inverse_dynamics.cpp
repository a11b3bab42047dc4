#include "bind.hpp"
#include "rwn/inverse_dynamics.hpp"

namespace rwn::bind {

void bind_inverse_dynamics(py::module_& m) {
  m.def(
      "inverse_dynamics",
      [](const Array& parameters, const std::vector<int>& active, double angle_per_position, const Array& time,
         const Array& position, const Array& speed, const Array& acceleration, const std::vector<OwnEffect>& own) {
        Array torque(time.size());
        inverse_dynamics(view(parameters), active, angle_per_position, view(time), view(position), view(speed),
                         view(acceleration), view(torque), own);
        return torque;
      },
      "parameters"_a.noconvert(), "active"_a, "angle_per_position"_a, "time"_a.noconvert(), "position"_a.noconvert(),
      "speed"_a.noconvert(), "acceleration"_a.noconvert(), "own"_a = std::vector<OwnEffect>{},
      "Driving torque (n) that the model needs for a motion.");
}

}  // namespace rwn::bind
