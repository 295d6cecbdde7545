#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/data/segment.h"
#include "calib/logs/prepared_logs.h"

namespace armcal {

// The segments of the logs, in order; those shorter than 2 s are left out.
// Motion is low-passed at five times the bandwidth of the torque residual:
// what is computed from it passes that filter again, as the torque does, and
// must not have been bent below it.
std::vector<GapSegment> ReadSegments(double bandwidth_hz,
                                     const Progress& progress,
                                     const LogSet& logs);

// Noise of the recorded positions (position_noise.h), n entries, and the rate
// they were recorded at.
struct RecordedPositions {
  Eigen::VectorXd noise;  // rad or m
  double rate_hz = 0;
};
RecordedPositions AuditPositions(const Progress& progress, const LogSet& logs);

// Of the motion of segments, Hz.
double MotionBandwidth(double bandwidth_hz);
// The time in which what passes a low pass turns by a radian, 1 / (2 pi f): a
// shorter one is nothing to it, and one by which a signal is late is to first
// order a factor of its derivative up to there. s
double ResolvedTime(double bandwidth_hz);

// Friction is the model's at the temperature of the first sample that was read,
// which *usual is, or becomes where it is empty.
void SetUsualTemperature(Eigen::VectorXd* usual,
                         std::vector<GapSegment>* segments);

}  // namespace armcal
