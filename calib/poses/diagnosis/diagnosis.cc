#include "calib/poses/diagnosis/diagnosis.h"

#include <algorithm>
#include <cmath>

#include "calib/numerics/median.h"
#include "calib/poses/diagnosis/confirmation.h"
#include "calib/poses/diagnosis/interval.h"
#include "calib/poses/diagnosis/remainder.h"
#include "calib/poses/diagnosis/rivals.h"
#include "calib/poses/diagnosis/scan.h"
#include "calib/poses/diagnosis/separation.h"
#include "calib/poses/diagnosis/settled_rivals.h"
#include "calib/poses/follow.h"
#include "calib/poses/pose_solution.h"
#include "model/text/format.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Degrees of freedom of errors while effects are looked for: gross ones are
// taken, and of normal errors one in twenty is lost (Lange, Little and Taylor
// 1989, whose examples have 3 to 6).
constexpr double kHeavyTails = 5;

// Searches of whole poses, and how far the ratio of the errors of positions and
// rotations may be from the one they were weighed by: efficiency falls by less
// than a tenth.
constexpr int kMostWeighings = 3;
constexpr double kSameWeight = 1.5;

void SetErrors(PoseStudy* study, PoseModel* model, PoseModel* alone) {
  study->nu = std::numeric_limits<double>::infinity();
  PoseModel normal = FitPoseModel(*study, model->effects, *model, VectorXd());
  if (normal.estimate.errors.deviance < model->estimate.errors.deviance) {
    *model = std::move(normal);
    *alone = FitGeometryAlone(*study, alone->estimate.state);
    return;
  }
  study->nu = kHeavyTails;
}

// How far an effect by itself moves what is measured.
void SetDisplacement(const PoseStudy& study, const PoseModel& model, size_t e,
                     PoseFinding* finding) {
  PoseState without = model.estimate.state;
  for (int k = model.begin[e]; k < model.begin[e + 1]; ++k) {
    without.amounts[k] = 0;
  }
  const VectorXd moved =
      model.estimate.linear.r - study.equations.Residuals(model.terms, without);
  finding->displacement_rms = RmsDistance(study, moved);
  const int width = study.equations.width();
  const int point = study.measured.lengths.size() > 0 ? 1 : 3;
  for (int k = 0; k < study.equations.poses(); ++k) {
    finding->displacement_max = std::max(
        finding->displacement_max, moved.segment(k * width, point).norm());
  }
}

void SetEquivalents(const PoseStudy& study, const PoseModel& model,
                    const PoseRivals& rivals, PoseFinding* finding) {
  for (const PoseRival& rival : rivals.rivals) {
    PoseEquivalent equivalent;
    equivalent.placed = rival.placed;
    equivalent.name =
        PlacedName(*rival.placed.effect, model.campaign, rival.placed.place);
    equivalent.probability = rivals.probability * rival.weight;
    if (!rival.placed.effect->in_order && !finding->placed.effect->in_order) {
      const PoseSeparation at = SeparatingPose(study, model, rival.model);
      equivalent.told_apart_at = at.q;
      equivalent.differ = at.differ;
    }
    finding->equivalents.push_back(equivalent);
  }
}

std::vector<PoseFinding> FindingsOf(const PoseStudy& study,
                                    const PoseModel& model,
                                    const std::vector<PoseRivals>& all,
                                    double design_effect) {
  const auto amounts = AmountsOf(study, model, design_effect);
  std::vector<PoseFinding> findings;
  for (size_t e = 0; e < model.effects.size(); ++e) {
    PoseFinding finding;
    finding.placed = model.effects[e];
    finding.name = PlacedName(*finding.placed.effect, model.campaign,
                              finding.placed.place);
    finding.amounts = amounts[e].amounts;
    finding.ci95 = amounts[e].ci95;
    const PoseRivals& rivals = all[e];
    finding.probability = rivals.probability;
    finding.none = rivals.none;
    const PoseRange begin =
        SideOf(study, model, e, &PosePlace::begin, design_effect);
    const PoseRange end =
        SideOf(study, model, e, &PosePlace::end, design_effect);
    finding.begin[0] = begin.first;
    finding.begin[1] = begin.last;
    finding.end[0] = end.first;
    finding.end[1] = end.last;
    SetDisplacement(study, model, e, &finding);
    finding.interleaved =
        CompareHeldOut(study, rivals.without, model, EverySixthPose(study));
    finding.contiguous =
        CompareHeldOut(study, rivals.without, model, SixStretches(study));
    SetEquivalents(study, model, rivals, &finding);
    findings.push_back(std::move(finding));
  }
  std::stable_sort(findings.begin(), findings.end(),
                   [](const PoseFinding& a, const PoseFinding& b) {
                     return a.interleaved.removed_share >
                            b.interleaved.removed_share;
                   });
  return findings;
}

void SetUnconfirmed(const PoseStudy& study, const PoseSelection& selection,
                    const PoseModel& model, PoseDiagnosis* result) {
  const PoseModel& best = selection.models[0];
  std::string names;
  for (const PlacedPoseEffect& placed : best.effects) {
    const bool named =
        std::any_of(model.effects.begin(), model.effects.end(),
                    [&](const PlacedPoseEffect& has) {
                      return has.effect == placed.effect &&
                             has.place.joint == placed.place.joint &&
                             has.place.by == placed.place.by;
                    });
    if (named) continue;
    names += (names.empty() ? "" : " + ") +
             PlacedName(*placed.effect, best.campaign, placed.place);
  }
  // What held-out poses speak against is not there.
  const std::vector<int> folds = EverySixthPose(study);
  if (!(CompareHeldOut(study, model, best, folds).deviance > 0)) return;
  result->unconfirmed = names;
}

PoseGap GapOf(const PoseStudy& study, const PoseModel& alone,
              const PoseModel& model) {
  const std::vector<int> every = EverySixthPose(study);
  const std::vector<int> stretch = SixStretches(study);
  const auto held = [&](const PoseModel& m, const std::vector<int>& folds) {
    return RmsDistance(study, HeldOutResiduals(study, m, folds));
  };
  PoseGap gap;
  gap.geometry = RmsDistance(study, alone.estimate.linear.r);
  gap.after = RmsDistance(study, model.estimate.linear.r);
  gap.held_out_geometry = held(alone, every);
  gap.held_out_after = held(model, every);
  gap.stretches_geometry = held(alone, stretch);
  gap.stretches_after = held(model, stretch);
  return gap;
}

// Ratio of the errors of positions to those of rotations that a model leaves,
// from medians: what it lacks may be in either.
double RotationLength(const PoseStudy& study, const PoseModel& model) {
  std::vector<double> positions, rotations;
  const VectorXd& r = model.estimate.linear.r;
  for (Eigen::Index k = 0; k < r.size(); ++k) {
    (k % 6 < 3 ? positions : rotations).push_back(std::abs(r[k]));
  }
  return study.equations.rotation_length() * Median(positions) /
         std::max(1e-12, Median(rotations));
}

struct PoseSearch {
  PoseModel alone, model;
  PoseSelection selection;
};

// Of whole poses the search is done again where it turns out that positions and
// rotations were weighed by what it has explained since.
PoseSearch SearchEffects(const PoseState& start, PoseStudy* study) {
  PoseSearch search;
  for (int round = 0; round < kMostWeighings; ++round) {
    search.alone = FitGeometryAlone(*study, start);
    search.selection = SelectEffects(*study, search.alone);
    search.model = ConfirmedModel(*study, search.selection);
    if (study->measured.poses.size() == 0) break;
    const double length = RotationLength(*study, search.model);
    const double change = length / study->equations.rotation_length();
    if (std::max(change, 1 / change) < kSameWeight) break;
    study->equations.set_rotation_length(length);
  }
  return search;
}

// Amounts that something else has told, too, once effects are named: these stay
// what the poses alone say, and the geometry makes room for both.
void AddTold(const std::vector<Told>& compliance, double design_effect,
             PoseStudy* study, PoseModel* model,
             std::vector<PoseFinding>* findings) {
  study->arm.compliance = compliance;
  PoseModel from = *model;
  from.campaign = MakeCampaign(
      study->arm, study->measured,
      model->campaign.standing.rowwise() - model->campaign.zeros.transpose(),
      model->campaign.zeros);
  *model = FitPoseModel(*study, model->effects, from, VectorXd());
  const std::vector<PoseAmounts> all = AmountsOf(*study, *model, design_effect);
  for (size_t e = 0; e < findings->size(); ++e) {
    PoseFinding& finding = (*findings)[e];
    for (size_t k = 0; k < finding.amounts.size(); ++k) {
      const PoseAmount alone = finding.amounts[k];
      finding.amounts[k] = all[e].amounts[k];
      finding.amounts[k].by_poses = {alone.value, alone.half_width / kNormal95};
    }
    finding.ci95 = all[e].ci95;
  }
}

// As calibrate judges a geometry: where even the effects leave poses anywhere,
// they were taken for what is wrong with the file, and none is claimed.
void RefuseWhatDoesNotFollow(const PoseMeasurements& measured,
                             PoseDiagnosis* result) {
  const double extent = PoseExtent(measured);
  const double left = Median(result->distances);
  if (FollowsJoints(left, extent)) return;
  result->verdict = PoseVerdict::kNotTestable;
  result->findings.clear();
  result->reason = Format(
      "the poses do not follow the joints: they deviate by %.3g mm (median) of "
      "an extent of %.3g mm; signs, units or the order of joints differ from "
      "the robot file's",
      1e3 * left, 1e3 * extent);
}

}  // namespace

PoseDiagnosis DiagnosePoseGap(const Robot& robot,
                              const PoseMeasurements& measured,
                              const PoseDiagnosisOptions& options) {
  PoseCalibrationOptions plain = options.geometry;
  plain.loss = RobustLoss::kSquared;  // none is given up before effects are
  PoseFit fit(robot, measured, plain);
  PoseDiagnosis result;
  const PoseSolution solution = SolvePoses(measured, plain.refine, &fit);
  result.reason = solution.refusal;
  if (!result.reason.empty()) return result;
  PoseStudy study = {{robot, options.weighed, options.gear_ratios},
                     measured,
                     PoseEquations(fit, measured),
                     kHeavyTails,
                     options.without};
  study.equations.SetFree(solution.free);
  study.equations.set_rotation_length(fit.noise().position /
                                      fit.noise().rotation);
  if (options.progress) options.progress("looking for effects", -1);
  auto [alone, model, selection] =
      SearchEffects({solution.unknowns, VectorXd()}, &study);
  SetUnconfirmed(study, selection, model, &result);
  SetErrors(&study, &model, &alone);
  result.design_effect = DesignEffect(study, model);
  if (options.progress) options.progress("weighing rivals", -1);
  const auto rivals =
      SettleRivals(study, &model, &result.design_effect, &result.unlikely);
  result.findings = FindingsOf(study, model, rivals, result.design_effect);
  if (!options.compliance.empty()) {
    AddTold(options.compliance, result.design_effect, &study, &model,
            &result.findings);
  }
  result.gap = GapOf(study, alone, model);
  result.gap.file = Rms(solution.before);
  result.left_by_geometry = alone.estimate.linear.r;
  result.nu = study.nu;
  result.model = std::move(model);
  JudgeRemainder(study, &result);
  RefuseWhatDoesNotFollow(measured, &result);
  return result;
}

}  // namespace armcal
