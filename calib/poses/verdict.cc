#include "calib/poses/verdict.h"

#include <algorithm>
#include <cmath>

#include "calib/linear/verdict.h"
#include "calib/logs/encoder_noise.h"
#include "calib/poses/follow.h"
#include "calib/poses/misfit.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using Sentences = std::vector<std::string>;

// Of the poses: routine data hold 1 to 10 % gross errors (Hampel et al. 1986,
// section 1.2c). More are no gross errors but something that the model lacks.
constexpr double kMostGrossErrors = 0.1;
constexpr double kOneSided95 = 1.645;  // standard deviations
// Of a joint's motion: with less among the inliers the deviation of what grows
// with its position is more than three times (the root of ten) what all poses
// seemed to promise.
constexpr double kLeastInlierMotion = 0.1;

// Of what is measured, in thousandths: mm, or mrad of an inclinometer.
std::string Thousandths(const PoseCalibration& result, double x) {
  return Format("%.3g m", 1e3 * x) + result.unit;
}

// More outliers than so many poses have by chance at the largest usual share.
bool AreNoGrossErrors(int outliers, int poses) {
  const double expected = kMostGrossErrors * poses;
  return outliers >
         expected + kOneSided95 * std::sqrt(expected * (1 - kMostGrossErrors));
}

// A joint whose positions have to be negated turns by 1 - 2 times what it says.
bool CountsTheOtherWay(const PoseCoupling& c) {
  return c.joint == c.by && std::abs(c.factor + 2) <= kNormal95 * c.stddev;
}

void AddCoupling(const Robot& robot, const PoseCalibration& result,
                 Sentences* sentences) {
  if (!result.coupling) return;
  const PoseCoupling& c = *result.coupling;
  const std::string own = "q" + std::to_string(c.joint + 1);
  std::string k = "k = " + Format("%.5g", c.factor) + " +- " +
                  Format("%.1g", c.stddev) + " leaves " +
                  Thousandths(result, c.rms_after) + " rms instead of " +
                  Thousandths(result, c.rms_before);
  if (c.angle_before > 0) {
    k += ", " + Format("%.3g", c.angle_after) + " rad instead of " +
         Format("%.3g", c.angle_before) + " rad";
  }
  k += ": correct the joint positions beside the poses";
  const std::string name = robot.links[c.joint].joint.name;
  if (CountsTheOtherWay(c)) {
    sentences->push_back("direction: " + name +
                         " counts the other way than in the robot file: " +
                         own + " (1 + k) with " + k);
    return;
  }
  if (c.joint == c.by) {
    sentences->push_back("gear ratio: " + name +
                         " turns by another factor than "
                         "it says: " +
                         own + " (1 + k) with " + k);
    return;
  }
  sentences->push_back("coupling: " + name + " follows " +
                       robot.links[c.by].joint.name + ": " + own + " + k q" +
                       std::to_string(c.by + 1) + " with " + k);
}

// Joints whose motion is given up with the outliers.
void AddGivenUpMotion(const Robot& robot, const PoseCalibration& result,
                      Sentences* sentences) {
  for (int i = 0; i < result.inlier_motion.size(); ++i) {
    if (result.travel[i] < kLeastTravel) continue;
    if (result.inlier_motion[i] >= kLeastInlierMotion) continue;
    sentences->push_back(
        robot.links[i].joint.name + " moves only in poses that are outliers (" +
        Format("%.1f", 100 * result.inlier_motion[i]) +
        " % of its motion is in others): the model does not explain how it "
        "moves, and the others do not tell");
  }
}

void AddOutliers(const PoseCalibration& result, Sentences* sentences) {
  const int outliers = static_cast<int>(result.outliers.size());
  if (!AreNoGrossErrors(outliers, result.count)) return;
  sentences->push_back(
      std::to_string(outliers) + " of " + std::to_string(result.count) +
      " poses are outliers to the others: more than gross errors make (10 %)");
}

void AddBesideInstrument(const PoseCalibration& result, Sentences* sentences) {
  const PoseMisfit& misfit = result.misfit;
  if (!(misfit.instrument_ratio > kMostOfInstrument)) return;
  sentences->push_back("geometry leaves " +
                       Thousandths(result, result.inlier_rms) +
                       " rms beside an instrument that is good to " +
                       Thousandths(result, misfit.instrument_u95) +
                       " (u95): " + Format("%.3g", misfit.instrument_ratio) +
                       " times its standard deviation, at most " +
                       Format("%.2g", kMostOfInstrument) +
                       " can count as errors of measurement");
}

// Which is also what a loss is chosen by (cross_validation.h).
bool IsClearlyWorseThanFile(const PoseCalibration& result) {
  return IsWorseThanFile(result) && result.held_out_excess.is_clear();
}

std::string WorseThanFile(const PoseCalibration& result) {
  return "on poses that were left out the refined geometry is worse (" +
         Thousandths(result, result.compared_rms) + " rms) than the file's (" +
         Thousandths(result, result.file_compared_rms) +
         "): too few poses for so many parameters, or what it gives up as "
         "outliers is not explained by it; measure more poses, or estimate "
         "fewer parameters";
}

}  // namespace

// Over poses that not both give up: one gross error would decide otherwise, by
// whatever little the two predictions differ along it.
bool IsWorseThanFile(const PoseCalibration& result) {
  return result.solved && result.refined && result.file_held_out_rms > 0 &&
         result.held_out_excess.mean > 0;
}

// What makes the geometry useless, or a poor account of what was measured.
Sentences Shortcomings(const Robot& robot, const PoseCalibration& result) {
  if (!result.solved) return {result.reason};
  Sentences sentences;
  AddCoupling(robot, result, &sentences);
  if (result.refined) {
    AddUnmoved(robot, result.travel, "its geometry is not determined",
               &sentences);
  }
  AddGivenUpMotion(robot, result, &sentences);
  const double deviation = std::max(result.median, result.held_out_median);
  if (!FollowsJoints(deviation, result.extent)) {
    sentences.push_back("the poses do not follow the joints: they deviate by " +
                        Thousandths(result, deviation) +
                        " (median) of an extent of " +
                        Thousandths(result, result.extent));
  }
  if (IsClearlyWorseThanFile(result)) {
    sentences.push_back(WorseThanFile(result));
  }
  AddOutliers(result, &sentences);
  AddBesideInstrument(result, &sentences);
  return sentences;
}

Sentences PoseNotes(const PoseCalibration& result) {
  Sentences notes;
  if (!result.solved) return notes;
  const std::string order = OrderSentence(result.misfit);
  if (!order.empty()) notes.push_back(order);
  if (IsWorseThanFile(result) && !IsClearlyWorseThanFile(result)) {
    notes.push_back(WorseThanFile(result));
  }
  return notes;
}

}  // namespace armcal
