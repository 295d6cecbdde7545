#include "calib/diagnose/select/reference.h"

#include <algorithm>
#include <cmath>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/data/data.h"
#include "calib/diagnose/data/motion_scale.h"
#include "calib/diagnose/data/noise.h"
#include "calib/diagnose/data/screen.h"
#include "calib/diagnose/select/chosen.h"
#include "calib/diagnose/select/selection.h"
#include "model/signals/delayed_signal.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Rounds of a fit and the noise that it leaves.
constexpr int kRounds = 3;
constexpr int kFolds = 3;
constexpr int kMostKnown = 10;
constexpr int kMostMoves = 8;
constexpr double kSettled = 1e-4;  // s

// Not what a log says of itself or of its day; nor what the baseline varies
// anyway; nor a law that a linear model cannot have.
bool CanBeInReference(const Effect& effect) {
  return effect.nature == Effect::Nature::kLaw && effect.proportional;
}

VectorXd Refit(const GapData& data) {
  GapScreen screen = data.Screen();
  screen.Factor();
  return screen.BaselineBeside(JointRows(data.rows().num_joints()));
}

// Residuals of joints that move; of others 0.
MatrixXd Moving(const GapRows& rows, const MatrixXd& residual) {
  MatrixXd moving = MatrixXd::Zero(residual.rows(), residual.cols());
  for (int j = 0; j < residual.cols(); ++j) {
    for (const int k : rows.SampleOfRow(j)) moving(k, j) = residual(k, j);
  }
  return moving;
}

// The baseline's values, joints weighted by what they leave. Weights of
// frequencies would trade what is large for what is quick: what a model lacks
// is no noise.
VectorXd FitWithNoise(GapData* data) {
  data->SetNoise(WhiteNoise(data->residual()));
  VectorXd x = Refit(*data);
  for (int round = 0; round < kRounds; ++round) {
    data->SetNoise(WhiteNoise(Moving(data->rows(), data->ResidualWith(x))));
    x = Refit(*data);
  }
  return x;
}

// Laws that explain what the baseline leaves, on the shapes of their grids;
// what they leave is the noise.
class LawSearch {
 public:
  LawSearch(const GapBaseline& baseline, GapData* data)
      : baseline_(baseline), data_(*data) {
    const MatrixXd left = data_.ResidualWith(FitWithNoise(&data_));
    scale_ = ScaleOf(baseline, data_.rows(), data_.torques());
    for (GapCandidate& candidate :
         ListCandidates(baseline, data_.rows(), scale_, left, {})) {
      if (CanBeInReference(*candidate.effect)) {
        candidates_.push_back(std::move(candidate));
      }
    }
    EvaluateCandidates(baseline, data_.rows(), scale_, data_.torques(),
                       &candidates_);
  }

  KnownEffects Run() {
    std::vector<int> chosen;
    GapScreen::Fit fit;
    for (int round = 0; round < kRounds; ++round) {
      GapScreen screen = data_.Screen();
      AddCandidates(data_.rows(), &candidates_, &screen);
      screen.Factor();
      SelectionOptions options;
      options.most_effects = kMostKnown;
      chosen = SelectEffects(screen, candidates_, options).chosen;
      fit = screen.Solve(ColumnsOf(candidates_, chosen));
      data_.SetNoise(
          ResidualNoise(data_.rows(), Left(screen, chosen, fit)).joints);
    }
    return {baseline_.robot(), Known(chosen, fit), scale_};
  }

 private:
  // Thinned samples x n, N m or N.
  MatrixXd Left(const GapScreen& screen, const std::vector<int>& chosen,
                const GapScreen::Fit& fit) const {
    MatrixXd left = data_.ResidualWith(screen.Baseline(fit));
    int at = 0;
    for (const int c : chosen) {
      for (const JointRows& torque : candidates_[c].torque) {
        const double size = fit.coefficients[at++];
        for (int j = 0; j < left.cols(); ++j) {
          if (torque[j].size() > 0) left.col(j) -= size * torque[j];
        }
      }
    }
    return left;
  }

  std::vector<KnownEffect> Known(const std::vector<int>& chosen,
                                 const GapScreen::Fit& fit) const {
    std::vector<KnownEffect> known;
    int at = 0;
    for (const int c : chosen) {
      const GapCandidate& law = candidates_[c];
      known.push_back({law.effect, law.joint, law.p});
      for (size_t k = 0; k < law.linear.size(); ++k) {
        known.back().p[law.linear[k]] = fit.coefficients[at++] * law.size[k];
      }
    }
    return known;
  }

  const GapBaseline& baseline_;
  GapData& data_;
  MotionScale scale_;
  std::vector<GapCandidate> candidates_;
};

// What the fit leaves, divided by how much more than the noise (of `rows`) it
// has to leave of samples that it has not seen, its parameters being uncertain.
MatrixXd Unforeseen(const GapData& data, const GapRows& rows) {
  GapScreen screen = data.Screen();
  screen.Factor();
  const JointRows none(data.rows().num_joints());
  MatrixXd left = data.ResidualWith(screen.BaselineBeside(none));
  const MatrixXd covariance = screen.BaselineCovariance();
  for (int j = 0; j < left.cols(); ++j) {
    const BaselineColumns& own = data.columns()[j];
    const VectorXd variance = (own.values * covariance(own.which, own.which))
                                  .cwiseProduct(own.values)
                                  .rowwise()
                                  .sum();
    for (int k = 0; k < left.rows(); ++k) {
      left(k, j) /= std::sqrt(1 + variance[k] / rows.variance(j, k));
    }
  }
  return left;
}

// Masks a third of each segment; its thinned samples.
std::vector<int> LeaveOut(const std::vector<GapSegment>& segments, int third,
                          GapData* data) {
  std::vector<int> left_out;
  for (size_t i = 0; i < segments.size(); ++i) {
    const Motion& motion = segments[i].motion;
    const double length = (motion.size() - 1) * motion.dt / kFolds;
    const TimeRange window = {motion.t0 + third * length,
                              motion.t0 + (third + 1) * length};
    data->Mask(segments[i].log, window);
    const GapRows& rows = data->rows();
    const int s = static_cast<int>(i);
    for (int k = rows.thin_begin(s); k < rows.thin_begin(s + 1); ++k) {
      if (window.Contains(rows.thin_time(s, k))) left_out.push_back(k);
    }
  }
  return left_out;
}

}  // namespace

GapNoise ReferenceNoise(const GapBaseline& baseline, double bandwidth_hz,
                        const std::vector<GapSegment>& segments) {
  GapData all(segments, baseline, bandwidth_hz);
  const MatrixXd seen = all.ResidualWith(FitWithNoise(&all));
  GapNoise noise = ResidualNoise(all.rows(), seen);
  all.SetNoise(noise.joints);
  const MatrixXd moving = Moving(all.rows(), seen);
  VectorXd grows = VectorXd::Ones(seen.cols());
  for (int third = 0; third < kFolds; ++third) {
    GapData others(all, LogPart::kAll);
    others.SetNoise(noise.joints);
    const std::vector<int> left_out = LeaveOut(segments, third, &others);
    others.SetNoise(noise.joints);
    const MatrixXd unseen = Moving(all.rows(), Unforeseen(others, all.rows()));
    for (int j = 0; j < grows.size(); ++j) {
      double before = 0, after = 0;
      for (const int k : left_out) {
        before += moving(k, j) * moving(k, j);
        after += unseen(k, j) * unseen(k, j);
      }
      if (before > 0) grows[j] = std::max(grows[j], std::sqrt(after / before));
    }
  }
  for (int j = 0; j < grows.size(); ++j) {
    noise.joints[j].sigma *= grows[j];
    // Motion may as well be as unlike these thirds as they are to each other.
    noise.doubt.push_back(grows[j] * grows[j] - 1);
  }
  return noise;
}

void AdvanceTorque(double delay, std::vector<GapSegment>* segments) {
  for (GapSegment& segment : *segments) {
    const double samples = -delay / segment.motion.dt;
    segment.tau = Delayed(segment.tau, samples);
    Eigen::MatrixXd& smooth = segment.motion.torque.tau;
    smooth = Delayed(smooth, samples);
  }
}

ReferenceModel FitReference(const GapBaseline& baseline, double bandwidth_hz,
                            std::vector<GapSegment>* segments) {
  ReferenceModel model{baseline};
  for (int round = 0; round < kMostMoves; ++round) {
    GapData data(*segments, model.baseline, bandwidth_hz);
    const VectorXd x = FitWithNoise(&data);
    const double late = model.baseline.DelayAt(x);
    AdvanceTorque(late, segments);
    model.delay += late;
    model.baseline = model.baseline.MovedTo(x);
    if (std::abs(late) < kSettled) break;
  }
  GapData data(*segments, model.baseline, bandwidth_hz);
  const KnownEffects laws = LawSearch(model.baseline, &data).Run();
  model.baseline.FreeDays();
  model.baseline.AddKnown(laws);
  return model;
}

}  // namespace armcal
