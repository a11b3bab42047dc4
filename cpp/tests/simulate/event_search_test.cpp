// Instants within a step, and the series that goes there.
#include "rwn/simulate/event_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rwn {
namespace {

struct Tag {};
using Real = Dual<0, Tag>;
using Sloped = Dual<4, Tag>;

template <class G>
void expect_root(double at, double h, const G& g) {
  int calls = 0;
  const auto counted = [&](double t) {
    ++calls;
    return g(t);
  };
  EXPECT_NEAR(root(h, std::max(g(0.0), 0.0), g(h), counted), at, 1e-12 * h);
  EXPECT_LE(calls, 14);
}

TEST(EventSearch, FindsWhereAFunctionGoesThroughZero) {
  expect_root(0.3, 1.0, [](double t) { return 0.3 - t; });
  expect_root(0.7, 2.0, [](double t) { return 0.49 - t * t; });
  expect_root(1e-3 * std::log(2.0), 1e-3, [](double t) { return 2.0 * std::exp(-1e3 * t) - 1.0; });
  expect_root(0.5, 1.0, [](double t) { return t * (0.5 - t); });  // it starts at zero
}

TEST(EventSearch, FindsTheStartWhereAFunctionFallsFromThere) {
  EXPECT_EQ(root(1.0, 0.0, -1.0, [](double t) { return -t; }), 0.0);
}

/// A stiff pair beside a slow state, far from diagonal.
template <class S>
SmallMatrix<S, 3> system() {
  return {S(-5.0), S(300.0), S(0.0), S(-300.0), S(-40.0), S(2.0), S(0.1), S(1.0), S(0.0)};
}

TEST(Flow, IsTheExponentialOfItsSystem) {
  const double h = 0.05, norm = norm_of<Real, 3>(system<Real>());
  SmallMatrix<Real, 3> z = system<Real>();
  for (Real& entry : z) entry *= h;
  const auto phi = phi_functions<Real, 3>(z);
  const SmallVector<Real, 3> start{1.0, -2.0, 0.5};
  const Flow<Real, 3> force{{3.0, 4.0, -1.0}, {-2.0, 50.0, 7.0}, {30.0, -8.0, 9.0}};
  SmallVector<Real, 3> expected{}, way_expected{}, x = start, way{};
  const auto add = [&](SmallVector<Real, 3>& y, const SmallMatrix<Real, 3>& a, SmallVector<Real, 3> by, double factor) {
    for (Real& entry : by) entry *= factor;
    add_product<Real, 3>(y, a, by);
  };
  add(expected, phi.p0, start, 1.0);
  add(expected, phi.p1, force.constant, h);
  add(expected, phi.p2, force.linear, h);
  add(expected, phi.p3, force.quadratic, h);
  add(way_expected, phi.p1, start, h);
  add(way_expected, phi.p2, force.constant, h * h);
  add(way_expected, phi.p3, force.linear, h * h);
  flow<Real, 3>(system<Real>(), norm, h, force, x, way);
  for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(x[j].v, expected[j].v, 1e-11);

  SmallVector<Real, 3> y = start, linear_way{};  // the integral of a quadratic force would take one function more
  flow<Real, 3>(system<Real>(), norm, h, {force.constant, force.linear}, y, linear_way);
  for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(linear_way[j].v, way_expected[j].v, 1e-12);
}

TEST(Flow, CarriesSlopes) {
  const double h = 0.05, step = 1e-6;
  const auto after = [&](const Sloped& stiffness) {
    SmallMatrix<Sloped, 3> a = system<Sloped>();
    a[1] = stiffness;
    SmallVector<Sloped, 3> x{1.0, -2.0, 0.5}, way{};
    flow<Sloped, 3>(a, norm_of<Sloped, 3>(a), h, {{3.0, 4.0, -1.0}}, x, way);
    return x[0];
  };
  const double difference = (after(300.0 + step).v - after(300.0 - step).v) / (2.0 * step);
  EXPECT_NEAR(after(Sloped::variable(300.0, 2)).d[2], difference, 1e-6 * std::abs(difference));
}

}  // namespace
}  // namespace rwn
