#include "calib/diagnose/data/swung_joints.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "model/dynamics/forward_dynamics.h"
#include "model/dynamics/inverse_dynamics.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

// Mean squares over a log's samples, per joint.
struct TorqueSquares {
  VectorXd recorded, gravity, inertia;
  long samples = 0;
};

// How many of a segment's samples are asked: its motion is low-passed, and a
// mean square needs no more.
constexpr int kAsked = 500;

void Add(const Robot& robot, const GapSegment& segment, TorqueSquares* of) {
  const int n = robot.num_joints();
  if (of->samples == 0) {
    of->recorded = of->gravity = of->inertia = VectorXd::Zero(n);
  }
  const Motion& motion = segment.motion;
  const int step = std::max(1, segment.size() / kAsked);
  for (int k = 0; k < segment.size(); k += step) {
    const VectorXd q = motion.q.row(k);
    const VectorXd gravity = GravityTorque(robot, q);
    const VectorXd all =
        InverseDynamics(robot, q, motion.qd.row(k), motion.qdd.row(k));
    of->recorded += segment.tau.row(k).transpose().cwiseAbs2();
    of->gravity += gravity.cwiseAbs2();
    of->inertia += (all - gravity).cwiseAbs2();
    ++of->samples;
  }
}

}  // namespace

// The share that linear calibration has of the robot file's terms
// (FindUsedEquations), on mean squares over each log.
std::vector<SwungJoint> FindSwungJoints(
    const Robot& robot, const std::vector<GapSegment>& segments) {
  constexpr double kShare = .05;
  std::map<int, TorqueSquares> logs;
  for (const GapSegment& segment : segments) {
    Add(robot, segment, &logs[segment.log]);
  }
  std::vector<SwungJoint> swung;
  for (const auto& [log, of] : logs) {
    for (int j = 0; j < robot.num_joints(); ++j) {
      const double samples = static_cast<double>(of.samples);
      const double torque = std::sqrt(of.recorded[j] / samples);
      const double needed =
          std::sqrt((of.gravity[j] + of.inertia[j]) / samples);
      if (torque == 0 || !(torque < kShare * needed)) continue;
      swung.push_back({log, j, torque, needed});
    }
  }
  return swung;
}

std::vector<DataFinding> LeaveOutSwungJoints(
    const Robot& robot, const LogSet& logs, std::vector<GapSegment>* segments) {
  const std::vector<SwungJoint> all = FindSwungJoints(robot, *segments);
  if (all.empty()) return {};
  std::vector<DataFinding> findings;
  std::vector<GapSegment> rest = *segments;
  for (const SwungJoint& swung : all) {
    for (GapSegment& segment : rest) {
      if (segment.log != swung.log) continue;
      segment.still.col(swung.joint).setConstant(true);
    }
    const Joint& joint = robot.links[swung.joint].joint;
    const std::string unit = EffortUnit(joint.type);
    findings.push_back(
        {joint.name + " swings freely in " + logs.path(swung.log),
         Format("its torque of %.2g %s rms is next to nothing beside gravity "
                "and inertia, %.2g %s by themselves; an arm without mass would "
                "move so as well, and its equation of motion is left out",
                swung.torque_rms, unit.c_str(), swung.needed_rms, unit.c_str()),
         "", false, true});
  }
  const bool asks_nothing =
      std::all_of(rest.begin(), rest.end(),
                  [](const GapSegment& one) { return one.still.all(); });
  if (asks_nothing) return {};
  *segments = std::move(rest);
  return findings;
}

}  // namespace armcal
