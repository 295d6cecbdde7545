#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/logs/uniform_series.h"
#include "calib/logs/wiring.h"
#include "model/robot/robot.h"

namespace armcal {

// How a log, and the robot's posture, are to be understood.
struct LogReading {
  Wiring wiring;
  bool degrees = false;     // positions of rotating joints
  Eigen::Vector3d gravity;  // in W, m/s^2; 0: torques hold no gravity
  double delay = 0;         // of torques behind positions, s

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
    kExchanged,     // two joints' columns
    kPositionSign,  // of one joint
    kTorqueSign,
    kJointSign,  // of both
    kDegrees,
    kGravity,  // has another direction, or is missing
    kDelay
  };
  Kind kind;
  int joint = -1, other = -1;  // from 0
  double gain = 0;             // nats of TorqueFit::Misfit
  // What a fit leaves of torques that it has not seen, before and after.
  double held_out_before = 0, held_out_after = 0;  // %
  double probability = 1;  // against the other changes that were tried
  // Of a position's or torque's sign: whether that of the other would do as
  // well, since nothing tells which way the joint turns.
  bool or_other_sign = false;
};

struct ReadingFinding {
  LogReading reading;
  std::vector<ReadingChange> changes;  // in the order they were found
  double residual_percent_as_is = 0, residual_percent = 0;
};

// Reads a log as its torques fit the robot best: up to four changes, one after
// the other, each of which has to explain much more than chance and a model's
// own errors do: `kLeastGain` nats of some hundred samples, and, of torques that
// the fit has not seen, what IsClearlyBetter and IsBetterForAll say. Of signs
// and order nothing is asked of joints that hardly move, nor of those whose
// torque `tells` nothing (empty: all tell); of gravity nothing where one of
// several joints moves.
ReadingFinding FindReading(const Robot& robot, const UniformSeries& series,
                           const std::vector<bool>& tells = {});

}  // namespace armcal
