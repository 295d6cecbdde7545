#include "calib/refine/impossible_robot.h"

#include "model/text/format.h"

namespace armcal {
namespace {

// Rms over rms torque. No model of an arm leaves less of a measured torque
// (TorqueFit); less of a simulated one is as good as nothing.
constexpr double kUsualPercent = 1;
// Of the squares that the robot leaves, the share that the linear model leaves,
// too. Of 117 logs of ../shared/data it is .17 and more, and of those whose
// torque was measured .27 (double pendulum C1_sysid_01: 15.4 % and 29.6 %): the
// linear model takes up some of what friction's law misses by parameters that
// are a little impossible. Of one, 4 s long (C1_sysid_04), it is .04, and its
// robot leaves 97 % of the torque. Of simulated logs with all torques negated,
// or with a time in ms that is read as s, it is .011 and less.
constexpr double kMostLeftAnyway = .1;

double Square(double x) { return x * x; }

}  // namespace

std::string WhatNoRobotExplains(const LinearCalibration& linear,
                                const NonlinearCalibration& refined,
                                const ArmTrust& trust) {
  if (!linear.solved || !linear.training || !refined.converged() ||
      !refined.training || trust.inertia < ArmTrust().inertia) {
    return "";
  }
  const double any = linear.training->moving().stacked_percent;
  const double robot = refined.training->moving().stacked_percent;
  if (!(Square(any) + Square(kUsualPercent) <
        kMostLeftAnyway * Square(robot))) {
    return "";
  }
  return Format(
      "no robot that can exist explains these logs as their own linear model "
      "does: the nearest leaves %.3g %% of the torque, the linear model, whose "
      "masses and friction may be negative, %.3g %%. Are signs, units and "
      "order of torques and positions right (armcal inspect), and does the "
      "motion tell enough?",
      robot, any);
}

}  // namespace armcal
