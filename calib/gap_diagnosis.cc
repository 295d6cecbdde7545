#include "calib/gap_diagnosis.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "calib/estimate_deviations.h"
#include "calib/gap_fit.h"
#include "calib/gap_held_out.h"
#include "calib/gap_reference.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Relative standard deviation of joint terms that were fitted, not given.
constexpr double kTrustInFitted = .5;
// Less probable effects are candidates, no more.
constexpr double kLeastClaimed = .3;
constexpr double kTimingWithReference = .05;  // s

class Diagnoser {
 public:
  Diagnoser(const Robot& robot, const DiagnosisOptions& options)
      : robot_(robot), options_(options) {}

  GapDiagnosis Run(LogSet* training, LogSet* validation, LogSet* reference);

 private:
  std::vector<GapSegment> Read(LogSet* logs, LogPart part,
                               bool must_move = true) const {
    if (logs == nullptr) return {};
    const double hz = options_.bandwidth_hz;
    std::vector<GapSegment> segments =
        ReadSegments(hz, options_.progress, logs);
    if (must_move) CheckMotion(segments, hz, part, *logs);
    AdvanceTorque(delay_, &segments);
    return segments;
  }
  FoundEffect Describe(const GapCandidate& effect,
                       const MatrixXd& covariance) const;
  FoundEffect Found(size_t k) const;
  FoundEffect Contacts() const;
  JointGap JointFigures(int joint) const;
  JointCourse CourseOf(int joint) const;
  void ListFamilies();
  void ListEffects();
  void ShareTheRest(FoundEffect* found);
  void Simulate(LogSet* held_out, bool split);
  void TellUnexplained();
  void Judge();

  const Robot& robot_;
  const DiagnosisOptions& options_;
  bool has_reference_ = false;
  double delay_ = 0;  // of recorded torque, s, that was undone
  // Something was found that no name is probable enough for.
  bool found_without_name_ = false;
  std::optional<GapBaseline> baseline_;
  std::optional<GapFit> fit_;
  std::optional<HeldOut> held_out_;
  GapDiagnosis result_;
};

GapDiagnosis Diagnoser::Run(LogSet* training, LogSet* validation,
                            LogSet* reference) {
  const bool split = validation == nullptr;
  // What touches an arm that rests, a reference tells.
  std::vector<GapSegment> segments =
      Read(training, split ? LogPart::kHeldOut : LogPart::kAll,
           reference == nullptr);
  std::vector<GapSegment> before = Read(reference, LogPart::kAll);
  const LackedFamilies lacked =
      FitLackedFamilies(robot_, options_.baseline, options_.bandwidth_hz,
                        before.empty() ? segments : before);
  BaselineOptions trust = options_.baseline;
  if (!lacked.families.empty()) trust.joint_trust = kTrustInFitted;
  // How late a log's torque is, a reference tells.
  if (!before.empty()) trust.timing_s = kTimingWithReference;
  baseline_.emplace(lacked.robot, trust, UsualTorque(segments));
  if (!before.empty()) {
    const ReferenceModel model =
        FitReference(*baseline_, options_.bandwidth_hz, &before);
    baseline_ = model.baseline;
    delay_ = model.delay;
    AdvanceTorque(delay_, &segments);
  }
  result_.ladder = lacked;
  has_reference_ = reference != nullptr;
  fit_.emplace(*baseline_,
               GapFitOptions{options_.bandwidth_hz, options_.selection,
                             options_.without},
               segments, split ? LogPart::kFitted : LogPart::kAll, before);
  fit_->Choose();
  held_out_.emplace(*fit_, split ? segments : Read(validation, LogPart::kAll),
                    split ? LogPart::kHeldOut : LogPart::kAll, !split);
  result_.bandwidth_hz = options_.bandwidth_hz;
  result_.floor = fit_->noise().source;
  result_.torque =
      ShrinkFigures(held_out_->AllSquares(),
                    VarianceDoubt(fit_->noise().source) / 2, options_.seed);
  for (int j = 0; j < robot_.num_joints(); ++j) {
    result_.joints.push_back(JointFigures(j));
  }
  ListEffects();
  Simulate(split ? training : validation, split);
  result_.moved = ListMoved(*fit_, fit_->refined().baseline);
  result_.shown = ListShown(*fit_, fit_->refined().baseline);
  result_.untestable = ListUntestable(*fit_);
  TellUnexplained();
  Judge();
  return result_;
}

JointGap Diagnoser::JointFigures(int j) const {
  const Joint& joint = robot_.links[j].joint;
  const double sigma = fit_->rows().noise(j).stddev();
  JointGap gap;
  gap.name = joint.name;
  gap.unit = EffortUnit(joint.type);
  gap.floor_rms = sigma;
  if (result_.torque.joints.rows() > j) {
    gap.nominal_rms = sigma * result_.torque.joints(j, 0);
    gap.refit_rms = sigma * result_.torque.joints(j, 1);
    gap.after_rms = sigma * result_.torque.joints(j, 2);
  }
  gap.organised = OrganisedBy(CourseOf(j));
  gap.unexplained = Excess(*fit_, j, true);
  // Without any order, it may be noise that is louder here than where it was
  // told: up to twice.
  const double rows = fit_->rows().num_rows(j);
  if (gap.organised.by.empty() && gap.unexplained < rows) gap.unexplained = 0;
  return gap;
}

JointCourse Diagnoser::CourseOf(int j) const {
  const GapRows& rows = fit_->rows();
  MatrixXd thin(rows.num_thin(), 5);
  for (size_t i = 0; i < rows.segments().size(); ++i) {
    const int s = static_cast<int>(i);
    const Motion& motion = rows.segments()[i].motion;
    MatrixXd fine(motion.size(), 5);
    fine << motion.q.col(j), motion.qd.col(j), motion.qdd.col(j),
        fit_->data()->torques()[i].load().col(j),
        VectorXd::LinSpaced(motion.size(), motion.time(0),
                            motion.time(motion.size() - 1));
    const MatrixXd part = rows.Pick(s, fine);
    thin.middleRows(rows.thin_begin(s), part.rows()) = part;
  }
  const MatrixXd at = thin(rows.SampleOfRow(j), Eigen::all);
  return {fit_->screen().Residual(j, {}),
          at.col(0),
          at.col(1),
          at.col(2),
          at.col(3),
          at.col(4)};
}

FoundEffect Diagnoser::Describe(const GapCandidate& effect,
                                const MatrixXd& covariance) const {
  const EffectSite site = {&robot_, effect.joint, &fit_->scale()};
  FoundEffect found;
  found.effect = effect.effect;
  found.joint = effect.joint;
  found.p = effect.p;
  found.estimates = EstimatesOf(*effect.effect, site, effect.p);
  found.stddev = EstimateDeviations(*effect.effect, site, effect.p, covariance);
  return found;
}

FoundEffect Diagnoser::Found(size_t k) const {
  const RefinedEffects& refined = fit_->refined();
  const GapCandidate& effect = refined.effects[k];
  Eigen::Index begin = 0;
  for (size_t i = 0; i < k; ++i) begin += refined.effects[i].p.size();
  FoundEffect found = Describe(
      effect,
      refined.covariance.block(begin, begin, effect.p.size(), effect.p.size()));
  found.score = fit_->selection().scores[k];
  found.drop = fit_->selection().drops[k];
  const std::vector<PlacedEffect> all = Alternatives(*fit_, k);
  for (const PlacedEffect& other : CredibleSet(all)) {
    if (other.effect != found.effect || other.joint != found.joint) {
      found.equivalent.push_back(other);
    }
  }
  found.evidence = EvidenceFor(*fit_, *held_out_, result_.torque, k, all);
  found.probability = ProbabilityOf(found.evidence);
  found.removed_percent =
      100 * found.evidence.gain / std::max(.1, result_.torque.refit - 1);
  found.ci95[0] = found.ci95[1] = std::numeric_limits<double>::quiet_NaN();
  if (refined.effects.size() == 1) {
    found.removed_percent = result_.torque.removed_percent;
    std::copy(result_.torque.ci95, result_.torque.ci95 + 2, found.ci95);
  }
  found.separate_by = found.equivalent.empty() ? "" : found.effect->experiment;
  return found;
}

// All windows in which the arm was touched, as one effect: the strongest's
// estimates.
FoundEffect Diagnoser::Contacts() const {
  const std::vector<GapEvent>& events = fit_->events();
  const GapEvent& strongest = *std::max_element(
      events.begin(), events.end(),
      [](const GapEvent& a, const GapEvent& b) { return a.drop < b.drop; });
  FoundEffect found;
  if (strongest.fitted) {
    found = Describe(strongest.fitted->effect, strongest.fitted->covariance);
  } else {
    found.effect = FindEffect("external_contact");
    found.estimates =
        ContactEstimates(robot_, strongest.contact, &found.stddev);
  }
  found.score = strongest.score;
  found.evidence = EvidenceForEvents(*fit_, result_.torque);
  found.probability = ProbabilityOf(found.evidence);
  for (const GapEvent& event : events) {
    found.drop += event.drop;
    found.contacts.push_back(event.contact);
    if (event.beyond_friction) found.probability = 1 - kFalseContacts;
  }
  return found;
}

// What the file gives no joint at all, as one effect each; with a reference
// that is nothing new.
void Diagnoser::ListFamilies() {
  for (const LackedFamily& family : result_.ladder.families) {
    FoundEffect found;
    found.effect = family.effect;
    found.probability = 1;
    found.score = found.drop = family.drop;
    for (int j = 0; j < robot_.num_joints(); ++j) {
      const Joint& joint = robot_.links[j].joint;
      if (family.value[j] == 0) continue;
      found.estimates.push_back({joint.name + "." + JointTermName(family.term),
                                 JointTermUnit(family.term, joint.type),
                                 family.value[j]});
      found.stddev.push_back(family.stddev[j]);
    }
    result_.effects.push_back(found);
  }
}

void Diagnoser::ListEffects() {
  if (!has_reference_) ListFamilies();
  if (!fit_->events().empty()) result_.effects.push_back(Contacts());
  for (size_t k = 0; k < fit_->refined().effects.size(); ++k) {
    result_.effects.push_back(Found(k));
  }
  std::stable_sort(result_.effects.begin(), result_.effects.end(),
                   [](const FoundEffect& a, const FoundEffect& b) {
                     return a.drop > b.drop;
                   });
  for (FoundEffect& found : result_.effects) ShareTheRest(&found);
  const auto unclaimed =
      std::stable_partition(result_.effects.begin(), result_.effects.end(),
                            [](const FoundEffect& found) {
                              return found.probability >= kLeastClaimed;
                            });
  found_without_name_ =
      unclaimed == result_.effects.begin() && !result_.effects.empty();
  result_.effects.erase(unclaimed, result_.effects.end());
}

// The probability that an effect does not have is that of all others together;
// the set of candidates ends where 95 % are in it.
void Diagnoser::ShareTheRest(FoundEffect* found) {
  constexpr double kCredible = .95;
  double others = 0;
  for (const PlacedEffect& other : found->equivalent) {
    others += other.probability;
  }
  result_.candidates.push_back(
      {found->effect, found->joint, found->probability, found->score});
  double sum = found->probability;
  for (PlacedEffect& other : found->equivalent) {
    other.probability *= (1 - found->probability) / std::max(1e-9, others);
    if (sum < kCredible) result_.candidates.push_back(other);
    sum += other.probability;
  }
}

// The held-out motion by the file's robot, the refitted one and the one with
// the effects; events are not repeated.
void Diagnoser::Simulate(LogSet* held_out, bool split) {
  const RefinedEffects& refined = fit_->refined();
  const auto robot = [&](const VectorXd& x,
                         const std::vector<GapCandidate>& effects) {
    return MakeCorrectedRobot(*baseline_, x, effects, fit_->scale());
  };
  ForwardRobots robots = {robot(fit_->before(), {}), robot(fit_->refit(), {}),
                          robot(refined.baseline, refined.effects)};
  result_.corrected = robots.after;
  // Segments have their torque as if it came without delay; logs have not.
  result_.corrected.delay += delay_;
  if (!options_.forward) return;
  CountedTimes counted;
  if (split) counted = TimesWithRows(held_out_->rows());
  if (options_.controller) {
    for (CorrectedRobot* each :
         {&robots.nominal, &robots.refit, &robots.after}) {
      each->delay += delay_;
    }
    result_.forward =
        ForwardGapInLoop(robots, robot_, *options_.controller,
                         options_.commanded, options_.seed, counted);
    return;
  }
  if (held_out_->segments().empty()) return;
  const RecordedPositions positions =
      AuditPositions(options_.progress, held_out);
  if (positions.noise.size() == 0) return;
  result_.forward =
      ForwardGapInWindows(robots, held_out_->segments(),
                          {positions.noise, positions.rate_hz,
                           MotionBandwidth(options_.bandwidth_hz),
                           fit_->noise().joints, held_out_->rows().step(0)},
                          options_.seed, counted);
}

// What no effect explains, in sample: its share of what a refit leaves beyond
// the noise, and the joint that holds most of it.
void Diagnoser::TellUnexplained() {
  double left = 0, most = 0, refit = 0;
  for (int j = 0; j < robot_.num_joints(); ++j) {
    const double here = result_.joints[j].unexplained;
    left += here;
    refit += Excess(*fit_, j, false);
    if (here <= most) continue;
    most = here;
    result_.unexplained.joint = result_.joints[j].name;
    result_.unexplained.organised_by = result_.joints[j].organised.by;
  }
  result_.unexplained.share = left / std::max(1., std::max(left, refit));
}

void Diagnoser::Judge() {
  result_.data = AuditTorque(robot_, fit_->rows());
  if (!result_.data.empty()) {
    result_.verdict = GapVerdict::kNotTestable;
    result_.effects.clear();
    result_.candidates.clear();
    return;
  }
  constexpr double kReal = 100;        // chi^2 that is not chance
  constexpr double kUnexplained = .3;  // of what could be removed
  double left = 0;
  for (const JointGap& joint : result_.joints) left += joint.unexplained;
  const bool much_left =
      left > kReal && result_.unexplained.share > kUnexplained;
  // On what was held out, too.
  const double after = result_.torque.after - 1;
  const double nominal = result_.torque.nominal - 1;
  const double refit = result_.torque.refit - 1;
  if (!result_.effects.empty()) {
    const bool held_out_left =
        after > kUnexplained && after > kUnexplained * refit;
    result_.verdict = much_left || held_out_left ? GapVerdict::kPartlyExplained
                                                 : GapVerdict::kExplained;
  } else if (much_left || found_without_name_) {
    result_.verdict = GapVerdict::kUnknown;
  } else {
    result_.verdict = nominal > .3 && refit < .5 * nominal
                          ? GapVerdict::kAbsorbed
                          : GapVerdict::kNoiseFloor;
  }
}

}  // namespace

GapDiagnosis DiagnoseGap(const Robot& robot, const DiagnosisOptions& options,
                         LogSet* training, LogSet* validation,
                         LogSet* reference) {
  return Diagnoser(robot, options).Run(training, validation, reference);
}

double DiagnosisBandwidth(const std::vector<TimeBase>& time_bases) {
  constexpr double kLeast = 10, kShareOfRate = .125;
  double hz = std::max(kLeast, DefaultBandwidth(time_bases));
  for (const TimeBase& base : time_bases) {
    hz = std::min(hz, kShareOfRate / base.dt);
  }
  return hz;
}

const char* GapVerdictName(GapVerdict verdict) {
  switch (verdict) {
    case GapVerdict::kNoiseFloor:
      return "noise_floor";
    case GapVerdict::kAbsorbed:
      return "absorbed";
    case GapVerdict::kExplained:
      return "explained";
    case GapVerdict::kPartlyExplained:
      return "partly_explained";
    case GapVerdict::kUnknown:
      return "unknown";
    case GapVerdict::kNotTestable:
      return "not_testable";
  }
  return "";
}

}  // namespace armcal
