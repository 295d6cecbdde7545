#include "calib/poses/diagnosis/separation.h"

#include <random>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Random joint positions that are tried: of six joints three values each are
// 729.
constexpr int kTriedPoses = 1000;

PoseMeasurements AnyPoses(const PoseMeasurements& measured) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> share(0, 1);
  PoseMeasurements tried;
  tried.q.resize(kTriedPoses, measured.q.cols());
  for (int k = 0; k < kTriedPoses; ++k) {
    for (Eigen::Index i = 0; i < measured.q.cols(); ++i) {
      const double low = measured.q.col(i).minCoeff();
      const double high = measured.q.col(i).maxCoeff();
      tried.q(k, i) = low + share(random) * (high - low);
    }
  }
  tried.targets.assign(measured.targets.size(), MatrixXd::Zero(kTriedPoses, 3));
  if (measured.lengths.size() > 0) tried.lengths.setZero(kTriedPoses);
  if (measured.poses.size() > 0) {
    tried.poses = MatrixXd::Zero(kTriedPoses, 7);
    tried.poses.col(3).setOnes();
  }
  return tried;
}

// Residuals at poses that nobody measured: effects over the order of poses are
// as they end.
VectorXd Predict(const PoseStudy& study, const PoseMeasurements& tried,
                 const PoseModel& model) {
  const PoseEquations equations = study.equations.Of(tried);
  const PoseCampaign campaign =
      MakeCampaign(study.arm, tried, tried.q, model.campaign.zeros);
  std::vector<PoseTerm> terms;
  for (size_t e = 0; e < model.effects.size(); ++e) {
    const PlacedPoseEffect& placed = model.effects[e];
    if (placed.effect->in_order) {
      for (int k = model.begin[e]; k < model.begin[e + 1]; ++k) {
        PoseTerm term = model.terms[k];
        term.signal = VectorXd::Constant(kTriedPoses,
                                         term.signal[term.signal.size() - 1]);
        terms.push_back(term);
      }
      continue;
    }
    for (PoseTerm& term : placed.effect->terms(campaign, placed.place)) {
      terms.push_back(std::move(term));
    }
  }
  return equations.Residuals(terms, model.estimate.state);
}

}  // namespace

PoseSeparation SeparatingPose(const PoseStudy& study, const PoseModel& a,
                              const PoseModel& b) {
  const PoseMeasurements tried = AnyPoses(study.measured);
  // The middle that rotations of the frame are about differs, but in both.
  const VectorXd apart = Predict(study, tried, a) - Predict(study, tried, b);
  const int width = study.equations.width();
  PoseSeparation best;
  for (int k = 0; k < kTriedPoses; ++k) {
    const VectorXd own = apart.segment(k * width, width);
    const double differ = own.head(std::min(width, 3)).norm();
    if (differ < best.differ) continue;
    best.differ = differ;
    best.q = tried.q.row(k);
  }
  return best;
}

}  // namespace armcal
