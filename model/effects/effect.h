#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/dynamics/joint_term.h"
#include "model/dynamics/simulated_robot.h"
#include "model/effects/effect_site.h"
#include "model/robot/joint_drive.h"

namespace armcal {
inline namespace effects {

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
  // kAsFirst: that of the effect's first parameter, as a body's inertia has the
  // sign of its mass, also where it was taken off.
  enum class Sign { kFree, kPositive, kAsFirst };

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

// Numbers with their names, in a law's own order.
using EffectNumbers = std::vector<std::pair<std::string, double>>;

// A law that rigid bodies with viscous and Coulomb friction lack. One
// description serves estimation (recorded_torque.h makes its columns from
// `apply`), forward simulation and export.
struct Effect {
  enum class Scope { kJoint, kRobot };
  // What it is a change of, and so in which other logs it is found again.
  enum class Nature {
    kParameter,  // of a number that any rigid-body model has (mass, length,
                 // joint friction), which is fitted anyway: in all logs
    kLaw,        // of the robot, by a term that such a model lacks: in all logs
    kRecording,  // of one log: its clock, its signals' zeros and scales
    kDay,        // of one day: load, temperature, mounting, surroundings
    kEvent       // of a span of time within a log
  };

  std::string name;  // as in diagnosis.json and docs/effects
  Scope scope = Scope::kJoint;
  Nature nature = Nature::kLaw;
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
  // All numbers that its law has at p, those of the site included: what modules
  // for other simulators (calib/diagnose/modules/assets) are given, which know
  // the law by the effect's name. Empty: they do not hold it.
  std::function<EffectNumbers(const EffectSite& site, const Eigen::VectorXd& p)>
      numbers;
  // Empty, or why this joint of this robot cannot show it at all.
  std::function<std::string(const EffectSite& site)> unfit;
  // Whether it acts where friction passes zero velocity (or torque zero), which
  // no model has quite right: it has to explain the more.
  bool near_zero = false;
  // Multiples of its linear parameters' sizes that are tried as well, where
  // torques are far from being in proportion to them; negative ones where a
  // parameter's sign is free.
  std::vector<double> larger_sizes;
  // Whether torque is in proportion to the linear parameters at all sizes. If
  // not (a spring that yields, a limit), a model of a reference log, which is
  // linear in them, cannot have it.
  bool proportional = true;
  // Effects that a model without this law would show in its stead, as its mean:
  // beside it on the same joint they are a part of it.
  std::vector<std::string> means;
  // The terms of its joint that stand for it in robot files without such a law:
  // those of them that fit its torque along the log best, by least squares.
  std::vector<JointTerm> stand_ins;
  // The joint's own term (N m s/rad, N m or kg m^2 as JointTermUnit says) that
  // its only parameter adds to: a number of robot files. None: no such term.
  std::optional<JointTerm> joint_term;
  // Adds what robot files with drives have for its `numbers`, if they do.
  std::function<bool(const EffectNumbers& numbers, JointDrive* drive)>
      set_drive;
  // Whether the estimates can be of a real arm like this; empty: always. Those
  // that cannot are not reported.
  std::function<bool(const EffectSite& site,
                     const std::vector<EffectEstimate>& estimates)>
      plausible;
  // Whether it is a push of the surroundings on the arm: what the search for
  // contacts finds is reported as this effect. Exactly one is.
  bool is_contact = false;
  // Whether it is a number of the arm's construction (a length, a link's or a
  // rotor's inertia): a file may have it wrong, but it is the same in all logs
  // of one arm unless somebody rebuilt it.
  bool of_construction = false;
  // Whether 1 + its first estimate is a factor of recorded torque, or of a part
  // of it: known no better than the torque's scale is.
  bool estimates_a_factor = false;
  // What a clock that runs at another rate than time is reported as. Exactly
  // one is.
  bool is_clock = false;
  // Of all joints: what else it may be where they disagree about its size, a
  // phrase; empty: nothing is known that looks so.
  std::string if_joints_disagree;
  // Of all joints: the effect that looks so where each joint has it.
  std::string if_of_each_joint;
  // Where the sign of its first estimate, which may have either, does not speak
  // for itself: what it says where positive and where negative, clauses that
  // " by 3 mm" goes on with. Empty: the estimate is told with its sign.
  std::string if_positive, if_negative;
  // Whether it is of what a drive makes of its command, or of how its torque is
  // recorded: on a joint that swings freely hardly any of it shows.
  bool of_the_drive = false;
  // Of all joints: whether it moves the time at which friction changes sign, as
  // each joint's own friction may by itself.
  bool moves_reversals = false;
  // How it is made visible: the experiment a report proposes.
  std::string experiment;
};

// Whether it is a body that moves with the arm: its inertia has the sign of its
// mass.
bool IsCarriedBody(const Effect& effect);
// Whether `mean` is one of the law's `means`.
bool HasMean(const Effect& law, const Effect& mean);
// "N m s/rad" from "E s/P" for a revolute joint.
std::string ParameterUnit(const std::string& unit, JointType type);
// The number of that name, which has to be there.
double NumberOf(const EffectNumbers& numbers, const std::string& name);
// What the effect says of itself at p.
std::vector<EffectEstimate> EstimatesOf(const Effect& effect,
                                        const EffectSite& site,
                                        const Eigen::VectorXd& p);

}  // namespace effects
}  // namespace armcal
