#include "bind.hpp"
#include "rwn/networks/online_training.hpp"
#include "rwn/networks/rates.hpp"

namespace rwn::bind {
namespace {

template <class Network, class Mask>
auto rates_for(const RateRule& rule, const Network& network, const Mask& learn) {
  return std::visit([&](const auto& r) { return r.on(network, learn); }, rule);
}

}  // namespace

void bind_online_training(py::module_& m) {
  const auto release = py::call_guard<py::gil_scoped_release>();
  py::class_<OnlineHistory>(m, "OnlineHistory")
      .def_property_readonly("status", [](const OnlineHistory& h) { return std::string(to_string(h.status)); })
      .def_property_readonly("advice", [](const OnlineHistory& h) { return std::string(advice(h.status)); })
      .def_readonly("mse_learning", &OnlineHistory::mse_learning)
      .def_readonly("mse_frozen", &OnlineHistory::mse_frozen)
      .def_readonly("frozen_after", &OnlineHistory::frozen_after)
      .def_readonly("parameters", &OnlineHistory::parameters)
      .def_readonly("rates", &OnlineHistory::rates)
      .def_readonly("bounds", &OnlineHistory::bounds)
      .def_readonly("report", &OnlineHistory::report);

  m.def(
      "train_structured",
      [](const StructuredNetwork& network, const VectorRef& input, const VectorRef& speed, const Eigen::Vector2d& start,
         const RateRule& rule, const StructuredMask& learn, int cycles, int frozen_every, bool follow_state) {
        const auto rates = rates_for(rule, network, learn);
        StructuredTraining t =
            train(network, {input, speed, start}, *rates, learn, {cycles, frozen_every, follow_state});
        return std::make_pair(Vector(t.network.theta()), std::move(t.history));
      },
      "network"_a, "input"_a.noconvert(), "speed"_a.noconvert(), "start"_a, py::kw_only(), "rates"_a, "learn"_a,
      "cycles"_a, "frozen_every"_a, "follow_state"_a, release);
  m.def(
      "train_recurrent",
      [](const RecurrentNetwork& network, const Eigen::Ref<const RowMatrix>& x, const VectorRef& y,
         const RateRule& rule, const RecurrentMask& learn, int cycles, int frozen_every) {
        const auto rates = rates_for(rule, network, learn);
        RecurrentTraining t = train(network, {x, y}, *rates, {cycles, frozen_every, false});
        return std::make_pair(Vector(t.network.theta()), std::move(t.history));
      },
      "network"_a, "x"_a.noconvert(), "y"_a.noconvert(), py::kw_only(), "rates"_a, "learn"_a, "cycles"_a,
      "frozen_every"_a, release);
}

}  // namespace rwn::bind
