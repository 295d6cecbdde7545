#include "tests/blind/blind_arms.h"

#include <glog/logging.h>

#include <cmath>
#include <cstdio>
#include <map>

#include "model/robot/robot.h"

namespace armcal {
namespace {

constexpr double kPi = 3.14159265358979323846;

// A DH row (standard; m, rad) and what its link and joint are like: kg, then
// N m s/rad and N m (N s/m and N), kg m^2 (kg), limits of position and speed.
struct Row {
  double a, d, alpha, mass, viscous, coulomb, armature, range, speed;
  bool slides = false;
};

struct Arm {
  std::vector<Row> rows;
  const char* gravity;
};

const std::map<std::string, Arm>& Arms() {
  static const std::map<std::string, Arm> kArms = {
      {"scara",
       {{{.4, 0, 0, 9, 2, 4, .8, 2.2, 4},
         {.3, 0, 0, 5, 1, 2, .3, 2.4, 5},
         {0, 0, 0, 1.5, 20, 8, 3, .12, .6, true},
         {0, -.1, 0, .6, .05, .1, .01, 3, 8}},
        "[0, 0, -9.81]"}},
      {"elbow",
       {{{0, .6, kPi / 2, 14, 6, 7, 1.5, 2.8, 2.5},
         {.5, 0, 0, 9, 6, 8, 1.5, 1.8, 2.5},
         {.4, 0, 0, 4, 2.5, 3, .5, 2.3, 3}},
        "[0, 0, -9.81]"}},
      {"puma",
       {{{0, 0, kPi / 2, 13, 4.9, 5.4, 1.14, 2.7, 2},
         {.4318, 0, 0, 17.4, 7.7, 9, 4.71, 1.7, 2},
         {.0203, .15005, -kPi / 2, 4.8, 3.3, 5.6, .83, 2.3, 2.4},
         {0, .4318, kPi / 2, .82, .41, .54, .2, 1.9, 3},
         {0, 0, -kPi / 2, .34, .32, .46, .18, 1.7, 3},
         {0, .06, 0, .25, .14, .25, .19, 3, 4}},
        "[0, 0, -9.81]"}},
      {"ur5",
       {{{0, .089159, kPi / 2, 3.7, 8, 7, 1.2, 3, 3},
         {-.425, 0, 0, 8.393, 9, 8, 1.2, 2.5, 3},
         {-.39225, 0, 0, 2.275, 6, 5, .7, 2.5, 3},
         {0, .10915, kPi / 2, 1.219, 1.2, 1.3, .15, 3, 3},
         {0, .09465, -kPi / 2, 1.219, 1.1, 1.2, .15, 3, 3},
         {0, .0823, 0, .1879, 1, 1, .15, 3, 3}},
        "[0, 0, -9.81]"}},
      {"panda",
       {{{0, .333, -kPi / 2, 4, 1.2, .5, .6, 2.8, 2.1},
         {0, 0, kPi / 2, 3.6, 1.5, .8, .6, 1.7, 2.1},
         {.0825, .316, kPi / 2, 3.2, 1, .5, .5, 2.8, 2.1},
         {-.0825, 0, -kPi / 2, 3.6, 1.4, .8, .5, 1.5, 2.1},
         {0, .384, kPi / 2, 1.6, .5, .4, .3, 2.8, 2.6},
         {.088, 0, kPi / 2, 1.7, .5, .3, .2, 1.8, 2.6},
         {0, .107, 0, .9, .4, .3, .2, 2.8, 2.6}},
        "[0, 0, -9.81]"}},
  };
  return kArms;
}

// The cylinder between the joints of a link, about its centre of mass and
// expressed in the link frame.
Eigen::Matrix3d CylinderInertia(double mass, const Eigen::Vector3d& axis) {
  constexpr double kRadius = .055;
  const double length = std::max(axis.norm(), .08);
  const Eigen::Vector3d e =
      axis.norm() > .02 ? axis.normalized() : Eigen::Vector3d::UnitZ();
  const double along = mass * kRadius * kRadius / 2;
  const double across = mass * (3 * kRadius * kRadius + length * length) / 12;
  return across * Eigen::Matrix3d::Identity() +
         (along - across) * e * e.transpose();
}

std::string Format(const char* format, const Eigen::VectorXd& x) {
  std::string text;
  char number[40];
  for (int k = 0; k < x.size(); ++k) {
    std::snprintf(number, sizeof number, format, x[k]);
    text += (k ? ", " : "") + std::string(number);
  }
  return "[" + text + "]";
}

std::string LinkYaml(const Row& row, std::mt19937_64* random) {
  std::normal_distribution<double> normal;
  const auto factor = [&](double spread) {
    return std::exp(spread * normal(*random));
  };
  const Eigen::Isometry3d X_ML(
      Eigen::Translation3d(row.a, 0, row.d) *
      Eigen::AngleAxisd(row.alpha, Eigen::Vector3d::UnitX()));
  const Eigen::Vector3d proximal = X_ML.inverse().translation();
  const double mass = row.mass * factor(.2);
  Eigen::Vector3d com = proximal / 2;
  for (int k = 0; k < 3; ++k) com[k] += .015 * normal(*random);
  const Eigen::Matrix3d I = CylinderInertia(mass, proximal);
  Eigen::VectorXd inertia(6);
  inertia << I(0, 0), I(0, 1), I(1, 1), I(0, 2), I(1, 2), I(2, 2);
  char head[400];
  std::snprintf(head, sizeof head,
                "  - {joint: %s, a: %.6g, d: %.6g, alpha: %.15g, mass: %.6g,\n"
                "     viscous: %.4g, coulomb: %.4g, armature: %.4g,\n"
                "     limits: {lower: %.4g, upper: %.4g, velocity: %.4g},\n",
                row.slides ? "prismatic" : "revolute", row.a, row.d, row.alpha,
                mass, row.viscous * factor(.3), row.coulomb * factor(.3),
                row.armature * factor(.3), -row.range, row.range, row.speed);
  return std::string(head) + "     com: " + Format("%.6g", com) +
         ", inertia: " + Format("%.8g", inertia) + "}\n";
}

}  // namespace

const std::vector<std::string>& BlindArmNames() {
  static const auto* const names = [] {
    auto* list = new std::vector<std::string>;
    for (const auto& [name, arm] : Arms()) list->push_back(name);
    return list;
  }();
  return *names;
}

std::string BlindArmYaml(const std::string& name, std::mt19937_64* random) {
  CHECK_EQ(Arms().count(name), 1u) << name;
  const Arm& arm = Arms().at(name);
  std::string text = "name: " + name + "\ngravity: " + arm.gravity +
                     "\nconvention: standard\nlinks:\n";
  for (const Row& row : arm.rows) text += LinkYaml(row, random);
  return text;
}

}  // namespace armcal
