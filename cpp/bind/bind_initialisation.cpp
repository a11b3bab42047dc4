#include "bind.hpp"
#include "rwn/networks/initialisation.hpp"

namespace rwn::bind {
namespace {

std::pair<RowMatrix, RowMatrix> pair(const Shapes& shapes) { return {shapes.m, shapes.d}; }

}  // namespace

void bind_initialisation(py::module_& m) {
  m.def(
      "heuristic", [](const RowMatrixRef& x, int wavelets) { return pair(heuristic(x, wavelets)); }, "x"_a.noconvert(),
      "wavelets"_a);
  m.def(
      "finest_scale",
      [](int wavelets) { return std::pair(finest_scale(wavelets).nodes, finest_scale(wavelets).taken); }, "wavelets"_a);
  m.def("dyadic_grid",
        [](const RowMatrixRef& x, int wavelets, const std::vector<int>& finest) {
          return pair(dyadic_grid(x, wavelets, finest));
        },
        "x"_a.noconvert(), "wavelets"_a, "finest"_a);
  m.def("least_squares", &least_squares, "x"_a.noconvert(), "y"_a.noconvert());
  m.def(
      "wavelet_library",
      [](const RowMatrixRef& x, int levels, double zeta) { return pair(wavelet_library(x, levels, zeta)); },
      "x"_a.noconvert(), "levels"_a, "zeta"_a);
  m.def(
      "select_wavelets",
      [](const Wavelet& wavelet, const RowMatrixRef& translations, const RowMatrixRef& dilations, const RowMatrixRef& x,
         const RowMatrixRef& y,
         int wavelets) { return select_wavelets(wavelet, {translations, dilations}, x, y, wavelets); },
      "wavelet"_a, "m"_a.noconvert(), "d"_a.noconvert(), "x"_a.noconvert(), "y"_a.noconvert(), "wavelets"_a,
      py::call_guard<py::gil_scoped_release>());
}

}  // namespace rwn::bind
