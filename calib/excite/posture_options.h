#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "calib/excite/design_kinds.h"
#include "problems/excitation_criterion.h"
#include "problems/poses/pose_problem.h"
#include "problems/workspace.h"

namespace armcal {

struct PostureOptions {
  int count = 20;
  PoseInstrument instrument = PoseInstrument::kTarget;
  ExcitationCriterion criterion = ExcitationCriterion::kD;
  Eigen::VectorXd lower, upper;  // of joint positions, rad or m
  Workspace workspace;
  PoseNoise noise;
  double prior_length = .01;  // m, how far lengths may be from the file's
  double prior_angle = .02;   // rad
  // Effects of geometry (diagnose --poses) that the postures are to tell apart
  // on every joint; the geometry is unknown beside them. Empty: the geometry
  // itself is to be told.
  std::vector<std::string> separate;
  std::vector<double> gear_ratios;  // motor over joint, of motor_harmonic
  int candidates = 1000;            // random postures to start from
  std::uint64_t seed = 0;
};

}  // namespace armcal
