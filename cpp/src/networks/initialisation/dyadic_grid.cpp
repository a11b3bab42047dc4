#include "rwn/networks/initialisation/dyadic_grid.hpp"

#include <stdexcept>
#include <string>

namespace rwn {
namespace {

struct Interval {
  double a, b;
};

/// Mean of the data in the interval, its middle where there are none or where they sit on one end.
double centre_of_gravity(const Eigen::Ref<const Eigen::VectorXd, 0, Eigen::InnerStride<>>& x, Interval within) {
  double sum = 0.0;
  int count = 0;
  for (const double value : x) {
    if (value >= within.a && value <= within.b) {
      sum += value;
      ++count;
    }
  }
  const double mean = count > 0 ? sum / count : within.a;
  return mean > within.a && mean < within.b ? mean : 0.5 * (within.a + within.b);
}

}  // namespace

FinestScale finest_scale(int wavelets) {
  int nodes = 1;
  int held = 0;
  while (held + nodes <= wavelets) {
    held += nodes;
    nodes *= 2;
  }
  return {nodes, wavelets - held};
}

Shapes dyadic_grid(const RowMatrixRef& x, int wavelets, const std::vector<int>& finest) {
  const Domain domain(x);
  const FinestScale last = finest_scale(wavelets);
  if (static_cast<int>(finest.size()) != last.taken) {
    throw std::invalid_argument("a grid of " + std::to_string(wavelets) + " wavelets takes " +
                                std::to_string(last.taken) + " nodes of its last scale, got " +
                                std::to_string(finest.size()));
  }
  Shapes shapes{RowMatrix(wavelets, x.cols()), RowMatrix(wavelets, x.cols())};
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    std::vector<Interval> scale{{domain.low[i], domain.high[i]}};
    int row = 0;
    const auto place = [&](Interval interval) {
      const double p = centre_of_gravity(x.col(i), interval);
      shapes.m(row, i) = p;
      shapes.d(row, i) = 0.5 * (interval.b - interval.a);
      ++row;
      return p;
    };
    while (static_cast<int>(scale.size()) < last.nodes) {
      std::vector<Interval> next;
      for (const Interval interval : scale) {
        const double p = place(interval);
        next.push_back({interval.a, p});
        next.push_back({p, interval.b});
      }
      scale = std::move(next);
    }
    for (const int node : finest) {
      place(scale.at(static_cast<std::size_t>(node)));
    }
  }
  return shapes;
}

}  // namespace rwn
