#include "calib/gap_diagnosis.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>

#include "calib/gap_data.h"
#include "calib/gap_refinement.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<Autoregression> WhiteNoise(const MatrixXd& residual) {
  std::vector<Autoregression> noise(residual.cols());
  for (int j = 0; j < residual.cols(); ++j) {
    noise[j].sigma =
        std::max(residual.col(j).norm() / std::sqrt(residual.rows()), 1e-12);
  }
  return noise;
}

VectorXd RefitBaseline(const GapData& data) {
  GapScreen screen(data.WhitenedColumns(), data.WhitenedResidual());
  screen.Factor();
  return screen.BaselineBeside(JointRows(data.rows().num_joints()));
}

// Noise of the training logs; where nothing else tells, of what a refit leaves.
GapNoise NoiseOf(GapData* data) {
  data->SetNoise(WhiteNoise(data->residual()));
  const VectorXd x = RefitBaseline(*data);
  return EstimateGapNoise(data->rows(), data->FineResidual(),
                          data->ResidualWith(x));
}

void AddReference(const GapData& before, GapScreen* screen) {
  const std::vector<MatrixXd> A = before.WhitenedColumns();
  const std::vector<VectorXd> y = before.WhitenedResidual();
  MatrixXd AtA = MatrixXd::Zero(A[0].cols(), A[0].cols());
  VectorXd Aty = VectorXd::Zero(A[0].cols());
  for (size_t j = 0; j < A.size(); ++j) {
    AtA += A[j].transpose() * A[j];
    Aty += A[j].transpose() * y[j];
  }
  screen->AddInformation(AtA, Aty);
}

// Whether joint j moves at each thinned sample.
std::vector<bool> Moves(const GapRows& rows, int j) {
  std::vector<bool> moves(rows.num_thin(), false);
  for (const int k : rows.SampleOfRow(j)) moves[k] = true;
  return moves;
}

MatrixXd Squares(const GapRows& rows, const MatrixXd& residual) {
  MatrixXd squares = residual.cwiseAbs2();
  for (int j = 0; j < residual.cols(); ++j) {
    const std::vector<bool> moves = Moves(rows, j);
    for (int k = 0; k < residual.rows(); ++k) {
      squares(k, j) /= rows.variance(j, k);
      if (!moves[k]) squares(k, j) = std::numeric_limits<double>::quiet_NaN();
    }
  }
  return squares;
}

class Diagnoser {
 public:
  Diagnoser(const Robot& robot, const DiagnosisOptions& options,
            LogSet* training, LogSet* validation, LogSet* reference)
      : robot_(robot), options_(options) {
    std::vector<GapSegment> segments =
        ReadSegments(options.bandwidth_hz, options.progress, training);
    baseline_.emplace(robot, options.baseline, UsualTorque(segments));
    split_ = validation == nullptr;
    if (split_) held_out_ = Data(segments, LogPart::kHeldOut);
    data_ = Data(segments, split_ ? LogPart::kFitted : LogPart::kAll);
    if (!split_) {
      held_out_ =
          Data(ReadSegments(options.bandwidth_hz, options.progress, validation),
               LogPart::kAll);
    }
    if (reference != nullptr) {
      reference_ =
          Data(ReadSegments(options.bandwidth_hz, options.progress, reference),
               LogPart::kAll);
    }
  }

  GapDiagnosis Run() {
    noise_ = NoiseOf(data_.get());
    data_->SetNoise(noise_.joints);
    held_out_->SetNoise(noise_.joints);
    result_.floor = noise_.source;
    result_.bandwidth_hz = options_.bandwidth_hz;
    scale_ = ScaleOf(*baseline_, data_->rows(), data_->torques());
    MakeScreen();
    Choose();
    Refine();
    Shrink();
    Where();
    Judge();
    return result_;
  }

 private:
  std::unique_ptr<GapData> Data(std::vector<GapSegment> segments,
                                LogPart part) const {
    return std::make_unique<GapData>(std::move(segments), *baseline_,
                                     options_.bandwidth_hz, part);
  }
  void MakeScreen();
  void Choose();
  void Refine();
  MatrixXd HeldOutWith(const std::vector<GapCandidate>& effects,
                       const VectorXd& baseline);
  MatrixXd HeldOutWithout(size_t k);
  EffectEvidence EvidenceFor(size_t k, const std::vector<PlacedEffect>& all);
  void Shrink();
  void Where();
  void Judge();
  FoundEffect Found(size_t k, const MatrixXd& covariance);

  const Robot& robot_;
  const DiagnosisOptions& options_;
  bool split_ = false;  // what is held out is of the same logs
  std::optional<GapBaseline> baseline_;
  std::unique_ptr<GapData> data_, held_out_, reference_;
  GapNoise noise_;
  MotionScale scale_;
  std::optional<GapScreen> screen_;
  std::vector<GapCandidate> candidates_;
  Selection selection_;
  RefinedEffects refined_;
  VectorXd refit_;
  GapDiagnosis result_;
};

void Diagnoser::MakeScreen() {
  screen_.emplace(data_->WhitenedColumns(), data_->WhitenedResidual());
  if (reference_) {
    reference_->SetNoise(noise_.joints);
    AddReference(*reference_, &*screen_);
  }
  GapScreen alone = *screen_;
  alone.Factor();
  refit_ = alone.BaselineBeside(JointRows(robot_.num_joints()));
  candidates_ = ListCandidates(*baseline_, data_->rows(), scale_,
                               data_->ResidualWith(refit_));
  for (GapCandidate& candidate : candidates_) {
    for (JointRows& rows : CandidateRows(candidate, *baseline_, data_->rows(),
                                         scale_, data_->mutable_torques())) {
      candidate.columns.push_back(screen_->AddColumn(std::move(rows)));
    }
  }
  screen_->Factor();
}

void Diagnoser::Choose() {
  selection_ = SelectEffects(*screen_, candidates_, options_.selection);
}

void Diagnoser::Refine() {
  std::vector<GapCandidate> chosen;
  const GapScreen::Fit fit =
      screen_->Solve(ColumnsOf(candidates_, selection_.chosen));
  int at = 0;
  for (const int c : selection_.chosen) {
    GapCandidate effect = candidates_[c];
    for (size_t l = 0; l < effect.linear.size(); ++l) {
      effect.p[effect.linear[l]] = fit.coefficients[at++] * effect.size[l];
    }
    chosen.push_back(effect);
  }
  refined_.effects = chosen;
  refined_.baseline = refit_;
  if (chosen.empty()) return;
  refined_ = RefineEffects(*screen_, *baseline_, scale_, chosen, data_.get());
}

// Standard deviations of the estimates by their derivatives at p.
std::vector<double> EstimateDeviations(const GapCandidate& effect,
                                       const EffectSite& site,
                                       const MatrixXd& covariance) {
  const std::vector<EffectEstimate> at =
      EstimatesOf(*effect.effect, site, effect.p);
  MatrixXd J(at.size(), effect.p.size());
  for (int k = 0; k < effect.p.size(); ++k) {
    VectorXd p = effect.p;
    const double step =
        1e-4 * std::max(std::sqrt(covariance(k, k)), 1e-6 * std::abs(p[k]));
    p[k] += step;
    const auto moved = EstimatesOf(*effect.effect, site, p);
    for (size_t i = 0; i < at.size(); ++i) {
      J(i, k) = step > 0 ? (moved[i].value - at[i].value) / step : 0;
    }
  }
  const VectorXd variance = (J * covariance * J.transpose()).diagonal();
  std::vector<double> stddev;
  for (const double v : variance) stddev.push_back(std::sqrt(std::max(v, 0.)));
  return stddev;
}

// Mean over samples and joints.
double MeanSquare(const MatrixXd& squares) {
  double sum = 0, count = 0;
  for (const double x : squares.reshaped()) {
    if (std::isnan(x)) continue;
    sum += x;
    count += 1;
  }
  return count > 0 ? sum / count : 1;
}

// The noise's variance is not known better than this.
double NoiseTolerance(NoiseFloor floor) {
  return floor == NoiseFloor::kRepeats ? .25 : .3;
}

// chi^2 beyond the noise that a fit leaves.
double ExcessOf(const GapScreen& screen, const GapScreen::Fit& fit,
                double tolerance) {
  double excess = 0;
  for (int j = 0; j < screen.num_joints(); ++j) {
    const VectorXd residual = screen.Residual(j, fit);
    excess += std::max(
        0., residual.squaredNorm() - (1 + tolerance) * residual.size());
  }
  return excess;
}

EffectEvidence Diagnoser::EvidenceFor(size_t k,
                                      const std::vector<PlacedEffect>& all) {
  constexpr double kMostOdds = 12;
  EffectEvidence evidence;
  const GapCandidate& effect = refined_.effects[k];
  double others = -1e300, own = -1e300;
  for (const PlacedEffect& other : all) {
    const bool same =
        other.effect == effect.effect && other.joint == effect.joint;
    (same ? own : others) = std::max(same ? own : others, other.score);
  }
  evidence.odds = std::clamp((own - others) / 8, -kMostOdds, kMostOdds);
  evidence.strength = std::log(std::max(1., selection_.drops[k]));
  double drops = 0;
  for (const double drop : selection_.drops) drops += drop;
  evidence.share = selection_.drops[k] / drops;
  evidence.chosen = static_cast<int>(selection_.drops.size());
  const GapScreen::Fit fit =
      screen_->Solve(ColumnsOf(candidates_, selection_.chosen));
  const double left = ExcessOf(*screen_, fit, NoiseTolerance(noise_.source));
  evidence.left = left / (left + fit.drop);
  const double refit = std::max(0., result_.torque.refit - 1);
  const double after = std::max(0., result_.torque.after - 1.1);
  evidence.held_out_left = after / std::max(.1, refit);
  evidence.next =
      std::max(0., ScoresBeside(*screen_, candidates_, options_.selection,
                                selection_.chosen, -1)
                       .maxCoeff());
  evidence.gain = MeanSquare(HeldOutWithout(k)) - result_.torque.after;
  return evidence;
}

FoundEffect Diagnoser::Found(size_t k, const MatrixXd& covariance) {
  const GapCandidate& effect = refined_.effects[k];
  const EffectSite site = {&robot_, effect.joint, &scale_};
  FoundEffect found;
  found.effect = effect.effect;
  found.joint = effect.joint;
  found.score = selection_.scores[k];
  found.drop = selection_.drops[k];
  found.p = effect.p;
  found.estimates = EstimatesOf(*effect.effect, site, effect.p);
  found.stddev = EstimateDeviations(effect, site, covariance);
  const std::vector<PlacedEffect> all =
      Alternatives(*screen_, candidates_, options_.selection, selection_.chosen,
                   static_cast<int>(k));
  for (const PlacedEffect& other : all) {
    if (other.effect == found.effect && other.joint == found.joint) {
      found.probability = other.probability;
    }
  }
  found.evidence = EvidenceFor(k, all);
  for (const PlacedEffect& other : CredibleSet(all)) {
    if (other.effect != found.effect || other.joint != found.joint) {
      found.equivalent.push_back(other);
    }
  }
  return found;
}

// Held-out squares with some of the effects, the baseline fitted beside them.
MatrixXd Diagnoser::HeldOutWith(const std::vector<GapCandidate>& effects,
                                const VectorXd& baseline) {
  MatrixXd residual = held_out_->ResidualWith(baseline);
  if (!effects.empty()) {
    residual -=
        EffectTorque(*baseline_, scale_, effects, !split_, held_out_.get());
  }
  return Squares(held_out_->rows(), residual);
}

MatrixXd Diagnoser::HeldOutWithout(size_t k) {
  std::vector<GapCandidate> others = refined_.effects;
  others.erase(others.begin() + k);
  JointRows torque(robot_.num_joints());
  if (!others.empty()) {
    const MatrixXd thin =
        EffectTorque(*baseline_, scale_, others, false, data_.get());
    for (int j = 0; j < thin.cols(); ++j) {
      torque[j] = data_->rows().Whiten(j, thin.col(j));
    }
  }
  return HeldOutWith(others, screen_->BaselineBeside(torque));
}

void Diagnoser::Shrink() {
  const GapRows& rows = held_out_->rows();
  HeldOutSquares squares;
  squares.nominal = Squares(rows, held_out_->residual());
  squares.refit = HeldOutWith({}, refit_);
  squares.after = HeldOutWith(refined_.effects, refined_.baseline);
  result_.torque = ShrinkFigures(squares, options_.seed);
  for (int j = 0; j < robot_.num_joints(); ++j) {
    const Joint& joint = robot_.links[j].joint;
    const double sigma = rows.noise(j).stddev();
    JointGap gap;
    gap.name = joint.name;
    gap.unit = EffortUnit(joint.type);
    if (result_.torque.joints.rows() > j) {
      gap.nominal_rms = sigma * result_.torque.joints(j, 0);
      gap.refit_rms = sigma * result_.torque.joints(j, 1);
      gap.after_rms = sigma * result_.torque.joints(j, 2);
    }
    gap.floor_rms = sigma;
    result_.joints.push_back(gap);
  }
}

void Diagnoser::Where() {
  const GapRows& rows = data_->rows();
  const GapScreen::Fit fit =
      screen_->Solve(ColumnsOf(candidates_, selection_.chosen));
  for (int j = 0; j < robot_.num_joints(); ++j) {
    const std::vector<int> samples = rows.SampleOfRow(j);
    const int size = static_cast<int>(samples.size());
    JointCourse course;
    course.residual = screen_->Residual(j, {});
    MatrixXd thin(rows.num_thin(), 5);
    for (size_t i = 0; i < rows.segments().size(); ++i) {
      const int s = static_cast<int>(i);
      const Motion& motion = rows.segments()[i].motion;
      MatrixXd fine(motion.size(), 5);
      fine << motion.q.col(j), motion.qd.col(j), motion.qdd.col(j),
          data_->torques()[i].load().col(j),
          VectorXd::LinSpaced(motion.size(), motion.time(0),
                              motion.time(motion.size() - 1));
      const MatrixXd part = rows.Pick(s, fine);
      thin.middleRows(rows.thin_begin(s), part.rows()) = part;
    }
    const MatrixXd at = thin(samples, Eigen::all);
    course.position = at.col(0);
    course.velocity = at.col(1);
    course.acceleration = at.col(2);
    course.load = at.col(3);
    course.time = at.col(4);
    JointGap& gap = result_.joints[j];
    gap.organised = OrganisedBy(course);
    if (size > 0) {
      gap.unexplained = screen_->Residual(j, fit).squaredNorm() / size - 1;
    }
  }
}

void Diagnoser::Judge() {
  std::vector<int> begin = {0};
  for (const GapCandidate& effect : refined_.effects) {
    begin.push_back(begin.back() + static_cast<int>(effect.p.size()));
  }
  for (size_t k = 0; k < refined_.effects.size(); ++k) {
    const int size = begin[k + 1] - begin[k];
    result_.effects.push_back(
        Found(k, refined_.covariance.block(begin[k], begin[k], size, size)));
  }
  for (size_t k = 0; k < result_.effects.size(); ++k) {
    const auto set =
        CredibleSet(Alternatives(*screen_, candidates_, options_.selection,
                                 selection_.chosen, static_cast<int>(k)));
    result_.candidates.insert(result_.candidates.end(), set.begin(), set.end());
  }
  result_.verdict = result_.effects.empty() ? GapVerdict::kNoiseFloor
                                            : GapVerdict::kExplained;
  if (std::getenv("GAP_DEBUG") != nullptr) {
    std::fprintf(stderr, "noise %s chi2/rows %.3f  rows %d candidates %zu\n",
                 NoiseFloorName(noise_.source),
                 screen_->chi_squared() / data_->rows().num_rows(),
                 data_->rows().num_rows(), candidates_.size());
    VectorXd scores =
        ScoresBeside(*screen_, candidates_, options_.selection, {}, -1);
    for (int k = 0; k < 12; ++k) {
      int best;
      const double score = scores.maxCoeff(&best);
      std::fprintf(stderr, "  %-24s S %.1f visible %.2e p",
                   candidates_[best].place().c_str(), score,
                   screen_->visible(candidates_[best].columns[0]));
      for (const double v : candidates_[best].p) {
        std::fprintf(stderr, " %.4g", v);
      }
      std::fprintf(stderr, "\n");
      scores[best] = -1e300;
    }
    for (const JointGap& gap : result_.joints) {
      std::fprintf(stderr,
                   "  %s nominal %.3g refit %.3g after %.3g floor %.3g by %s "
                   "%.0f left %.3f\n",
                   gap.name.c_str(), gap.nominal_rms, gap.refit_rms,
                   gap.after_rms, gap.floor_rms, gap.organised.by.c_str(),
                   gap.organised.excess, gap.unexplained);
    }
  }
}

}  // namespace

GapDiagnosis DiagnoseGap(const Robot& robot, const DiagnosisOptions& options,
                         LogSet* training, LogSet* validation,
                         LogSet* reference) {
  return Diagnoser(robot, options, training, validation, reference).Run();
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
