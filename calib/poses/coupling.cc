#include "calib/poses/coupling.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

#include "calib/logs/encoder_noise.h"
#include "calib/poses/follow.h"
#include "calib/poses/joint_terms_fit.h"
#include "calib/poses/load_moment.h"
#include "calib/poses/repeated_poses.h"
#include "calib/poses/some_poses.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Twice the logarithm of a Bayes factor, by the criterion of Schwarz (1978):
// above 10 is "very strong" (Kass and Raftery 1995, section 3.2).
constexpr double kVeryStrong = 10;
// Of the held-out mean square, in logarithms: more is explained than is left.
const double kMostIsExplained = std::log(2.0);
// Joint stiffnesses of industrial arms are 0.2 to 5 MN m/rad and their loads
// some kN m (Abele, Weigold and Rothenbuecher 2007): they sag by some mrad.
constexpr double kSag = 5e-3;  // rad, standard deviation
// Joints bend and run eccentrically by some mrad whatever their drives do, and
// over less than a turn that looks linear: a relation turns its joint by more.
constexpr double kLeastTurn = kSag;   // rad, rms over the poses
constexpr double kLeastShift = 1e-3;  // m, of prismatic joints: their play
// m: the weight turns no joint whose lever changes less between poses.
constexpr double kLeastLever = 1e-2;
// Of those that poses follow is left what all joints err by unasked.
constexpr double kMostOfAJoint = kSag;  // rad, of each joint
// Relations that are fitted; to first order the others explain less.
constexpr int kFitted = 6;
constexpr int kCouplingFolds = 6;
// Every n-th pose is enough to see a relation of all of them.
constexpr int kMostPoses = 2000;
// Without some to spare any model would fit.
constexpr int kLeastSpare = 10;

struct Relation {
  int joint, by;
  double gain;  // of chi^2, to first order
};

struct Fitted {
  Relation relation;
  PoseNoise noise;
  JointTermsState state;
  double deviance;  // -2 log likelihood but for a constant
};

// Joints that sag under weight on the tool, which each model has: to the poses
// of one posture or two, sag looks like a gear ratio.
std::vector<JointCorrection> SagTerms(const Robot& robot,
                                      const PoseMeasurements& measured) {
  const MatrixXd moments = LoadMoments(robot, measured.q);
  std::vector<JointCorrection> terms;
  for (int i = 0; i < robot.num_joints(); ++i) {
    const VectorXd lever = moments.col(i).array() - moments.col(i).mean();
    const double rms = lever.norm() / std::sqrt(lever.size());
    if (rms < kLeastLever) continue;
    terms.push_back({i, lever / rms, kSag});
  }
  return terms;
}

// Errors of a pose's coordinates are one error here: they are not independent
// where a model lacks something.
double Deviance(const std::vector<double>& mean_squares, int poses) {
  double sum = 0;
  for (const double m : mean_squares) sum += std::log(std::max(1e-14, m));
  return poses * sum;
}

class CouplingSearch {
 public:
  CouplingSearch(const Robot& robot, const PoseMeasurements& measured,
                 const PoseCalibrationOptions& options)
      : robot_(robot),
        measured_(measured),
        options_(options),
        sag_(SagTerms(robot, measured)),
        plain_(robot, measured, options, sag_),
        rows_(measured.size()),
        poses_(CountPoses(RepeatedPoses(measured.q))) {
    std::iota(rows_.begin(), rows_.end(), 0);
  }

  // Fits the geometry without relations, ranks all relations by what they would
  // explain to first order, fits the likeliest, and takes the best if it is
  // clear.
  std::optional<PoseCoupling> Find() {
    Fitted without = {{-1, -1, 0}, {}, plain_.Start(), 0};
    for (const auto what : {RefineGeometry::kNothing, RefineGeometry::kAll}) {
      plain_.Free(what, without.state);
      if (plain_.SpareEquations() < kLeastSpare) return {};
      if (!plain_.SolveWithNoise(rows_, &without.state)) return {};
    }
    without.noise = plain_.noise();
    without.deviance =
        Deviance(plain_.MeanSquares(rows_, without.state), poses_);
    std::vector<Fitted> fitted;
    for (const Relation& relation : Likeliest(without.state)) {
      AddFit(relation, without, &fitted);
    }
    std::sort(fitted.begin(), fitted.end(), [](const auto& a, const auto& b) {
      return a.deviance < b.deviance;
    });
    if (!IsClear(without, fitted)) return {};
    std::optional<PoseCoupling> found = Estimate(without, &fitted[0]);
    if (found && !Explains(*found)) return {};
    return found;
  }

 private:
  std::vector<Relation> Likeliest(const JointTermsState& at) {
    const MatrixXd gains = plain_.Gains(rows_, measured_.q, at);
    const VectorXd travel =
        measured_.q.colwise().maxCoeff() - measured_.q.colwise().minCoeff();
    std::vector<Relation> relations;
    for (int i = 0; i < gains.rows(); ++i) {
      for (int j = 0; j < gains.cols(); ++j) {
        if (travel[j] < kLeastTravel || !(gains(i, j) > 0)) continue;
        relations.push_back({i, j, gains(i, j)});
      }
    }
    std::sort(
        relations.begin(), relations.end(),
        [](const Relation& a, const Relation& b) { return a.gain > b.gain; });
    if (relations.size() > kFitted) relations.resize(kFitted);
    return relations;
  }

  // Whether what is left is what joints err by beside any relation: each by
  // kMostOfAJoint, independently, at a lever as long as the poses are wide.
  // Where it is more, something else is wrong that the relation makes up for in
  // part.
  bool Explains(const PoseCoupling& found) const {
    const double joints = static_cast<double>(measured_.q.cols());
    const double lever = measured_.tilts.size() > 0 ? 1 : PoseExtent(measured_);
    return found.rms_after <= kMostOfAJoint * std::sqrt(joints) * lever;
  }

  // With the levers and the parameters that show once the joints stand where
  // they should.
  std::optional<PoseCoupling> Estimate(const Fitted& without, Fitted* best) {
    const Relation& relation = best->relation;
    const VectorXd signal = measured_.q.col(relation.by);
    const double factor = best->state.amounts.tail<1>()[0];
    PoseMeasurements corrected = measured_;
    corrected.q.col(relation.joint) += factor * signal;
    std::vector<JointCorrection> terms = SagTerms(robot_, corrected);
    terms.push_back({relation.joint, signal});
    const int last = static_cast<int>(terms.size()) - 1;
    best->state.amounts = factor * VectorXd::Unit(last + 1, last);
    const auto with =
        std::make_unique<JointTermsFit>(robot_, measured_, options_, terms);
    with->set_noise(best->noise);
    with->Free(RefineGeometry::kAll, best->state);
    if (!with->SolveWithNoise(rows_, &best->state)) return {};
    PoseCoupling found;
    found.joint = relation.joint;
    found.by = relation.by;
    found.factor = best->state.amounts.tail<1>()[0];
    found.stddev = with->Stddev(last, rows_, best->state);
    found.rms_before = plain_.RmsDistance(rows_, without.state);
    found.rms_after = with->RmsDistance(rows_, best->state);
    if (measured_.poses.size() == 0) return found;
    const auto angle = [&](JointTermsFit* fit, const JointTermsState& state) {
      return std::sqrt(3 * fit->MeanSquares(rows_, state)[1]);
    };
    found.angle_before = angle(&plain_, without.state);
    found.angle_after = angle(with.get(), best->state);
    return found;
  }

  std::unique_ptr<JointTermsFit> WithRelation(const Relation& relation) const {
    std::vector<JointCorrection> terms = sag_;
    terms.push_back({relation.joint, measured_.q.col(relation.by)});
    auto fit =
        std::make_unique<JointTermsFit>(robot_, measured_, options_, terms);
    fit->FreeAlike(plain_);
    return fit;
  }

  void AddFit(const Relation& relation, const Fitted& without,
              std::vector<Fitted>* fitted) const {
    const auto fit = WithRelation(relation);
    Fitted with = {relation, {}, without.state, 0};
    with.state.amounts.conservativeResize(sag_.size() + 1);
    with.state.amounts.tail<1>().setZero();
    fit->set_noise(without.noise);
    if (!fit->SolveWithNoise(rows_, &with.state)) return;
    with.noise = fit->noise();
    with.deviance = Deviance(fit->MeanSquares(rows_, with.state), poses_);
    fitted->push_back(with);
  }

  // Whether the relation moves its joint by more than joints do unasked.
  bool IsLarge(const Fitted& fitted) const {
    const VectorXd q = measured_.q.col(fitted.relation.by);
    const double rms =
        (q.array() - q.mean()).matrix().norm() / std::sqrt(q.size());
    const Joint& joint = robot_.links[fitted.relation.joint].joint;
    return std::abs(fitted.state.amounts.tail<1>()[0]) * rms >
           (IsRotational(joint.type) ? kLeastTurn : kLeastShift);
  }

  // Of a mean square on poses that were left out.
  double HeldOut(JointTermsFit* fit, const Fitted& fitted) const {
    std::vector<double> sums;
    const std::vector<int> folds =
        InterleavedFolds(RepeatedPoses(measured_.q), kCouplingFolds);
    for (int fold = 0; fold < kCouplingFolds; ++fold) {
      std::vector<int> kept, left_out;
      for (const int k : rows_) {
        (folds[k] == fold ? left_out : kept).push_back(k);
      }
      if (left_out.empty()) continue;
      JointTermsState state = fitted.state;
      fit->set_noise(fitted.noise);
      if (!fit->Solve(kept, &state)) return 0;
      const std::vector<double> m = fit->MeanSquares(left_out, state);
      sums.resize(m.size());
      for (size_t k = 0; k < m.size(); ++k) {
        sums[k] += m[k] * static_cast<double>(left_out.size());
      }
    }
    for (double& sum : sums) sum /= static_cast<double>(measured_.size());
    return Deviance(sums, 1);
  }

  bool IsClear(const Fitted& without, const std::vector<Fitted>& fitted) {
    if (fitted.empty() || !IsLarge(fitted[0])) return false;
    const double models = static_cast<double>(measured_.q.cols()) *
                          static_cast<double>(measured_.q.cols());
    const double penalty = std::log(poses_) + 2 * std::log(models);
    const Fitted& best = fitted[0];
    if (without.deviance - best.deviance - penalty < kVeryStrong) return false;
    if (fitted.size() > 1 && fitted[1].deviance - best.deviance < kVeryStrong) {
      return false;
    }
    return HeldOut(&plain_, without) -
               HeldOut(WithRelation(best.relation).get(), best) >
           kMostIsExplained;
  }

  const Robot& robot_;
  const PoseMeasurements& measured_;
  const PoseCalibrationOptions& options_;
  std::vector<JointCorrection> sag_;
  JointTermsFit plain_;  // without a relation
  std::vector<int> rows_;
  int poses_;  // of which several rows may be readings
};

}  // namespace

std::optional<PoseCoupling> FindCoupling(
    const Robot& robot, const PoseMeasurements& measured,
    const PoseCalibrationOptions& options) {
  const PoseMeasurements some = SomePoses(measured, kMostPoses);
  return CouplingSearch(robot, some, options).Find();
}

}  // namespace armcal
