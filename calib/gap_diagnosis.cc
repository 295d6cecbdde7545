#include "calib/gap_diagnosis.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "calib/gap_data.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Clock {
  std::chrono::steady_clock::time_point begin =
      std::chrono::steady_clock::now();
  void Say(const char* what) {
    if (!std::getenv("GAP_DEBUG")) return;
    std::fprintf(
        stderr, "%-20s %.2f s\n", what,
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin)
            .count());
  }
};

std::vector<Autoregression> White(int n, const MatrixXd& residual) {
  std::vector<Autoregression> noise(n);
  for (int j = 0; j < n; ++j) {
    noise[j].sigma =
        std::max(residual.col(j).norm() / std::sqrt(residual.rows()), 1e-12);
  }
  return noise;
}

VectorXd RefitBaseline(const GapData& data) {
  GapScreen screen(data.WhitenedColumns(), data.WhitenedResidual());
  screen.Factor();
  return screen.Baseline({});
}

}  // namespace

GapDiagnosis DiagnoseGap(const Robot& robot, const DiagnosisOptions& options,
                         LogSet* training, LogSet* /*validation*/,
                         LogSet* reference) {
  Clock clock;
  std::vector<GapSegment> segments = ReadSegments(options.progress, training);
  const GapBaseline baseline(robot, options.baseline, UsualTorque(segments));
  GapData data(std::move(segments), baseline, options.bandwidth_hz);
  clock.Say("data");
  const int n = robot.num_joints();
  // A first refit for what noise it leaves where nothing else tells.
  data.SetNoise(White(n, data.residual()));
  VectorXd x = RefitBaseline(data);
  GapNoise noise =
      EstimateGapNoise(data.rows(), data.residual(), data.ResidualWith(x));
  data.SetNoise(noise.joints);
  x = RefitBaseline(data);
  clock.Say("noise");
  const MotionScale scale = ScaleOf(baseline, data.rows(), data.torques());
  std::vector<GapCandidate> candidates =
      ListCandidates(baseline, data.rows(), scale, data.ResidualWith(x));
  clock.Say("candidates");
  GapScreen screen(data.WhitenedColumns(), data.WhitenedResidual());
  if (reference != nullptr) {
    GapData before(ReadSegments(options.progress, reference), baseline,
                   options.bandwidth_hz);
    before.SetNoise(noise.joints);
    const auto A = before.WhitenedColumns();
    const auto y = before.WhitenedResidual();
    MatrixXd AtA = MatrixXd::Zero(baseline.size(), baseline.size());
    VectorXd Aty = VectorXd::Zero(baseline.size());
    for (int j = 0; j < n; ++j) {
      AtA += A[j].transpose() * A[j];
      Aty += A[j].transpose() * y[j];
    }
    screen.AddInformation(AtA, Aty);
  }
  for (GapCandidate& candidate : candidates) {
    for (JointRows& rows : CandidateRows(candidate, baseline, data.rows(),
                                         scale, data.mutable_torques())) {
      candidate.columns.push_back(screen.AddColumn(std::move(rows)));
    }
  }
  clock.Say("columns");
  screen.Factor();
  clock.Say("factor");
  const Selection selection =
      SelectEffects(screen, candidates, options.selection);
  clock.Say("selection");
  if (std::getenv("GAP_DEBUG")) {
    std::fprintf(stderr, "noise %s chi2/rows %.3f  rows %d candidates %zu\n",
                 NoiseFloorName(noise.source),
                 screen.chi_squared() / data.rows().num_rows(),
                 data.rows().num_rows(), candidates.size());
    VectorXd scores =
        ScoresBeside(screen, candidates, options.selection, {}, -1);
    for (int k = 0; k < 12; ++k) {
      int best;
      const double score = scores.maxCoeff(&best);
      std::fprintf(stderr, "  %-24s S %.1f visible %.2e p",
                   candidates[best].place().c_str(), score,
                   screen.visible(candidates[best].columns[0]));
      for (const double v : candidates[best].p)
        std::fprintf(stderr, " %.4g", v);
      std::fprintf(stderr, "\n");
      scores[best] = -1e300;
    }
    const GapScreen::Fit fit =
        screen.Solve(ColumnsOf(candidates, selection.chosen));
    for (int j = 0; j < n; ++j) {
      const VectorXd r0 = screen.Residual(j, {}), r1 = screen.Residual(j, fit);
      std::fprintf(stderr, "  joint %d: refit %.3f after %.3f\n", j + 1,
                   r0.squaredNorm() / r0.size(), r1.squaredNorm() / r1.size());
    }
  }
  GapDiagnosis diagnosis;
  diagnosis.floor = noise.source;
  const GapScreen::Fit fit =
      screen.Solve(ColumnsOf(candidates, selection.chosen));
  int at = 0;
  for (size_t k = 0; k < selection.chosen.size(); ++k) {
    const GapCandidate& candidate = candidates[selection.chosen[k]];
    DiagnosedEffect found;
    found.effect = candidate.effect;
    found.joint = candidate.joint;
    found.score = selection.scores[k];
    found.drop = selection.drops[k];
    found.p = candidate.p;
    for (size_t l = 0; l < candidate.linear.size(); ++l) {
      found.p[candidate.linear[l]] = fit.coefficients[at++] * candidate.size[l];
    }
    found.estimates = EstimatesOf(*candidate.effect,
                                  {&robot, candidate.joint, &scale}, found.p);
    diagnosis.effects.push_back(found);
  }
  return diagnosis;
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
