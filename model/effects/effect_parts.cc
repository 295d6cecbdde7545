#include "model/effects/effect_parts.h"

#include <algorithm>
#include <cmath>

#include "model/dynamics/forward_dynamics.h"
#include "model/dynamics/motor_map.h"
#include "model/robot/kinematics.h"

namespace armcal {
inline namespace effects {

// A joint that does nothing has the scale of a very small one.
double TorqueScale(const EffectSite& site) {
  return std::max(site.scale->torque[site.joint], 1e-3);
}

double SpeedScale(const EffectSite& site) {
  return std::max(site.scale->speed[site.joint], .01 * Radian(site));
}

double AccelerationScale(const EffectSite& site) {
  return std::max(site.scale->acceleration[site.joint], .01 * Radian(site));
}

double Radian(const EffectSite& site) {
  return IsRotational(site.at().type) ? 1 : .3;
}

double CarriedInertia(const EffectSite& site) {
  const Eigen::VectorXd q = (site.scale->low + site.scale->high) / 2;
  return LinkInertias(*site.robot, q)[site.joint];
}

Eigen::Matrix3d PointInertia(double mass, const Eigen::Vector3d& h) {
  constexpr double kLongest = 1;  // m
  if (mass == 0 || h.isZero(0)) return Eigen::Matrix3d::Zero();
  const double divisor =
      std::copysign(std::max(std::abs(mass), h.norm() / kLongest), mass);
  return (h.squaredNorm() * Eigen::Matrix3d::Identity() - h * h.transpose()) /
         divisor;
}

double MovingMass(const Robot& robot) {
  double mass = 0;
  for (const Link& link : robot.links) mass += link.inertial.mass;
  return mass;
}

bool IsOfAnArm(const Robot& robot, double mass) {
  constexpr double kMost = 3;
  const double moving = MovingMass(robot);
  return !(moving > 0 && (mass > kMost * moving || mass < -moving));
}

double Duration(const EffectSite& site) {
  return std::max(site.scale->end - site.scale->begin, 1e-3);
}

SiteSize ShareOfTorque(double share) {
  return [share](const EffectSite& site) { return share * TorqueScale(site); };
}

SiteSize ShareOfDrag(double share) {
  return [share](const EffectSite& site) {
    return share * TorqueScale(site) / SpeedScale(site);
  };
}

std::vector<double> GeometricGrid(double low, double high, int count) {
  std::vector<double> grid;
  for (int k = 0; k < count; ++k) {
    grid.push_back(low * std::pow(high / low, k / (count - 1.)));
  }
  return grid;
}

EffectParameter Linear(const std::string& name, const std::string& unit,
                       SiteSize size, EffectParameter::Sign sign) {
  return {name, unit, EffectParameter::Search::kLinear, sign, std::move(size),
          {}};
}

EffectParameter Gridded(const std::string& name, const std::string& unit,
                        SiteGrid grid) {
  const SiteSize size = [grid](const EffectSite& site) {
    const std::vector<double> values = grid(site);
    return values[values.size() / 2];
  };
  return {name,
          unit,
          EffectParameter::Search::kGrid,
          EffectParameter::Sign::kFree,
          size,
          std::move(grid)};
}

EffectParameter Refined(const std::string& name, const std::string& unit,
                        std::vector<double> grid) {
  const double usual = grid[1];
  return {name,
          unit,
          EffectParameter::Search::kRefined,
          EffectParameter::Sign::kFree,
          [usual](const EffectSite&) { return usual; },
          [grid](const EffectSite&) { return grid; }};
}

EffectParameter Searched(const std::string& name, const std::string& unit,
                         EffectParameter::Search search, SiteSize size) {
  return {name, unit, search, EffectParameter::Sign::kPositive, std::move(size),
          {}};
}

std::vector<int> Neighbours(const EffectSite& site) {
  std::vector<int> any, alike;
  for (const int k :
       {site.robot->parent(site.joint), site.robot->next(site.joint)}) {
    if (k < 0) continue;
    any.push_back(k);
    const JointType type = site.robot->links[k].joint.type;
    if (IsRotational(type) == IsRotational(site.at().type)) alike.push_back(k);
  }
  return alike.empty() ? any : alike;
}

EffectParameter NeighbourParameter() {
  return Gridded("neighbour", "1", [](const EffectSite& site) {
    std::vector<double> numbers;
    for (const int k : Neighbours(site)) numbers.push_back(k + 1);
    return numbers;
  });
}

std::string WhyNoNeighbour(const EffectSite& site) {
  return Neighbours(site).empty() ? "the robot has one joint" : "";
}

std::string WhyNotRecorded(const EffectSite& site) {
  const Eigen::VectorXd& tops = site.scale->top_torque;
  const bool is_zero = tops.size() > 0 && tops[site.joint] == 0;
  return is_zero ? "the joint's torque is recorded as zero throughout" : "";
}

bool CarriesPayload(const Robot& robot) {
  constexpr double kStep = .7;      // rad or m
  constexpr double kOnAxis = 1e-9;  // m
  const int n = robot.num_joints();
  if (n == 1) return true;
  const Eigen::VectorXd bent = Eigen::VectorXd::Constant(n, kStep);
  const Eigen::Vector3d at = ToolPose(robot, bent).translation();
  for (int j = 0; j < n; ++j) {
    const Eigen::VectorXd q = bent + kStep * Eigen::VectorXd::Unit(n, j);
    const Eigen::Vector3d moved = ToolPose(robot, q).translation();
    if ((moved - at).norm() > kOnAxis) return true;
  }
  return false;
}

std::string WhyNotCarried(const EffectSite& site) {
  bool moves = false;
  for (int k = site.joint; k >= 0; k = site.robot->parent(k)) {
    moves |= site.scale->speed[k] > 0;
  }
  return moves ? "" : "neither the joint nor one before it moves";
}

void AddFriction(const EffectSite& site, const InstantTorque& torque,
                 SimulatedRobot* robot) {
  robot->joint_laws.push_back({site.joint,
                               {},
                               true,
                               [torque](const ArmInstant& at, const double*,
                                        double*) { return torque(at); }});
}

void AddTorque(const EffectSite& site, const InstantTorque& torque,
               SimulatedRobot* robot) {
  AddFriction(site, torque, robot);
  robot->joint_laws.back().heats = false;
}

void AddActuator(const EffectSite& site,
                 const std::function<double(double commanded)>& given,
                 const std::function<double(double given)>& commanded,
                 SimulatedRobot* robot) {
  robot->actuators.push_back(
      {{},
       MotorMap{site.joint, [given](double x, double) { return given(x); },
                commanded}});
}

void AddGain(const EffectSite& site, double gain, SimulatedRobot* robot) {
  AddActuator(
      site, [=](double commanded) { return commanded / (1 + gain); },
      [=](double given) { return (1 + gain) * given; }, robot);
}

// A motor that gives ten times what is recorded or more, or the opposite, or a
// third of it, has another fault than its constant.
bool IsOfAMotorConstant(const EffectSite&,
                        const std::vector<EffectEstimate>& estimates) {
  return estimates[0].value > -.9 && estimates[0].value < 2;
}

double SoftPlus(double x) {
  constexpr double kFar = 25;  // where what is rounded is 1e-11
  if (std::abs(x) > kFar) return x > 0 ? x : 0;
  return std::log1p(std::exp(x));
}

double Amplitude(double a, double b) { return std::hypot(a, b); }
double Phase(double a, double b) { return std::atan2(b, a); }

std::string UnitAt(const EffectSite& site, const std::string& unit) {
  return ParameterUnit(unit, site.at().type);
}

}  // namespace effects
}  // namespace armcal
