#include "calib/excite/posture_model.h"

#include <algorithm>

#include "calib/poses/identifiability.h"
#include "model/robot/kinematics.h"
#include "model/text/option_error.h"
#include "model/text/option_name.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// A target off every axis of the tool.
const Eigen::Vector3d kTarget(.08, .05, .1);  // m, in T
// Of an effect's amount: a milliradian, a millimetre, a thousandth.
constexpr double kUsualAmount = 1e-3;
// Instead of no prior.
constexpr double kNextToNothing = 10;

PoseMeasurements Predicted(const Robot& robot, PoseInstrument instrument,
                           const MatrixXd& q) {
  PoseMeasurements measured;
  measured.q = q;
  if (instrument == PoseInstrument::kTarget) {
    measured.targets.assign(1, MatrixXd(q.rows(), 3));
  } else {
    measured.poses.resize(q.rows(), 7);
  }
  for (Eigen::Index k = 0; k < q.rows(); ++k) {
    measured.row.push_back(static_cast<long>(k) + 2);
    const Eigen::Isometry3d X_WT = ToolPose(robot, q.row(k));
    if (instrument == PoseInstrument::kTarget) {
      measured.targets[0].row(k) = X_WT * kTarget;
    } else {
      const Eigen::Quaterniond turn(X_WT.linear());
      measured.poses.row(k) << X_WT.translation().transpose(), turn.w(),
          turn.vec().transpose();
    }
  }
  return measured;
}

}  // namespace

PostureModel::PostureModel(const Robot& robot, const PostureOptions& options,
                           const MatrixXd& q)
    : robot_(robot), options_(options) {
  const PoseMeasurements measured = Predicted(robot, options.instrument, q);
  const PoseCalibrationOptions fit_options = FitOptions();
  const PoseFit fit(robot, measured, fit_options);
  const ArmGeometry& geometry = fit.geometry();
  free_ = HoldUnseen(fit, fit.Wanted(RefineGeometry::kAll), fit.AllRows(),
                     At(fit).unknowns, nullptr);
  const std::vector<std::string> names = geometry.Names();
  const std::vector<std::string> units = geometry.Units();
  for (int k = 0; k < geometry.size(); ++k) {
    if (!free_[k]) continue;
    const bool own = !ArmGeometry::IsBase(k) && !geometry.IsTool(k);
    if (own && options.separate.empty()) {
      wanted_.push_back(static_cast<int>(prior_.size()));
      names_.push_back(names[k]);
      units_.push_back(units[k]);
    }
    prior_.push_back(fit.PriorOf(k));
  }
  prior_.resize(prior_.size() + PoseUnknowns::NumOther(measured), 0);
  if (!options.separate.empty()) AddEffects(measured);
}

// Each in every place, in its simplest form.
void PostureModel::AddEffects(const PoseMeasurements& measured) {
  const PoseCampaign campaign =
      MakeCampaign({robot_, false, options_.gear_ratios}, measured, measured.q);
  for (const std::string& name : options_.separate) {
    const auto& all = PoseEffects();
    const auto effect = std::find_if(
        all.begin(), all.end(),
        [&](const PoseEffect& e) { return e.name == name && !e.in_order; });
    if (effect == all.end()) {
      std::string known;
      for (const PoseEffect& e : all) {
        if (!e.in_order) known += (known.empty() ? "" : ", ") + e.name;
      }
      throw OptionError(OptionName("separate") + ": found '" + name +
                        "', expected effects of poses: " + known);
    }
    const size_t before = names_.size();
    for (const PosePlace& place : effect->places(campaign)) {
      if (place.parts > 1) continue;
      effects_.push_back({&*effect, place});
      for (const PoseTerm& term : effect->terms(campaign, place)) {
        wanted_.push_back(static_cast<int>(prior_.size()));
        names_.push_back(PlacedName(*effect, campaign, place) + ": " +
                         term.name);
        units_.push_back(term.unit);
        prior_.push_back(0);
      }
    }
    if (names_.size() > before) continue;
    throw OptionError(OptionName("separate") + ": such an arm does not show " +
                      name);
  }
}

std::vector<PoseTerm> PostureModel::Terms(
    const PoseMeasurements& measured) const {
  std::vector<PoseTerm> terms;
  if (effects_.empty()) return terms;
  const PoseCampaign campaign =
      MakeCampaign({robot_, false, options_.gear_ratios}, measured, measured.q);
  for (const PlacedPoseEffect& placed : effects_) {
    for (PoseTerm& term : placed.effect->terms(campaign, placed.place)) {
      terms.push_back(std::move(term));
    }
  }
  return terms;
}

std::vector<MatrixXd> PostureModel::Rows(const MatrixXd& q) const {
  const PoseMeasurements measured = Predicted(robot_, options_.instrument, q);
  const PoseCalibrationOptions fit_options = FitOptions();
  const PoseFit fit(robot_, measured, fit_options);
  PoseEquations equations(fit, measured);
  equations.SetFree(free_);
  equations.set_rotation_length(options_.noise.position /
                                options_.noise.rotation);
  const std::vector<PoseTerm> terms = Terms(measured);
  PoseState at = At(fit);
  at.amounts = VectorXd::Zero(static_cast<Eigen::Index>(terms.size()));
  const LinearPoses linear = equations.Linearise(terms, at, false);
  MatrixXd J(linear.r.size(), static_cast<Eigen::Index>(prior_.size()));
  J << linear.geometry, equations.Columns(linear, terms);
  J /= options_.noise.position;
  const int width = equations.width();
  std::vector<MatrixXd> rows;
  for (Eigen::Index k = 0; k < q.rows(); ++k) {
    rows.emplace_back(J.middleRows(k * width, width));
  }
  return rows;
}

MatrixXd PostureModel::Prior() const {
  VectorXd diagonal(prior_.size());
  for (size_t k = 0; k < prior_.size(); ++k) {
    const double stddev = prior_[k] > 0 ? prior_[k] : kNextToNothing;
    diagonal[static_cast<Eigen::Index>(k)] = 1 / (stddev * stddev);
  }
  return diagonal.asDiagonal();
}

VectorXd PostureModel::Scale() const {
  VectorXd scale(wanted_.size());
  for (size_t k = 0; k < wanted_.size(); ++k) {
    const double prior = prior_[wanted_[k]];
    scale[static_cast<Eigen::Index>(k)] = prior > 0 ? prior : kUsualAmount;
  }
  return scale;
}

PoseCalibrationOptions PostureModel::FitOptions() const {
  PoseCalibrationOptions options;
  options.prior_length = options_.prior_length;
  options.prior_angle = options_.prior_angle;
  return options;
}

PoseState PostureModel::At(const PoseFit& fit) const {
  PoseState at = {{fit.geometry().Values(), VectorXd(0)}, VectorXd(0)};
  if (options_.instrument == PoseInstrument::kTarget) {
    at.unknowns.other = kTarget;
  }
  return at;
}

}  // namespace armcal
