// As forms_long_test.cc, for torques of position and time, contacts,
// drives and gears.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/model/plant/hidden/form_misfit.h"
#include "tests/model/plant/hidden/hidden_plant.h"

namespace armcal::drive_forms_long_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(HiddenDriveForms, PositionAndTime) {
  const VectorXd q = VectorXd::LinSpaced(801, -1.2, 1.2);
  const VectorXd one = VectorXd::Ones(801);
  const auto along = [&q](HiddenPlant plant) {
    return Along(q, [&](double x) {
      plant.at.position[0] = x;
      plant.at.t = 20 * (x + 1.2);
      return plant.Torque();
    });
  };
  ExpectAnotherForm(Misfit(along({"spring", 0, {.1, .2}}), {1},
                           [&](double) {
                             return Columns({q, one});
                           }),
                    .005, .1, "spring");
  ExpectAnotherForm(
      Misfit(along({"cable", 0, {.1, .1, .2}}), Grid(.05, 2),
             [&](double b) {
               return Columns({((q.array() - .1) / b).tanh(), one});
             }),
      .01, .2, "cable");
  ExpectAnotherForm(
      Misfit(along({"torque_ripple", 0, {.1, 20, 1}}), {20},
             [&](double n) {
               return Columns({(n * q).array().sin(), (n * q).array().cos()});
             }),
      .05, .3, "ripple");
  ExpectAnotherForm(Misfit(along({"time_drift", 0, {.1}}), {1},
                           [&](double) {
                             return Columns({q, one});
                           }),
                    .02, .3, "drift");
}

TEST(HiddenDriveForms, Contact) {
  const VectorXd q = VectorXd::LinSpaced(801, -1.2, 1.2);
  HiddenPlant push("external_contact", -1, {.05, .5, .4});
  const VectorXd force = Along(q, [&](double t) {
    PointInstant at;
    at.t = 20 + 2 * t;
    return push.robot.wrenches[0].wrench(at, nullptr, nullptr).force.x();
  });
  ExpectAnotherForm(
      Misfit(force, Grid(.1, 2),
             [&](double b) {
               return Columns({(q.array().abs() < b)
                                   .select((M_PI / 2 * q / b).array().cos(),
                                           0. * q.array())});
             }),
      .02, .3, "contact");
}

TEST(HiddenDriveForms, Drives) {
  const VectorXd tau = VectorXd::LinSpaced(801, -25, 25);
  const auto lost = [&tau](const HiddenPlant& plant) {
    return Along(tau, [&](double u) {
      return u - plant.Given(VectorXd::Constant(6, u))[1];
    });
  };
  ExpectAnotherForm(
      Misfit(lost({"torque_nonlinearity", 1, {.1}}), {1},
             [&](double) { return Columns({tau.array().cube()}); }),
      .05, .5, "nonlinearity");
  ExpectAnotherForm(
      Misfit(lost({"torque_saturation", 1, {1.5, 0}}), Grid(8, 20),
             [&](double limit) {
               return Columns({tau - tau.cwiseMin(limit).cwiseMax(-limit)});
             }),
      .01, .3, "saturation");
  ExpectAnotherForm(
      Misfit(lost({"torque_deadband", 1, {.1}}), Grid(.1, 10),
             [&](double d) { return Columns({(tau / d).array().tanh()}); }),
      .005, .1, "deadband");
  const VectorXd d = VectorXd::LinSpaced(801, -.006, .006);
  const HiddenPlant gear("elasticity", 0, {.002, .05});
  ExpectAnotherForm(
      Misfit(Along(d, [&](double x) { return gear.Transmitted(x, 0); }), {1},
             [&](double) { return Columns({d}); }),
      .02, .3, "elasticity");
}

}  // namespace armcal::drive_forms_long_test
