#include "bind.hpp"
#include "defaults.hpp"
#include "rwn/networks/rates.hpp"

namespace rwn::bind {

void bind_rates(py::module_& m) {
  m.def("rate_rules", &rate_rules, "Name and guarantee of every learning-rate rule.");
  m.def("rate_defaults", [] {
    py::dict all;
    all["thesis"] = defaults_of<ThesisRates>(
        std::pair{"fraction", &ThesisRates::fraction}, std::pair{"shared", &ThesisRates::shared},
        std::pair{"misprint", &ThesisRates::misprint}, std::pair{"eigen", &ThesisRates::eigen});
    all["thesis"]["maxima"] = std::string(to_string(ThesisRates{}.maxima));
    all["tightened"] = defaults_of<TightenedRates>(std::pair{"fraction", &TightenedRates::fraction},
                                                   std::pair{"shared", &TightenedRates::shared},
                                                   std::pair{"eigen", &TightenedRates::eigen});
    all["tightened"]["maxima"] = std::string(to_string(TightenedRates{}.maxima));
    all["impulse-response"] = defaults_of<ImpulseResponseRates>(std::pair{"shared", &ImpulseResponseRates::shared});
    all["normalised"] = defaults_of<NormalisedRates>(std::pair{"fraction", &NormalisedRates::fraction},
                                                     std::pair{"regularisation", &NormalisedRates::regularisation});
    return all;
  });
  py::class_<FixedRates>(m, "FixedRates")
      .def(py::init([](std::vector<double> values) { return FixedRates{std::move(values)}; }), "values"_a);
  py::class_<ThesisRates>(m, "ThesisRates")
      .def(py::init([](double fraction, const std::string& maxima, bool shared, bool misprint, bool eigen) {
             return ThesisRates{fraction, maxima_by_name(maxima), shared, misprint, eigen};
           }),
           py::kw_only(), "fraction"_a, "maxima"_a, "shared"_a, "misprint"_a, "eigen"_a);
  py::class_<TightenedRates>(m, "TightenedRates")
      .def(py::init([](double fraction, const std::string& maxima, bool shared, bool eigen) {
             return TightenedRates{fraction, maxima_by_name(maxima), shared, eigen};
           }),
           py::kw_only(), "fraction"_a, "maxima"_a, "shared"_a, "eigen"_a);
  py::class_<ImpulseResponseRates>(m, "ImpulseResponseRates")
      .def(py::init([](double fraction, bool shared) { return ImpulseResponseRates{fraction, shared}; }), py::kw_only(),
           "fraction"_a, "shared"_a);
  py::class_<NormalisedRates>(m, "NormalisedRates")
      .def(py::init([](double fraction, double regularisation, std::vector<double> scales) {
             return NormalisedRates{fraction, regularisation, std::move(scales)};
           }),
           py::kw_only(), "fraction"_a, "regularisation"_a, "scales"_a);
  py::class_<RateReport>(m, "RateReport")
      .def_readonly("spectral_radius", &RateReport::spectral_radius)
      .def_readonly("condition", &RateReport::condition)
      .def_readonly("recurrence", &RateReport::recurrence)
      .def_readonly("smallest_dilation", &RateReport::smallest_dilation)
      .def_readonly("samples", &RateReport::samples)
      .def_readonly("unstable", &RateReport::unstable)
      .def_readonly("defective", &RateReport::defective)
      .def_readonly("recurrent", &RateReport::recurrent);
}

}  // namespace rwn::bind
