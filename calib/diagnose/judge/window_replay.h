#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "calib/diagnose/candidates/corrected_robot.h"
#include "calib/diagnose/data/segment.h"
#include "calib/numerics/autoregression.h"

namespace armcal {

// Multiple shooting: stretches of a segment, side by side, that are simulated
// from the recorded state with the recorded torque.
struct ReplayWindows {
  int length;              // samples
  std::vector<int> begin;  // rows of the segment
};
// Windows of this length, the first a second after the segment's begin; those
// that stand still for half of their samples are left out.
ReplayWindows CutWindows(const GapSegment& segment, double window_s);

// What measurements add to a segment.
struct MeasurementNoise {
  Eigen::VectorXd position;  // white, standard deviation, rad or m
  double rate_hz = 0;        // of these samples
  double bandwidth_hz = 0;   // that positions were low-passed at; 0: not
  // Of the torque, samples of `torque_step` s; empty: none.
  std::vector<Autoregression> torque;
  double torque_step = 0;
};

// Mean square per window and joint of simulated minus recorded positions of the
// motors, rad^2 or m^2; a window that gets 100 rad or m away is NaN. Before
// successive windows the recorded motion leads the motors for 10 s, so that
// laws with states and links behind transmissions start a window where that
// motion has brought them; joints that warm up are led from the segment's begin
// on, where their heat starts at 0. Positions are those behind the robot's
// sensor maps and clock.
Eigen::MatrixXd ReplaySquares(const CorrectedRobot& robot,
                              const GapSegment& segment,
                              const ReplayWindows& windows);

// The same, and what noise alone would leave of this robot were it the true
// one: in its starts, its torque and the positions it is compared with.
struct WindowSquares {
  Eigen::MatrixXd error, noise;  // rad^2 or m^2, window by joint
};
WindowSquares ReplaySquaresWithNoise(const CorrectedRobot& robot,
                                     const GapSegment& segment,
                                     const ReplayWindows& windows,
                                     const MeasurementNoise& noise,
                                     std::uint64_t seed);

}  // namespace armcal
