#include "calib/logs/sample_pass.h"

#include <algorithm>

namespace armcal {

namespace {

// What visits see of a trajectory.
Trajectory SeenOf(const Trajectory& t) {
  Trajectory seen;
  seen.t0 = t.t0;
  seen.dt = t.dt;
  seen.q = t.q;
  seen.standstill = t.standstill;
  seen.samples = t.samples;
  seen.segment = t.segment;
  seen.first_index = t.first_index;
  seen.core_begin = t.core_begin;
  seen.core_end = t.core_end;
  return seen;
}

}  // namespace

SamplePass::SamplePass(const ModelParameters& parameters,
                       const Eigen::VectorXd& x, const Progress& progress,
                       const PreparedLogs& logs)
    : parameters_(parameters),
      x_(x),
      progress_(progress),
      logs_(logs),
      stretches_(logs.logs().memory()) {}

// A signal that is low-passed at f rises from 10 to 90 % of a step in about
// 0.35 / f (of one pole: ln 9 / (2 pi f)), and half of that is on either side
// of the step. What friction changes sign with is low-passed at the friction
// band's frequencies.
double SamplePass::turn_reach() const {
  constexpr double kRise = .35;
  const auto& band = logs_.friction();
  return band ? kRise / 2 / std::min(band->position_hz, band->velocity_hz) : 0;
}

void SamplePass::Run(const std::string& stage, const Visit& visit) {
  if (stretches_.whole()) {
    for (const Stretch& s : stretches_.items()) {
      visit(s.log, s.trajectory, s.residuals);
    }
    if (progress_) progress_(stage, 1);
    return;
  }
  stretches_.Begin();
  std::vector<MotionRegressor> regressors(logs_.size(),
                                          MotionRegressor(parameters_));
  logs_.ForEachAtFullRate(stage, progress_, [&](int log, const Trajectory& t) {
    Stretch stretch{log, SeenOf(t), EvaluateSamples(t, x_, &regressors[log])};
    const Stretch* const kept =
        stretches_.Add(&stretch, sizeof(Stretch) + BytesOf(stretch.trajectory) +
                                     (stretch.residuals.residual.size() +
                                      stretch.residuals.coulomb.size()) *
                                         sizeof(double));
    visit(log, kept->trajectory, kept->residuals);
  });
  stretches_.End();
}

}  // namespace armcal
