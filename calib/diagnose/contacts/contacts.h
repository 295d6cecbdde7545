#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calib/diagnose/contacts/excess.h"
#include "calib/diagnose/data/thresholds.h"
#include "model/effects/effect.h"
#include "model/log_files/time_base.h"

namespace armcal {

// A stretch of time in which something from outside acted on the arm.
struct Contact {
  int log = 0;
  TimeRange window;       // s since the log's first row
  double time = 0;        // of its peak, s
  double width = 0;       // s, of a pulse, from its peak to 1/e; else 0
  int joint = 0;          // from 0: that felt it most, over noise and friction
  double deviations = 0;  // that joint's, beyond friction, over the noise's
  // At the peak, as the environment acts on the joints, n entries, N m or N. At
  // rest a joint's friction may hold any part of it.
  Eigen::VectorXd torque, stddev;
  // The force on the tool's origin, in W, that gives the joints these torques;
  // none where no force there does, or where three joints or fewer cannot tell.
  struct Force {
    Eigen::Vector3d value;       // N
    Eigen::Matrix3d covariance;  // N^2
  };
  std::optional<Force> force;
  // A larger force at the tool would need levers shorter than is probable, N.
  double largest_force = 0;
};

// Where contacts are looked for: where the arm rests just before or after in
// the same posture, held by friction; in motion where two joints at least feel
// them at once; or anywhere in motion.
enum class ContactSearch { kAtRest, kOfTwoJoints, kInMotion };

// Windows in which the excess is above `threshold`, in the order of time.
std::vector<Contact> FindContacts(const Robot& robot, const GapRows& rows,
                                  const FrictionExcess& excess,
                                  double threshold, ContactSearch search);

// What acted on the arm in a window of a log.
Contact DescribeContact(const Robot& robot, const GapRows& rows,
                        const FrictionExcess& excess, int log,
                        const TimeRange& window);

// chi^2 of the excess in a contact's window, of all joints and of the one that
// has most of it.
struct ContactStrength {
  double all = 0;
  double one_joint = 0;
};
ContactStrength StrengthOf(const GapRows& rows, const FrictionExcess& excess,
                           const Contact& contact);

// Its size for a report, with standard deviations: the force at the tool, or
// the torque on the joint that felt it most.
std::vector<EffectEstimate> ContactEstimates(const Robot& robot,
                                             const Contact& contact,
                                             std::vector<double>* stddev);

}  // namespace armcal
