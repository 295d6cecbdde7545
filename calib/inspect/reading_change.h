#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/inspect/position_unit.h"
#include "calib/logs/uniform_series.h"
#include "calib/logs/wiring.h"
#include "model/robot/robot.h"

namespace armcal {

// How a log, and the robot's posture, are to be understood.
struct LogReading {
  Wiring wiring;
  PositionUnits units;
  Eigen::Vector3d gravity;  // in W, m/s^2; 0: torques hold no gravity
  double delay = 0;         // of torques behind positions, s
  double torque_unit = 1;   // N m or N of a torque of 1 as logged

  explicit LogReading(const Robot& robot)
      : wiring(robot.num_joints()), gravity(robot.gravity) {}
};

// At most `count` samples as the robot's joints have them if that is the
// reading, in SI units.
WiringSamples SamplesAs(const LogReading& reading, const Robot& robot,
                        const UniformSeries& series, int count);

// One thing by which the best reading differs from the log as it is.
struct ReadingChange {
  enum class Kind {
    kExchanged,           // two joints' columns
    kPositionsExchanged,  // theirs alone, with velocities and commands
    kTorquesExchanged,
    kPositionSign,  // of one joint
    kTorqueSign,
    kJointSign,       // of both
    kAllTorqueSigns,  // of all joints at once
    kAllPositionSigns,
    kDegrees,
    kMillimetres,
    kGravity,  // has another direction, or is missing
    kDelay,
    kTorqueUnit
  };
  Kind kind;
  int joint = -1, other = -1;  // from 0
  double gain = 0;             // nats of TorqueFit::Misfit
  // What a fit leaves of torques that it has not seen, before and after.
  double held_out_before = 0, held_out_after = 0;  // %
  double probability = 1;  // against the other changes that were tried
  // Of what concerns positions or torques alone: other changes of these joints
  // that would do as well, since nothing tells which way a joint turns, or what
  // an arm of two joints is like.
  std::vector<ReadingChange> alternatives{};
  std::string hint{};     // what speaks for it beside torques
  bool is_doubt = false;  // it may be the robot file that is wrong
  // Of all torques' signs: the joints whose torques are right as logged.
  std::vector<int> but{};
};

// Whether it is the sign of one joint's position or torque alone.
bool IsOneSign(ReadingChange::Kind kind);
// Whether it is the sign of all joints' positions or torques.
bool IsAllSigns(ReadingChange::Kind kind);
// Whether it may be the one or the other that is wrong: both concern positions
// or torques alone, and a joint that is in both; or all joints' signs, and
// one's.
bool MayBeEither(const ReadingChange& a, const ReadingChange& b);
// The joint or joints that it concerns; none where it is all.
std::vector<int> JointsOf(const ReadingChange& change);
// All torques turned round and some of them turned round once more are all
// torques but those: one change, of which no part is false.
void MergeTorqueSigns(std::vector<ReadingChange>* changes);
// A unit that signs and order are asked in is told by FindTorqueUnits, or not.
void DropTorqueUnit(std::vector<ReadingChange>* changes);
// Whether joints move alike in both, whatever their torques.
bool MoveAlike(const LogReading& a, const LogReading& b);

}  // namespace armcal
