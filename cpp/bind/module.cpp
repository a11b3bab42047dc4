// Table of contents of the extension module: one bind_<noun>.cpp per noun.
#include "bind.hpp"
#include "rwn/numerics/isa.hpp"

namespace rwn::bind {
void bind_own_effect(py::module_& m);
void bind_work(py::module_& m);
void bind_winding(py::module_& m);
void bind_task(py::module_& m);
void bind_unknown_inputs(py::module_& m);
void bind_normal_equations(py::module_& m);
void bind_simulate(py::module_& m);
void bind_wavelets(py::module_& m);
void bind_conventional_network(py::module_& m);
void bind_initialisation(py::module_& m);
void bind_trainers(py::module_& m);
void bind_recurrent_network(py::module_& m);
void bind_structured_network(py::module_& m);
void bind_rates(py::module_& m);
void bind_online_training(py::module_& m);
void bind_side_by_side(py::module_& m);
void bind_structured_trainers(py::module_& m);
}  // namespace rwn::bind

PYBIND11_MODULE(_core, m, pybind11::mod_gil_not_used()) {
  using namespace rwn::bind;
  m.doc() = "C++ core of rwn; use the classes of the rwn package, which check their input and explain themselves.";
  m.attr("__version__") = RWN_VERSION;
  m.def("isa", [] { return std::string(rwn::to_string(rwn::isa())); }, "Instruction set in use.");
  bind_own_effect(m);
  bind_work(m);
  bind_winding(m);
  bind_task(m);
  bind_unknown_inputs(m);
  bind_normal_equations(m);
  bind_simulate(m);
  bind_wavelets(m);
  bind_conventional_network(m);
  bind_initialisation(m);
  bind_trainers(m);
  bind_recurrent_network(m);
  bind_structured_network(m);
  bind_rates(m);
  bind_online_training(m);
  bind_side_by_side(m);
  bind_structured_trainers(m);
}
