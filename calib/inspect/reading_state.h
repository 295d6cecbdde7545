#pragma once

#include <vector>

#include "calib/inspect/held_out_fit.h"
#include "calib/inspect/reading_candidates.h"
#include "calib/inspect/reading_change.h"
#include "calib/inspect/torque_scale.h"
#include "calib/logs/uniform_series.h"
#include "calib/logs/wiring.h"
#include "model/robot/robot.h"

namespace armcal {

// Nats that a change has to explain of some hundred samples.
inline constexpr double kLeastReadingGain = 15;

// The best reading of a log so far, the changes that led to it, and fits to
// this reading and others. Refers to robot and series.
struct ReadingState {
  ReadingState(const Robot& robot, const UniformSeries& series);

  Robot RobotOf(const LogReading& reading) const;
  WiringSamples SamplesOf(const LogReading& reading) const;
  TorqueFit FitOf(const LogReading& reading) const;
  double Misfit(const LogReading& reading, double* percent = nullptr) const;
  HeldOutFit HeldOut(const LogReading& reading) const;
  TorqueScales ScalesOf(LogReading reading) const;
  // Whether these joints, read so, are where the robot file says that they can
  // be, and no faster where speeds are asked, in all but a hundredth of the
  // samples.
  bool AreInReach(const LogReading& reading, const std::vector<int>& joints,
                  bool asks_speed) const;

  void Accept(Candidate candidate, double new_misfit, double probability,
              const HeldOutFit& fit);
  // The change of gravity among `changes`, or their end.
  std::vector<ReadingChange>::iterator FoundGravity();
  // A change of gravity is none where another has put it back.
  void ForgetGravityOfFile();

  const Robot& robot;
  const UniformSeries& series;
  const int samples;  // of a fit
  LogReading best;
  double misfit = 0;    // of best
  HeldOutFit held_out;  // of best
  // How many joints tell a delay, that of the latest candidates; 1: the arm has
  // no other that could disagree.
  int joints_of_delay = 0;
  std::vector<ReadingChange> changes;
};

}  // namespace armcal
