// The hidden laws are not those of estimation, or tests would only show that
// the same law fits itself (an "inverse crime"): the best fit of each textbook
// form leaves a misfit. Nor are they something else: the form explains most of
// them.
#include <gtest/gtest.h>

#include "tests/model/plant/hidden/form_misfit.h"
#include "tests/model/plant/hidden/hidden_plant.h"

namespace armcal::forms_long_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(HiddenForms, VelocityFriction) {
  const VectorXd v = VectorXd::LinSpaced(601, -1.5, 1.5);
  const auto law = [&v](const std::string& name, std::vector<double> p,
                        double scale = 1) {
    HiddenPlant plant(name, 0, p);
    return Along(v, [&](double x) { return plant.TorqueAt(scale * x); });
  };
  const auto tanh_at = [&v](double w) -> VectorXd {
    return (v / w).array().tanh();
  };
  // Through zero velocity: within 75 mrad/s, any width.
  ExpectAnotherForm(Misfit(law("coulomb_friction", {.1}, .05), Grid(.02, 1),
                           [&](double w) { return Columns({tanh_at(w)}); }),
                    .01, .1, "coulomb");
  ExpectAnotherForm(Misfit(law("viscous_friction", {.1}, 2), {1},
                           [&](double) { return Columns({v}); }),
                    .002, .1, "viscous");
  ExpectAnotherForm(Misfit(law("asymmetric_friction", {.1}), {1},
                           [&](double) {
                             return Columns({v, v.cwiseAbs()});
                           }),
                    .002, .1, "asymmetric");
  ExpectAnotherForm(
      Misfit(law("quadratic_friction", {.1}), {1},
             [&](double) { return Columns({v.cwiseProduct(v.cwiseAbs())}); }),
      .02, .3, "quadratic");
  ExpectAnotherForm(
      Misfit(law("stribeck", {.1, .2}), Grid(.05, 1),
             [&](double vs) {
               return Columns({((v / vs).array().square() * -1).exp() *
                               tanh_at(.005).array()});
             }),
      .05, .5, "stribeck");
}

TEST(HiddenForms, ConditionalFriction) {
  const VectorXd x = VectorXd::LinSpaced(601, -3, 3);
  HiddenPlant load("load_friction", 0, {.1});
  ExpectAnotherForm(
      Misfit(Along(x,
                   [&](double u) {
                     load.at.load[0] = 7 * u;
                     return load.TorqueAt(1);
                   }),
             {1}, [&](double) { return Columns({x.cwiseAbs()}); }),
      .02, .3, "load");
  HiddenPlant place("position_friction", 0, {.1, 2, .4});
  ExpectAnotherForm(
      Misfit(Along(x,
                   [&](double q) {
                     place.at.position[0] = q;
                     return place.TorqueAt(1);
                   }),
             {2},
             [&](double n) {
               return Columns({VectorXd::Ones(601), (n * x).array().cos(),
                               (n * x).array().sin()});
             }),
      .02, .5, "position");
}

TEST(HiddenForms, ThermalFriction) {
  HiddenPlant warm;
  warm.robot.robot.links[0].joint.viscous = 2;
  warm.Add("thermal_friction", 0, {.04, 20, 1});
  const VectorXd dT = VectorXd::LinSpaced(100, 0, 20);
  const VectorXd torque = Along(dT, [&](double T) {
    warm.at.temperature[0] = T;
    return warm.TorqueAt(1);
  });
  // Reynolds' law takes of all the viscous friction, no more and no less.
  double misfit = 1;
  for (const double beta : Grid(.01, .1)) {
    const VectorXd reynolds = 2 * (1 - (-beta * dT).array().exp());
    misfit = std::min(misfit, (torque - reynolds).norm() / torque.norm());
  }
  ExpectAnotherForm(misfit, .02, .3, "thermal");
}

// From rest: neither Prandtl's clip nor Dahl's exponential.
TEST(HiddenForms, Presliding) {
  HiddenPlant plant("presliding", 0, {.1, .01});
  const int n = 1000;
  const double step = .05 / n;
  VectorXd x(n), y(n);
  double state = 0, rate = 0;
  plant.at.velocity[0] = .05;
  for (int k = 0; k < n; ++k) {
    x[k] = k * step;
    y[k] = plant.Torque(0, &state, &rate);
    state += rate * step / .05;
  }
  ExpectAnotherForm(
      Misfit(y, Grid(.001, .1),
             [&](double z) { return Columns({(x / z).cwiseMin(1)}); }),
      .02, .2, "Prandtl");
  ExpectAnotherForm(
      Misfit(y, Grid(.001, .1),
             [&](double z) { return Columns({1 - (-x / z).array().exp()}); }),
      .01, .2, "Dahl");
}

}  // namespace armcal::forms_long_test
