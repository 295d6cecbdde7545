// The hidden laws are not those of estimation, "inverse crime" of GAP.md: the
// best fit of each textbook form leaves a misfit. Nor are they something else:
// the form explains most of them.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/hidden_plant.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Share of y that no combination of the columns explains, for the best of the
// nonlinear parameters.
double Misfit(const VectorXd& y, const std::vector<double>& nonlinear,
              const std::function<MatrixXd(double)>& columns) {
  double best = 1;
  for (const double w : nonlinear) {
    const MatrixXd A = columns(w);
    const VectorXd x = A.colPivHouseholderQr().solve(y);
    best = std::min(best, (y - A * x).norm() / y.norm());
  }
  return best;
}

std::vector<double> Grid(double low, double high) {
  std::vector<double> grid;
  for (int k = 0; k <= 200; ++k) {
    grid.push_back(low * std::pow(high / low, k / 200.));
  }
  return grid;
}

MatrixXd Columns(const std::vector<VectorXd>& columns) {
  MatrixXd A(columns[0].size(), columns.size());
  for (size_t k = 0; k < columns.size(); ++k) A.col(k) = columns[k];
  return A;
}

void ExpectAnotherForm(double misfit, double least, double most,
                       const char* name) {
  EXPECT_GT(misfit, least) << name;
  EXPECT_LT(misfit, most) << name;
}

VectorXd Along(const VectorXd& x, const std::function<double(double)>& f) {
  return x.unaryExpr(f);
}

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
  HiddenPlant warm;
  warm.robot.robot.links[0].joint.viscous = 2;
  warm.Add("thermal_friction", 0, {.04, 20, 1});
  const VectorXd dT = VectorXd::LinSpaced(100, 0, 20);
  ExpectAnotherForm(Misfit(Along(dT,
                                 [&](double T) {
                                   warm.at.temperature[0] = T;
                                   return warm.TorqueAt(1);
                                 }),
                           {1}, [&](double) { return Columns({dT}); }),
                    .02, .3, "thermal");
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

TEST(HiddenForms, PositionAndTime) {
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

TEST(HiddenForms, Drives) {
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
      Misfit(lost({"torque_saturation", 1, {1.5}}), Grid(8, 20),
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

}  // namespace
}  // namespace armcal
