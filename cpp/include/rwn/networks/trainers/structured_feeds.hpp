// Friction torque of a network and its derivatives, sample by sample: from the measured speed or from the simulated
// one. A new source of speed is a class here and a case of visit_feed.
#pragma once

#include "rwn/networks/trainers/structured_levenberg_marquardt.hpp"

namespace rwn {

/// Torque at one sample and its derivatives by the simulated speed and by w, m, d, c (4 N_w).
struct FrictionSample {
  double torque;
  double by_speed;
  const double* by_parameter;
};

/// Along the measured speed, all samples at once, by 3.16-3.18. With `gauge` the part along the speed is taken out.
class MeasuredFeed {
 public:
  MeasuredFeed(const StructuredNetwork& net, const VectorRef& speed, bool gauge);
  FrictionSample operator()(Eigen::Index n, double) const { return {value_[n], 0.0, derivative_.row(n).data()}; }
  double slope() const { return slope_; }                                  // that the gauge took out
  const Eigen::RowVectorXd& slope_by_parameter() const { return along_; }  // (4 N_w), 0 without gauge

 private:
  template <class W>
  void include(const W& kind, const StructuredNetwork& net, const VectorRef& speed, Eigen::Index j);
  void project(const VectorRef& speed);

  Vector value_;
  RowMatrix derivative_;
  Eigen::RowVectorXd along_;
  double slope_ = 0.0;
};

/// At the simulated speed; static network (c = 0). The gauge is torque(x) - slope x with the slope along `reference`.
class SimulatedFeed {
 public:
  SimulatedFeed(const StructuredNetwork& net, const VectorRef& reference, bool gauge);
  SimulatedFeed(const StructuredNetwork& net, double slope);
  FrictionSample operator()(Eigen::Index, double speed);
  double slope() const { return slope_; }

 private:
  const StructuredNetwork& net_;
  double slope_;
  Eigen::RowVectorXd along_, derivative_;
};

template <class Body>
void visit_feed(Feed feed, const StructuredNetwork& net, const VectorRef& speed, bool gauge, Body&& body) {
  if (feed == Feed::simulated) {
    SimulatedFeed simulated(net, speed, gauge);
    body(simulated);
  } else {
    MeasuredFeed measured(net, speed, gauge);
    body(measured);
  }
}

}  // namespace rwn
