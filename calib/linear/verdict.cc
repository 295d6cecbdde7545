#include "calib/linear/verdict.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "calib/linear/outlier_report.h"
#include "calib/logs/encoder_noise.h"
#include "model/robot/joint.h"

namespace armcal {
namespace {

using Sentences = std::vector<std::string>;

// Shares of what was measured that a fit must not leave: of all joints' torque,
// and of one joint's (where others can be right).
constexpr double kMostResidual = 70;  // %: half of the mean square
constexpr double kMostOfOneJoint = 90;
// Routine data hold 1 to 10 % gross errors (Hampel et al. 1986, section 1.2c):
// what a fit leaves out beyond that is no error but something that it lacks.
constexpr double kMostSpikes = .1;

std::string Number(double x) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g", x);
  return text;
}

bool IsUnpowered(const LinearCalibration& result, int joint) {
  return std::any_of(result.unpowered.begin(), result.unpowered.end(),
                     [joint](const auto& u) { return u.joint == joint; });
}

// "joint2", where its samples that the fit left out are more than gross errors
// are; empty: no joint's are.
std::string LeavesOutMany(const Robot& robot, const LinearCalibration& result) {
  const auto samples = static_cast<double>(result.training->samples());
  for (int i = 0; i < robot.num_joints(); ++i) {
    const auto spikes = static_cast<double>(CountOutliers(result, i));
    if (spikes > kMostSpikes * samples) return robot.links[i].joint.name;
  }
  return "";
}

// Of the samples that the fit kept: those that it left out are listed, and the
// fit is no worse for them. Unless they are too many, which then is the fault.
void AddUnexplained(const Robot& robot, const LinearCalibration& result,
                    Sentences* sentences) {
  const auto figures = result.training->kept();
  const double with_spikes = result.training->moving().stacked_percent;
  const std::string many = LeavesOutMany(robot, result);
  if (figures.stacked_percent <= kMostResidual && with_spikes > kMostResidual &&
      !many.empty()) {
    sentences->push_back("the model leaves " + Number(with_spikes) +
                         " % of the torque unexplained, most of it in spikes, "
                         "which are more of the samples of " +
                         many + " than gross errors are");
    return;
  }
  if (figures.stacked_percent > kMostResidual) {
    sentences->push_back("the model leaves " + Number(figures.stacked_percent) +
                         " % of the torque unexplained: torque and motion do "
                         "not belong together");
    return;
  }
  for (int i = 0; i < robot.num_joints(); ++i) {
    if (!(figures.percent[i] > kMostOfOneJoint)) continue;
    if (IsUnpowered(result, i)) continue;
    sentences->push_back("the model leaves " + Number(figures.percent[i]) +
                         " % of the torque of " + robot.links[i].joint.name +
                         " unexplained");
  }
}

}  // namespace

void AddUnmoved(const Robot& robot, const Eigen::VectorXd& travel,
                const std::string& what, Sentences* sentences) {
  for (int i = 0; i < travel.size(); ++i) {
    if (travel[i] >= kLeastTravel) continue;
    const Joint& joint = robot.links[i].joint;
    sentences->push_back(joint.name + " never moves (by " + Number(travel[i]) +
                         " " + PositionUnit(joint.type) + " at most): " + what);
  }
}

// A fit that runs always has numbers. These are the cases in which they are of
// no use to anyone; good fits are not graded.
Sentences Shortcomings(const Robot& robot, const LinearCalibration& result) {
  if (!result.solved) return {result.reason};
  const Identifiability& id = result.identifiability;
  Sentences sentences;
  if (id.batch_rank == 0) {
    return {"none of the " + std::to_string(id.total) +
            " parameters shows in this motion"};
  }
  if (id.batch_rank < id.total) {
    AddUnmoved(robot, result.travel, "what only its motion shows is unknown",
               &sentences);
  }
  if (result.training) AddUnexplained(robot, result, &sentences);
  return sentences;
}

nlohmann::json VerdictJson(const Sentences& shortcomings) {
  return {{"passed", shortcomings.empty()}, {"reasons", shortcomings}};
}

std::string VerdictText(const Sentences& shortcomings) {
  std::string text;
  for (const std::string& sentence : shortcomings) {
    text += "failed     " + sentence + "\n";
  }
  return text;
}

}  // namespace armcal
