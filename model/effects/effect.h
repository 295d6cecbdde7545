#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "model/dynamics/simulated_robot.h"
#include "model/robot/robot.h"

namespace armcal {
// Inline, because the truth of blind tests (model/plant/hidden/) has classes of
// the same names: linked into one program as one name they would be one class.
inline namespace effects {

// What the joints do on a log: what sizes, ranges and grids of effects are
// relative to. One entry per joint.
struct MotionScale {
  Eigen::VectorXd torque;        // rms, N m or N
  Eigen::VectorXd load;          // rms of what moves the links, N m or N
  Eigen::VectorXd speed;         // rms while moving, rad/s or m/s
  Eigen::VectorXd top_speed;     // rad/s or m/s
  Eigen::VectorXd acceleration;  // rms, rad/s^2 or m/s^2
  Eigen::VectorXd low, high;     // positions, rad or m
  // As recorded, its largest, N m or N; empty: not known.
  Eigen::VectorXd top_torque;
  // The speed within which the joint's Coulomb friction changes sign, rad/s or
  // m/s: tanh(qd / width).
  Eigen::VectorXd width;
  // As recorded temperatures say; empty: not recorded.
  std::vector<JointThermal> thermal;
  double begin = 0, end = 0;  // s
};

// Where an effect acts, on which robot and in which motion.
struct EffectSite {
  const Robot* robot;  // without the effect
  int joint;           // from 0; -1: the whole robot
  const MotionScale* scale;

  const Joint& at() const { return robot->links[joint].joint; }
};

struct EffectParameter {
  // How a diagnosis finds it. Torque is linear in kLinear parameters, and the
  // effect is absent where all of them are 0; the others only shape it.
  enum class Search {
    kLinear,
    kGrid,               // tried at the values of `grid`, then refined
    kRefined,            // the same; the ends of `grid` are its range only
    kPositionFrequency,  // from the residual's spectrum over position, rad/rad
    kTimeFrequency,      // from its spectrum over time, Hz
    kTime,               // from where in time the residual is large, s
    kDuration            // s
  };
  enum class Sign { kFree, kPositive };

  std::string name;  // as in diagnosis.json: "stribeck_velocity"
  std::string unit;  // with E for the joint's effort (N m or N), P for its
                     // position (rad or m): "E s/P"
  Search search = Search::kLinear;
  Sign sign = Sign::kFree;
  // kLinear: a size that would matter, of the order of 5 % of what the joint
  // does; columns are differences over this much. Others: a usual value.
  std::function<double(const EffectSite&)> size;
  // Rising values. kGrid: to try; the first and last are the range.
  // kRefined: the range's ends, and between them those to try.
  std::function<std::vector<double>(const EffectSite&)> grid;
};

struct EffectEstimate {
  std::string name;
  std::string unit;
  double value;
};

// A law that rigid bodies with viscous and Coulomb friction lack. One
// description serves estimation (recorded_torque.h makes its columns from
// `apply`), forward simulation and export.
struct Effect {
  enum class Scope { kJoint, kRobot };

  std::string name;  // as in diagnosis.json and docs/effects
  Scope scope = Scope::kJoint;
  std::string law;    // in symbols, a line
  std::string shows;  // which motion makes it visible, a phrase
  std::vector<EffectParameter> parameters;
  // Fills slots of *robot, whose `robot` member is the site's; p has an entry
  // per parameter, SI units.
  std::function<void(const EffectSite& site, const Eigen::VectorXd& p,
                     SimulatedRobot* robot)>
      apply;
  // What a report says, as functions of p (amplitude and phase of a sine and a
  // cosine): empty for the parameters themselves.
  std::function<std::vector<EffectEstimate>(const EffectSite& site,
                                            const Eigen::VectorXd& p)>
      estimates;
  // Empty, or why this joint of this robot cannot show it at all.
  std::function<std::string(const EffectSite& site)> unfit;
  // Whether it acts where friction passes zero velocity (or torque zero), which
  // no model has quite right: it has to explain the more.
  bool near_zero = false;
  // Multiples of its linear parameters' sizes that are tried as well, where
  // torques are far from being in proportion to them.
  std::vector<double> larger_sizes;
  // Effects that a model without this law would show in its stead, as its mean:
  // beside it on the same joint they are a part of it.
  std::vector<std::string> means;
  // How it is made visible: the experiment a report proposes.
  std::string experiment;
};

// Whether `mean` is one of the law's `means`.
bool HasMean(const Effect& law, const Effect& mean);
// "N m s/rad" from "E s/P" for a revolute joint.
std::string ParameterUnit(const std::string& unit, JointType type);
// What the effect says of itself at p.
std::vector<EffectEstimate> EstimatesOf(const Effect& effect,
                                        const EffectSite& site,
                                        const Eigen::VectorXd& p);

}  // namespace effects
}  // namespace armcal
