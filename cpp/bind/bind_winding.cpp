#include "rwn/model/winding.hpp"

#include "bind.hpp"

namespace rwn::bind {

void bind_winding(py::module_& m) {
  using W = Winding<double>;
  py::class_<W>(m, "Winding", "A winding under a current [A], a speed [rad/s] and an input [V]: numbers or arrays.")
      .def(py::init([](double resistance, double inductance, double torque_constant, double back_emf_constant) {
             return W{.resistance = resistance,
                      .inductance = inductance,
                      .torque_constant = torque_constant,
                      .back_emf_constant = back_emf_constant};
           }),
           py::kw_only(), "resistance"_a, "inductance"_a, "torque_constant"_a, "back_emf_constant"_a)
      .def("torque", py::vectorize(&W::torque), "current"_a)
      .def("back_emf", py::vectorize(&W::back_emf), "speed"_a)
      .def("resting_voltage", py::vectorize(&W::resting_voltage), "current"_a)
      .def("resting_current", py::vectorize(&W::resting_current), "speed"_a, "input"_a)
      .def("heat", &W::heat, "square"_a)
      .def("braking_rate", &W::braking_rate, "inertia"_a);
}

}  // namespace rwn::bind
