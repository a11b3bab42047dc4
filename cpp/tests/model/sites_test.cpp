// Where effects can attach: to each kind of drive what its equations have.
#include "rwn/model/sites.hpp"

#include <gtest/gtest.h>

#include "effect_index.hpp"

namespace rwn {
namespace {

constexpr int dc = 0, axis = 1, lti = 2;
static_assert(drive_names[dc] == "dc" && drive_names[axis] == "axis" && drive_names[lti] == "lti");

TEST(Sites, ADriveHasThoseOfItsEquations) {
  for (Site site : all_sites) {
    const bool outside = site == Site::actuator || site == Site::sensor;
    const bool electrical = site == Site::voltage || site == Site::flux;
    EXPECT_TRUE(has_site(dc, site));
    EXPECT_EQ(has_site(axis, site), !electrical);
    EXPECT_EQ(has_site(lti, site), outside);
  }
}

TEST(Sites, AnEffectHasTheOneThatItStates) {
  EXPECT_EQ(site_of(effect_index("coulomb-friction")), Site::torque);
  EXPECT_EQ(site_of(effect_index("constant-load")), Site::load);
  EXPECT_EQ(site_of(effect_index("supply-sag")), Site::voltage);
  EXPECT_EQ(site_of(effect_index("torque-ripple")), Site::flux);
  EXPECT_EQ(site_of(effect_index("input-delay")), Site::actuator);
  EXPECT_EQ(site_of(effect_index("sensor-bias")), Site::sensor);
}

TEST(Sites, AnOwnEffectHasThatOfItsTerm) {
  for (Term term : {Term::torque, Term::friction, Term::load}) EXPECT_EQ(site_of(term), Site::torque);
  for (Term term : {Term::drop, Term::resistance, Term::flux, Term::inductance}) {
    EXPECT_EQ(site_of(term), Site::voltage);
  }
  EXPECT_EQ(site_of(Term::input), Site::actuator);
  for (Term term : {Term::current, Term::speed, Term::position}) EXPECT_EQ(site_of(term), Site::sensor);
}

}  // namespace
}  // namespace rwn
