#include "calib/diagnose/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "calib/diagnose/candidates/candidate_torques.h"
#include "calib/diagnose/candidates/law_share.h"
#include "calib/diagnose/data/enough_motion.h"
#include "calib/diagnose/data/motion_scale.h"
#include "calib/diagnose/data/segments.h"
#include "calib/diagnose/data/swung_joints.h"
#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/data/torque_bursts.h"
#include "calib/diagnose/freedom.h"
#include "calib/diagnose/impossible_terms.h"
#include "calib/diagnose/judge/claims.h"
#include "calib/diagnose/judge/given_up.h"
#include "calib/diagnose/judge/held_out.h"
#include "calib/diagnose/judge/where.h"
#include "calib/diagnose/select/fit.h"
#include "calib/diagnose/select/reference.h"
#include "calib/diagnose/trace.h"
#include "model/signals/bandwidth.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class Diagnoser {
 public:
  Diagnoser(const Robot& robot, const DiagnosisOptions& options,
            double bandwidth_hz)
      : robot_(robot), options_(options), bandwidth_hz_(bandwidth_hz) {}

  GapDiagnosis Run(const LogSet& training, const LogSet* validation,
                   const LogSet* reference);

 private:
  std::vector<GapSegment> Read(const LogSet& logs, bool must_move = true) {
    std::vector<GapSegment> segments =
        ReadSegments(bandwidth_hz_, options_.progress, logs);
    if (must_move || segments.empty())
      CheckMotion(segments, bandwidth_hz_, logs, sets_bandwidth_);
    SetUsualTemperature(&usual_temperature_, &segments);
    AdvanceTorque(delay_, &segments);
    return segments;
  }
  // How far the numbers of a robot, the file's or a fitted one, are trusted.
  BaselineOptions Trusted() const {
    BaselineOptions options = options_.baseline;
    options.trust = result_.trust;
    options.file = &robot_;
    options.posterior_deviations = posterior_deviations_;
    return options;
  }
  // Steps whose length depends on what is found.
  void Tell(const std::string& step) const {
    if (options_.progress) options_.progress(step, -1);
  }
  void FitBaseline(const MissingTerms& missing,
                   std::vector<GapSegment>* segments,
                   std::vector<GapSegment>* before);
  void FreeWhatIsContradicted(const Robot& file, MissingTerms* missing,
                              std::vector<GapSegment>* segments);
  void ForgetOtherFriction(MissingTerms* missing,
                           std::vector<GapSegment>* segments);
  // `evaluated`: candidates whose torques are known.
  void Fit(const std::vector<GapSegment>& segments,
           const std::vector<GapSegment>& before,
           std::vector<GapCandidate> evaluated = {});
  void KnowWhatModelsLack(const std::vector<GapSegment>& segments,
                          const std::vector<GapSegment>& before);
  GapFigures FiguresOf(const HeldOut::Residuals& residuals) const;
  bool ClaimNoMore(GapFindings* findings);
  void Draw();
  void Simulate(const LogSet& held_out, bool split);
  void Judge();

  const Robot& robot_;
  const DiagnosisOptions& options_;
  const double bandwidth_hz_;
  const LogSet* sets_bandwidth_ = nullptr;  // null: an option
  double posterior_deviations_ = 1;
  double delay_ = 0;            // of recorded torque, s, that was undone
  VectorXd usual_temperature_;  // deg C
  std::optional<GapBaseline> baseline_;
  std::optional<GapFit> fit_;
  std::optional<HeldOut> held_out_;
  bool found_without_name_ = false;  // GapFindings'
  std::vector<DataFinding> swung_;   // of the reference
  GapDiagnosis result_;
};

// The model and its freedom; a reference moves it to what that shows.
// Afterwards both kinds of segments have their torque as if it came without
// delay.
void Diagnoser::FitBaseline(const MissingTerms& missing,
                            std::vector<GapSegment>* segments,
                            std::vector<GapSegment>* before) {
  BaselineOptions trust = Trusted();
  for (const MissingTerm& term : missing.terms) {
    trust.missing_terms[term.joint_term] = term.usual;
  }
  // How late a log's torque is, a reference tells to first order in time.
  if (!before->empty()) trust.timing_s = ResolvedTime(bandwidth_hz_);
  if (HaveNoiseOfPositions(*segments)) {
    trust.reversal_s = ResolvedTime(MotionBandwidth(bandwidth_hz_));
  }
  // A reference is fitted on another day than a calibration was.
  trust.of_another_day = !before->empty();
  baseline_.emplace(missing.robot, trust, UsualTorque(*segments));
  if (before->empty() && trust.posterior != nullptr) baseline_->FreeDays();
  if (!before->empty()) {
    const ReferenceModel model =
        FitReference(*baseline_, bandwidth_hz_, before);
    baseline_ = model.baseline;
    delay_ = model.delay;
    AdvanceTorque(delay_, segments);
    // Numbered after the diagnosed ones: each log drifts for itself.
    const int logs = segments->back().log + 1;
    for (GapSegment& segment : *before) segment.log += logs;
  }
}

// Without a reference, which would tell: the effects are chosen again while
// they contradict what was assumed of the file (freedom.h), kMost times at
// most. The trust is raised once, with terms that are as the logs have them.
void Diagnoser::FreeWhatIsContradicted(const Robot& file, MissingTerms* missing,
                                       std::vector<GapSegment>* segments) {
  constexpr int kMost = 3;
  const double given = result_.trust;
  std::vector<GapSegment> none;
  for (int round = 0; round < kMost; ++round) {
    const bool given_up = GiveUpContradicted(*fit_, file, Trusted(),
                                             bandwidth_hz_, *segments, missing);
    bool again = given_up || HoldNegative(*fit_, missing);
    if (!given_up && options_.may_trust_less && result_.trust == given) {
      result_.trust *= LikeliestTrust(*fit_);
      again |= result_.trust > given;
    }
    if (options_.baseline.posterior != nullptr && posterior_deviations_ == 1) {
      posterior_deviations_ = LikeliestPosterior(*fit_);
      again |= posterior_deviations_ > 1;
    }
    if (!again) return;
    const Robot robot = baseline_->robot();
    const MotionScale scale = fit_->scale();
    std::vector<GapCandidate> evaluated = fit_->TakeEvaluated();
    fit_.reset();  // it refers to the baseline
    FitBaseline(*missing, segments, &none);
    Fit(*segments, none,
        WithSameTorques(robot, baseline_->robot(), scale,
                        std::move(evaluated)));
  }
}

// A reference whose friction or armature is nothing like that of the logs, on
// many joints at once, is of other drives or other torque sensors. It tells of
// the links then, and nothing else: its robot without these terms is what a
// file is. A calibration has its friction as well as a reference.
void Diagnoser::ForgetOtherFriction(MissingTerms* missing,
                                    std::vector<GapSegment>* segments) {
  if (result_.has_calibration) return;
  result_.not_of_reference = TermsOfOtherDrives(*fit_);
  if (result_.not_of_reference.empty()) return;
  result_.has_reference = false;
  const Robot links = baseline_->robot();
  result_.trust = options_.trust_in_links;
  const std::vector<JointTerm> all = {JointTerm::kViscous, JointTerm::kCoulomb,
                                      JointTerm::kArmature};
  *missing = FitWithout(all, links, Trusted(), bandwidth_hz_, *segments);
  std::vector<GapSegment> none;
  fit_.reset();  // it refers to the baseline
  FitBaseline(*missing, segments, &none);
  Fit(*segments, none);
  FreeWhatIsContradicted(links, missing, segments);
}

GapDiagnosis Diagnoser::Run(const LogSet& training, const LogSet* validation,
                            const LogSet* reference) {
  const bool split = validation == nullptr;
  if (!options_.bandwidth_hz) sets_bandwidth_ = &training;
  // What touches an arm that rests, a reference tells.
  std::vector<GapSegment> segments = Read(training, reference == nullptr);
  std::vector<GapSegment> before;
  if (reference != nullptr) {
    before = Read(*reference);
    swung_ = LeaveOutSwungJoints(robot_, *reference, &before);
  }
  Tell("fitting the baseline");
  result_.trust = options_.baseline.trust;
  MissingTerms missing =
      before.empty()
          ? FitMissingTerms(robot_, options_.baseline, bandwidth_hz_, segments)
          : FitTermsOfReference(robot_, options_.baseline, bandwidth_hz_,
                                before);
  FitBaseline(missing, &segments, &before);
  result_.has_reference = reference != nullptr;
  result_.has_calibration = options_.baseline.posterior != nullptr;
  result_.torque_constants_stddev = training.torque_constants_stddev();
  Tell("choosing effects");
  Fit(segments, before);
  if (before.empty()) {
    FreeWhatIsContradicted(robot_, &missing, &segments);
  } else {
    ForgetOtherFriction(&missing, &segments);
  }
  result_.ladder = missing;
  if (split) {
    held_out_.emplace(*fit_, options_.seed);
  } else {
    held_out_.emplace(*fit_, Read(*validation), options_.seed);
  }
  Tell("checking what was held out");
  result_.bandwidth_hz = bandwidth_hz_;
  result_.floor = fit_->noise().source;
  HeldOut::Residuals residuals = held_out_->AllResiduals();
  result_.torque = FiguresOf(residuals);
  for (int j = 0; j < robot_.num_joints(); ++j) {
    result_.joints.push_back(JointGapOf(robot_, *fit_, result_.torque, j));
  }
  SetBeyondReference(*fit_, &result_.joints);
  result_.unexplained = SumUnexplained(*fit_, result_.joints);
  GapFindings findings = ListFindings(
      robot_, *fit_, *held_out_, result_.torque,
      result_.has_reference ? std::vector<MissingTerm>() : missing.terms);
  if (ClaimNoMore(&findings)) residuals = held_out_->AllResiduals();
  SetRms(held_out_->RmsOf(residuals), &result_.joints);
  result_.effects = findings.effects;
  result_.unnamed = findings.unnamed;
  result_.candidates = findings.candidates;
  found_without_name_ = findings.without_name;
  result_.traces =
      TraceHeldOut(held_out_->rows(), residuals, !result_.effects.empty());
  Simulate(split ? training : *validation, split);
  result_.moved =
      ListMoved(*fit_, fit_->model_after(), result_.corrected.effects);
  result_.shown = ListShown(*fit_);
  result_.drifts = ListRunDrifts(*fit_, fit_->model_after());
  std::vector<FoundEffect> found = result_.effects;
  found.insert(found.end(), result_.unnamed.begin(), result_.unnamed.end());
  result_.untestable = ListUntestable(*fit_, found);
  Judge();
  return result_;
}

// Torques that are reconstructed from commands have noise of another kind,
// which is known.
void Diagnoser::KnowWhatModelsLack(const std::vector<GapSegment>& segments,
                                   const std::vector<GapSegment>& before) {
  if (HaveNoiseOfPositions(segments)) return;
  const GapRows rows(segments, bandwidth_hz_);
  const MotionScale scale =
      ScaleOf(*baseline_, rows, RecordedTorques(*baseline_, rows));
  baseline_->AddDiscrepancy(Discrepancy(
      robot_, scale, (before.empty() ? segments : before).back().log + 1,
      result_.torque_constants_stddev));
}

void Diagnoser::Fit(const std::vector<GapSegment>& segments,
                    const std::vector<GapSegment>& before,
                    std::vector<GapCandidate> evaluated) {
  KnowWhatModelsLack(segments, before);
  const GapFitOptions options{bandwidth_hz_, options_.selection,
                              options_.without};
  fit_.emplace(*baseline_, options, segments, before);
  fit_->Reuse(std::move(evaluated));
  fit_->Choose();
}

GapFigures Diagnoser::FiguresOf(const HeldOut::Residuals& residuals) const {
  return RemovedShareFigures(held_out_->SquaresOf(residuals),
                             ExtraVariance(fit_->noise().source) / 2,
                             options_.seed);
}

// Fits what is claimed again without what is not, so that every figure, file
// and drawing is of what the verdict names. What nothing explains was told
// before: what is fitted and not named has several explanations. Not claimed
// either is what no arm can have, what alone makes held-out data worse for
// certain, and what shrinks the gap little. Whether anything was left out.
bool Diagnoser::ClaimNoMore(GapFindings* findings) {
  bool is_another = false;
  do {
    if (FitClaimed(findings, &*fit_)) {
      is_another = true;
      held_out_->Follow();
      result_.torque = FiguresOf(held_out_->AllResiduals());
      SetClaimedShares(*fit_, *held_out_, result_.torque, &findings->effects);
    }
  } while (GiveUpImpossible(findings) ||
           GiveUpWorst(result_.torque, result_.has_reference, findings) ||
           GiveUpWhatDoesNotHelp(result_.torque, findings));
  LowerWhatDoesNotHelp(result_.torque, &findings->effects);
  return is_another;
}

void Diagnoser::Draw() {
  Tell("drawing robots");
  result_.draws =
      DrawCorrected(*fit_, PosteriorOf(*fit_), robot_, options_.samples);
  for (CorrectedRobot& robot : result_.draws.robots) robot.AddDelay(delay_);
}

// The held-out motion by the file's robot, the refitted one and the one with
// the effects, of one fold where a log is its own; events are not repeated.
void Diagnoser::Simulate(const LogSet& held_out, bool split) {
  const auto robot = [&](const VectorXd& x,
                         const std::vector<GapCandidate>& effects) {
    return MakeCorrectedRobot(*baseline_, x, effects, fit_->scale());
  };
  result_.corrected = robot(fit_->model_after(), fit_->refined().effects);
  SetLawShares(*baseline_, fit_->data(), &result_.corrected);
  // Segments have their torque as if it came without delay; logs have not.
  result_.corrected.AddDelay(delay_);
  if (options_.samples > 0) Draw();
  if (!options_.forward) return;
  const Predictor& model = held_out_->predictor_of_part();
  ForwardRobots robots = {robot(fit_->before(), {}),
                          robot(model.model_refit(), {}),
                          robot(model.model_after(), model.refined().effects)};
  CountedTimes counted;
  if (split) counted = TimesWithRows(held_out_->rows_of_part());
  if (options_.controller) {
    for (CorrectedRobot* each :
         {&robots.nominal, &robots.refit, &robots.after}) {
      each->delay += delay_;
    }
    Tell("simulating what was held out");
    result_.forward =
        ForwardGapInLoop(robots, robot_, *options_.controller,
                         options_.commanded, options_.seed, counted);
    return;
  }
  if (held_out_->segments().empty()) return;
  const RecordedPositions positions =
      AuditPositions(options_.progress, held_out);
  if (positions.noise.size() == 0) return;
  Tell("simulating what was held out");
  result_.forward = ForwardGapInWindows(
      robots, held_out_->segments(),
      {positions.noise, positions.rate_hz, MotionBandwidth(bandwidth_hz_),
       fit_->noise().joints, held_out_->rows().step(0)},
      options_.seed, counted);
}

void Diagnoser::Judge() {
  if (options_.wrong_readings) result_.data = options_.wrong_readings();
  const auto add = [&](std::vector<DataFinding> findings) {
    std::move(findings.begin(), findings.end(),
              std::back_inserter(result_.data));
  };
  add(AuditTorque(robot_, fit_->rows()));
  add(TellImpossibleTerms(result_.effects, result_.moved));
  const bool testable = AreDoubts(result_.data);
  add(swung_);
  if (!result_.torque.known()) {
    result_.data.push_back(TooShortToHoldOut(held_out_->rows()));
  }
  if (!result_.not_of_reference.empty()) {
    result_.data.push_back(OtherThanReference(result_.not_of_reference));
  }
  add(TellPositionSpikes(robot_, fit_->rows().segments()));
  add(TellTorqueBursts(robot_, fit_->rows().segments(), bandwidth_hz_));
  if (!testable) {
    result_.verdict = GapVerdict::kNotTestable;
    result_.effects.clear();
    result_.unnamed.clear();
    result_.candidates.clear();
    if (options_.samples > 0) {
      result_.draws = {{}, "these data cannot carry a diagnosis"};
    }
    return;
  }
  GapFacts facts;
  for (const JointGap& joint : result_.joints) facts.left += joint.unexplained;
  facts.torque = result_.torque;
  for (const FoundEffect& found : result_.effects) {
    facts.effects |= !found.of_another_day;
  }
  facts.found_without_name = found_without_name_;
  facts.since_reference = result_.has_reference;
  facts.left_share = result_.unexplained.share;
  result_.verdict = JudgeGap(facts);
  result_.only_held_out_left =
      IsLoudHeldOut(facts) && facts.left == 0 && !facts.found_without_name;
}

}  // namespace

GapDiagnosis DiagnoseGap(const Robot& robot, const DiagnosisOptions& options,
                         const LogSet& training, const LogSet* validation,
                         const LogSet* reference) {
  const double bandwidth_hz =
      options.bandwidth_hz.value_or(DiagnosisBandwidth(training.time_bases()));
  return Diagnoser(robot, options, bandwidth_hz)
      .Run(training, validation, reference);
}

}  // namespace armcal
