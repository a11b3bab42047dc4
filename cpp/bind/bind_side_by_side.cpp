#include "bind.hpp"
#include "rwn/networks/side_by_side.hpp"

namespace rwn::bind {
namespace {

template <class Say>
std::vector<std::string> said(const SideBySide& s, const Say& say) {
  std::vector<std::string> words;
  for (OnlineStatus one : s.status) words.emplace_back(say(one));
  return words;
}

}  // namespace

void bind_side_by_side(py::module_& m) {
  py::class_<SideBySide>(m, "SideBySide")
      .def_readonly("theta", &SideBySide::theta)
      .def_readonly("mse_learning", &SideBySide::mse_learning)
      .def_readonly("mse_frozen", &SideBySide::mse_frozen)
      .def_property_readonly("status",
                             [](const SideBySide& s) { return said(s, [](auto one) { return to_string(one); }); })
      .def_property_readonly("advice",
                             [](const SideBySide& s) { return said(s, [](auto one) { return advice(one); }); });
  m.def(
      "train_side_by_side",
      [](const Eigen::Ref<const RowMatrix>& theta, const Wavelet& wavelet, const Eigen::Ref<const RowMatrix>& rates,
         const VectorRef& input, const VectorRef& speed, const Eigen::Vector2d& start,
         int cycles) { return train_side_by_side(theta, wavelet, rates, {input, speed, start}, cycles); },
      "theta"_a.noconvert(), "wavelet"_a, "rates"_a.noconvert(), "input"_a.noconvert(), "speed"_a.noconvert(),
      "start"_a, py::kw_only(), "cycles"_a, py::call_guard<py::gil_scoped_release>());
}

}  // namespace rwn::bind
