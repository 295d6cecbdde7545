#include "calib/poses/verdict.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <utility>

#include "calib/linear/verdict.h"
#include "calib/logs/encoder_noise.h"
#include "calib/poses/follow.h"
#include "calib/poses/misfit.h"
#include "model/text/format.h"
#include "model/text/option_name.h"

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
// Of files as good as their priors say: one in a thousand is called worse.
constexpr double kLeastByPrior = 1e-3;

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

// Joints before the first that moves: they are part of where the arm stands in
// the instrument's frame, which is fitted anyway.
int StandingAtBase(const PoseCalibration& result) {
  int joint = 0;
  while (joint < result.travel.size() && result.travel[joint] < kLeastTravel) {
    ++joint;
  }
  return joint;
}

// Further on, the links on both sides of a joint that stands are one, and which
// of them is how long does not show; its zero is a number like others.
void AddStandingJoints(const Robot& robot, const PoseCalibration& result,
                       Sentences* sentences) {
  const auto is_link = [](const GeometryEstimate& p) {
    return p.prior > 0 && p.name.substr(p.name.rfind('.')) != ".theta";
  };
  if (std::none_of(result.parameters.begin(), result.parameters.end(),
                   is_link)) {
    return;
  }
  Eigen::VectorXd travel = result.travel;
  travel.head(StandingAtBase(result)).setConstant(kLeastTravel);
  AddUnmoved(robot, travel,
             "the geometry of the links on both sides of it is not "
             "determined; measure poses in which it moves, or estimate its "
             "zero alone (" +
                 OptionName("geometry") + "=offsets)",
             sentences);
}

// Those at the base are as if held.
void AddHeldAtBase(const Robot& robot, const PoseCalibration& result,
                   Sentences* notes) {
  const int standing = StandingAtBase(result);
  if (!result.refined || standing == 0 || standing == robot.num_joints()) {
    return;
  }
  std::string names;
  for (int i = 0; i < standing; ++i) {
    names += (i > 0 ? ", " : "") + robot.links[i].joint.name;
  }
  notes->push_back(
      names +
      (standing == 1 ? " never moves: it is held, as is its link"
                     : " never move: they are held, as are their links") +
      " (the file's geometry there is not checked); to leave " +
      (standing == 1 ? "it" : "them") + " out, " + OptionName("base") + "=" +
      robot.links[standing - 1].name +
      " with columns that have joints' names, or measure poses in which " +
      (standing == 1 ? "it moves" : "they move"));
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

// Lengths whose estimates the file's prior hardly allows. Under the prior an
// estimate's distance from the file has a standard deviation below the prior's
// own, since the estimate holds less than all of what the parameter may be by:
// their squares together are below chi squared of so many degrees of freedom.
// Zeros and other angles are not asked: an encoder's zero may be anywhere.
void AddBeyondPrior(const PoseCalibration& result, Sentences* sentences) {
  double squares = 0;
  std::vector<std::pair<double, const GeometryEstimate*>> lengths;
  for (const GeometryEstimate& p : result.parameters) {
    if (!(p.prior > 0) || p.unit != "m" || !p.identifiable) continue;
    const double apart = std::abs(p.value - p.nominal) / p.prior;
    squares += apart * apart;
    lengths.emplace_back(apart, &p);
  }
  if (lengths.empty()) return;
  const auto count = static_cast<double>(lengths.size());
  const auto least = [](double freedom, double chance) {
    return boost::math::quantile(
        boost::math::complement(boost::math::chi_squared(freedom), chance));
  };
  if (squares <= least(count, kLeastByPrior)) return;
  // Of so many the farthest alone (Bonferroni), or all as they are.
  std::sort(lengths.rbegin(), lengths.rend());
  const double far = std::sqrt(least(1, kLeastByPrior / count));
  std::string names;
  constexpr size_t kShown = 3;
  size_t shown = 0, beyond = 0;
  for (const auto& [apart, p] : lengths) {
    if (apart <= far && shown > 0) break;
    ++beyond;
    if (shown == kShown) continue;
    ++shown;
    names += (names.empty() ? "" : ", ") + p->name +
             Format(" by %.4g mm (%.3g standard deviations of %s, %.3g mm)",
                    1e3 * (p->value - p->nominal), apart,
                    OptionName("length_trust").c_str(), 1e3 * p->prior);
  }
  if (beyond > shown) names += Format(" and %zu more", beyond - shown);
  sentences->push_back(
      "lengths are farther from the robot file's than it can be wrong by: " +
      names +
      "; columns of joints may be exchanged or count the other way, or the "
      "file is of another arm; if lengths are that uncertain, say so by " +
      OptionName("length_trust"));
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
  AddStandingJoints(robot, result, &sentences);
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
  AddBeyondPrior(result, &sentences);
  AddOutliers(result, &sentences);
  AddBesideInstrument(result, &sentences);
  return sentences;
}

Sentences PoseNotes(const Robot& robot, const PoseCalibration& result) {
  Sentences notes;
  if (!result.solved) return notes;
  AddHeldAtBase(robot, result, &notes);
  const std::string order = OrderSentence(result.misfit);
  if (!order.empty()) notes.push_back(order);
  if (IsWorseThanFile(result) && !IsClearlyWorseThanFile(result)) {
    notes.push_back(WorseThanFile(result));
  }
  return notes;
}

}  // namespace armcal
