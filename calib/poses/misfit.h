#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "calib/poses/calibration.h"
#include "calib/poses/fit.h"
#include "model/log_files/pose_reader.h"

namespace armcal {

// Of what is left, in the instrument's standard deviations: beyond the root of
// ten, nine tenths of its mean square are the arm's and not the instrument's.
// By chance alone ten spare equations exceed it once in 10^16.
inline const double kMostOfInstrument = std::sqrt(10.0);

// Half-width of a normal error's 95 % interval in standard deviations.
inline constexpr double kNormal95 = 1.96;

// Errors beside an instrument whose 95 % half-widths are stated.
class InstrumentErrors {
 public:
  void Add(double error, double u95);  // same units; u95 of 0: not stated
  // Root of the mean square in the instrument's standard deviations, with so
  // many degrees of freedom taken by what was fitted; left alone where they
  // take all.
  void Tell(double taken, PoseMisfit* misfit) const;

 private:
  double squares_ = 0;
  std::vector<double> stated_;
};

// Whether successive poses are alike by more than chance.
bool IsAlikeInOrder(const PoseMisfit& misfit);

// What the fit leaves of the poses `inliers`, in the order of the file, with so
// many unknowns.
PoseMisfit MeasureMisfit(const PoseFit& fit, const PoseMeasurements& measured,
                         const PoseUnknowns& at,
                         const std::vector<int>& inliers, int num_unknowns);

// Per joint, how much of its motion is in `inliers`: their sum of squares about
// their mean over that of all poses, which is the share of the information on
// whatever grows with the joint's position. 1 where a joint never moves.
Eigen::VectorXd MotionShare(const Eigen::MatrixXd& q,
                            const std::vector<int>& inliers);

// Whether what is left depends on when it was measured, for people to read;
// empty where it does not.
std::string OrderSentence(const PoseMisfit& misfit);

}  // namespace armcal
