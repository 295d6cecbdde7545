#include "calib/poses/diagnosis/model.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "calib/poses/repeated_poses.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// An arm has a given effect of the list in one of twenty campaigns.
constexpr double kPriorProbability = .05;
// Of a column's square: what is less is explained by the others.
constexpr double kUnseen = 1e-6;

void MakeTerms(PoseModel* model) {
  model->terms.clear();
  model->begin = {0};
  for (const PlacedPoseEffect& placed : model->effects) {
    for (PoseTerm& term : placed.effect->terms(model->campaign, placed.place)) {
      model->terms.push_back(std::move(term));
    }
    model->begin.push_back(static_cast<int>(model->terms.size()));
  }
}

}  // namespace

std::string PoseModel::Name() const {
  std::string name;
  for (const PlacedPoseEffect& placed : effects) {
    name += (name.empty() ? "" : " + ") +
            PlacedName(*placed.effect, campaign, placed.place);
  }
  return name;
}

PoseModel FitGeometryAlone(const PoseStudy& study, const PoseState& start) {
  PoseModel model;
  model.begin = {0};
  model.estimate = EstimatePoses(study.equations, {}, study.nu, start);
  model.campaign = MakeCampaign(study.arm, study.measured, study.measured.q,
                                study.equations.Zeros(model.estimate.state));
  return model;
}

// Effects' signals depend on where joints stand, which effects change (a
// coupling, a gear ratio) and the joints' zeros. So the fit is repeated with
// new signals where joints turn out to stand elsewhere by more than
// kStandsElsewhere.
PoseModel FitPoseModel(const PoseStudy& study,
                       const std::vector<PlacedPoseEffect>& effects,
                       const PoseModel& from, const VectorXd& amounts) {
  PoseModel model;
  model.effects = effects;
  model.campaign = from.campaign;
  MakeTerms(&model);
  PoseState start = from.estimate.state;
  const Eigen::Index known = start.amounts.size();
  start.amounts.conservativeResize(model.terms.size());
  start.amounts.tail(start.amounts.size() - known) = amounts;
  model.estimate = EstimatePoses(study.equations, model.terms, study.nu, start);
  const MatrixXd standing =
      study.equations.Standing(model.terms, model.estimate.state.amounts);
  const VectorXd zeros = study.equations.Zeros(model.estimate.state);
  const double elsewhere =
      (standing.rowwise() + zeros.transpose() - model.campaign.standing)
          .cwiseAbs()
          .maxCoeff();
  if (elsewhere < kStandsElsewhere) return model;
  model.campaign = MakeCampaign(study.arm, study.measured, standing, zeros);
  MakeTerms(&model);
  model.estimate = EstimatePoses(study.equations, model.terms, study.nu,
                                 model.estimate.state);
  return model;
}

PoseModel FitWithout(const PoseStudy& study, const PoseModel& model,
                     size_t out) {
  std::vector<PlacedPoseEffect> effects = model.effects;
  effects.erase(effects.begin() + static_cast<long>(out));
  PoseModel from = model;
  VectorXd kept(model.begin.back() - model.begin[out + 1] + model.begin[out]);
  kept << model.estimate.state.amounts.head(model.begin[out]),
      model.estimate.state.amounts.tail(model.begin.back() -
                                        model.begin[out + 1]);
  from.estimate.state.amounts.resize(0);
  return FitPoseModel(study, effects, from, kept);
}

bool IsPossible(const PoseModel& model) {
  for (size_t e = 0; e < model.effects.size(); ++e) {
    const PoseEffect& effect = *model.effects[e].effect;
    if (effect.most_amount <= 0) continue;
    const double amount = model.estimate.state.amounts[model.begin[e]];
    double away = std::abs(amount);
    for (const double far : effect.far_amounts) {
      away = std::min(away, std::abs(amount - far));
    }
    if (away > effect.most_amount) return false;
  }
  return true;
}

double OrderCorrelation(const MatrixXd& by_pose) {
  double product = 0, square = 0;
  for (Eigen::Index k = 0; k + 1 < by_pose.cols(); ++k) {
    product += by_pose.col(k).dot(by_pose.col(k + 1));
    square +=
        .5 * (by_pose.col(k).squaredNorm() + by_pose.col(k + 1).squaredNorm());
  }
  return square > 0 ? product / square : 0;
}

namespace {

// 1 + (m - 1) rho of m readings a pose, targets or repeated ones, whose errors
// correlate by rho; m is the mean seen from a reading, sum m^2 / sum m (Kish
// 1965, 5.4 and 11.7).
double ReadingsEffect(const MatrixXd& r, const std::vector<int>& pose_of_row,
                      int targets, double chance) {
  const int poses = CountPoses(pose_of_row);
  const Eigen::Index width = r.rows() / targets;
  MatrixXd sum = MatrixXd::Zero(width, poses);
  VectorXd readings = VectorXd::Zero(poses), squares = VectorXd::Zero(poses);
  for (size_t k = 0; k < pose_of_row.size(); ++k) {
    const int pose = pose_of_row[k];
    const auto row = r.col(static_cast<Eigen::Index>(k));
    sum.col(pose) += row.reshaped(width, targets).rowwise().sum();
    readings[pose] += targets;
    squares[pose] += row.squaredNorm();
  }
  const double others = squares.dot((readings.array() - 1).matrix());
  if (!(others > 0)) return 1;
  const double alike = (sum.squaredNorm() - r.squaredNorm()) / others;
  if (!(alike > chance)) return 1;
  return 1 + (readings.squaredNorm() / readings.sum() - 1) * alike;
}

}  // namespace

// Both factors are taken only where they exceed chance: that of a pose's
// readings, and (1 + rho) / (1 - rho) of poses whose errors are an AR(1)
// process over their order.
double DesignEffect(const PoseStudy& study, const PoseModel& model) {
  const MatrixXd r =
      WeightedRows(model.estimate, model.estimate.linear.r)
          .reshaped(study.equations.width(), study.equations.poses());
  const std::vector<int> pose_of_row = RepeatedPoses(study.measured.q);
  const double chance = 2 / std::sqrt(CountPoses(pose_of_row));
  const int targets = std::max<int>(1, study.measured.targets.size());
  double effect = ReadingsEffect(r, pose_of_row, targets, chance);
  const double order =
      std::min(.98, OrderCorrelation(MeansByPose(r, pose_of_row)));
  if (order > chance) effect *= (1 + order) / (1 - order);
  return effect;
}

double PriorPenalty(const PoseCampaign& campaign, const PoseEffect& effect) {
  const double count =
      effect.count != nullptr
          ? effect.count(campaign)
          : static_cast<double>(effect.places(campaign).size());
  return 2 * std::log(std::max(1.0, count) / kPriorProbability);
}

MatrixXd AmountsInformation(const PoseStudy& study, const PoseModel& model) {
  const MatrixXd columns =
      study.equations.Columns(model.estimate.linear, model.terms);
  const MatrixXd A = PoseInformation(study.equations, model.estimate, columns);
  const Eigen::Index g = study.equations.num_free(), q = columns.cols();
  const MatrixXd shared = A.topRightCorner(g, q);
  return A.bottomRightCorner(q, q) -
         shared.transpose() * A.topLeftCorner(g, g).ldlt().solve(shared);
}

// deviance / design effect + priors + log det A of the geometry (Laplace; Kass
// & Raftery 1995, J. Am. Stat. Assoc. 90) + log N for each amount that is seen
// (Schwarz 1978, Annals of Statistics 6) + 2 log(places / probability) for each
// effect. The geometry is in all models that are compared; amounts have no
// prior, for which Schwarz's is.
double EvidenceOf(const PoseStudy& study, const PoseModel& model,
                  double design_effect) {
  const PoseEstimate& at = model.estimate;
  MatrixXd A = WeightedRows(at, at.linear.geometry);
  A = (A.transpose() * A / design_effect).eval();
  A.diagonal() += study.equations.Precision();
  A.diagonal().array() += 1e-12;
  const VectorXd pivots = A.ldlt().vectorD();
  double score = at.errors.deviance / design_effect + at.prior +
                 pivots.array().max(1e-300).log().sum();
  const double equations = static_cast<double>(at.linear.r.size());
  const double count = (equations - at.parameters) / design_effect;
  if (!model.terms.empty()) {
    const MatrixXd own = study.equations.Columns(at.linear, model.terms);
    const MatrixXd S = AmountsInformation(study, model);
    const VectorXd size =
        WeightedRows(at, own).colwise().norm().cwiseMax(1e-30);
    const MatrixXd relative =
        size.cwiseInverse().asDiagonal() * S * size.cwiseInverse().asDiagonal();
    const VectorXd seen =
        Eigen::SelfAdjointEigenSolver<MatrixXd>(relative).eigenvalues();
    // Those that are at their least have taken nothing from the poses.
    double at_least = 0;
    for (size_t k = 0; k < model.terms.size(); ++k) {
      at_least += at.state.amounts[k] <= model.terms[k].least;
    }
    const auto told = static_cast<double>((seen.array() > kUnseen).count());
    score += std::log(std::max(2.0, count)) * std::max(0.0, told - at_least);
  }
  for (const PlacedPoseEffect& placed : model.effects) {
    score += PriorPenalty(model.campaign, *placed.effect);
  }
  return score;
}

}  // namespace armcal
