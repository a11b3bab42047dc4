#include "bind.hpp"
#include "rwn/simulate/work.hpp"

namespace rwn::bind {

void bind_work(py::module_& m) {
  py::class_<Work>(m, "Work", "What simulations have cost, counted rather than timed: the same on every machine.")
      .def(py::init<>())
      .def("add", &Work::add, "units"_a)
      .def_property_readonly("done", &Work::done, "So far; one unit is about a nanosecond of a 4 GHz core.");
}

}  // namespace rwn::bind
