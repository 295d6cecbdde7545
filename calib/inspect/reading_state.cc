#include "calib/inspect/reading_state.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace armcal {
namespace {

// Of 7 joints or fewer; the work grows with the joints' fifth power.
constexpr int kSamplesOfReading = 250;
constexpr int kHeldOutSamples = 500;
constexpr double kOutOfReach = .01;  // of the samples
// By which controllers overshoot limits: of the speed's, and of the range.
constexpr double kOvershoot = .05;

}  // namespace

ReadingState::ReadingState(const Robot& its_robot,
                           const UniformSeries& its_series)
    : robot(its_robot),
      series(its_series),
      samples(kSamplesOfReading * 7 / std::max(7, its_robot.num_joints())),
      best(its_robot),
      held_out(HeldOut(best)) {
  misfit = Misfit(best);
}

Robot ReadingState::RobotOf(const LogReading& reading) const {
  Robot read = robot;
  read.gravity = reading.gravity;
  return read;
}

WiringSamples ReadingState::SamplesOf(const LogReading& reading) const {
  return SamplesAs(reading, robot, series, samples);
}

TorqueFit ReadingState::FitOf(const LogReading& reading) const {
  return {RobotOf(reading), SamplesOf(reading).motion};
}

double ReadingState::Misfit(const LogReading& reading, double* percent) const {
  return MisfitAsLogged(FitOf(reading), reading, SamplesOf(reading).tau,
                        percent);
}

HeldOutFit ReadingState::HeldOut(const LogReading& reading) const {
  return FitHeldOut(RobotOf(reading),
                    SamplesAs(reading, robot, series, kHeldOutSamples));
}

TorqueScales ReadingState::ScalesOf(LogReading reading) const {
  reading.torque_unit = 1;
  return TorqueScale(RobotOf(reading), SamplesOf(reading));
}

bool ReadingState::AreInReach(const LogReading& reading,
                              const std::vector<int>& joints,
                              bool asks_speed) const {
  const Motion motion =
      SamplesAs(reading, robot, series, kHeldOutSamples).motion;
  return std::all_of(joints.begin(), joints.end(), [&](int j) {
    const Joint& joint = robot.links[j].joint;
    const double margin = std::isfinite(joint.upper - joint.lower)
                              ? kOvershoot * (joint.upper - joint.lower)
                              : 0;
    const auto q = motion.q.col(j).array();
    const double top = asks_speed ? (1 + kOvershoot) * joint.velocity
                                  : std::numeric_limits<double>::infinity();
    const auto speed = motion.qd.col(j).array().abs();
    const auto beyond =
        q < joint.lower - margin || q > joint.upper + margin || speed > top;
    return static_cast<double>(beyond.count()) <= kOutOfReach * motion.size();
  });
}

void ReadingState::Accept(Candidate candidate, double new_misfit,
                          double probability, const HeldOutFit& fit) {
  candidate.change.gain = misfit - new_misfit;
  candidate.change.probability = probability;
  candidate.change.held_out_before = held_out.residual_percent;
  candidate.change.held_out_after = fit.residual_percent;
  changes.push_back(candidate.change);
  best = candidate.reading;
  misfit = new_misfit;
  held_out = fit;
  ForgetGravityOfFile();
}

std::vector<ReadingChange>::iterator ReadingState::FoundGravity() {
  return std::find_if(changes.begin(), changes.end(),
                      [](const ReadingChange& change) {
                        return change.kind == ReadingChange::Kind::kGravity;
                      });
}

void ReadingState::ForgetGravityOfFile() {
  const auto gravity = FoundGravity();
  if (gravity != changes.end() && best.gravity.isApprox(robot.gravity)) {
    changes.erase(gravity);
  }
}

}  // namespace armcal
