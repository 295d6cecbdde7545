#include "calib/logs/sample_pass.h"

#include "calib/logs/sample_residuals.h"

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
    Stretch stretch{log, SeenOf(t), SampleResiduals(t, x_, &regressors[log])};
    const Stretch* const kept =
        stretches_.Add(&stretch, sizeof(Stretch) + BytesOf(stretch.trajectory) +
                                     stretch.residuals.size() * sizeof(double));
    visit(log, kept->trajectory, kept->residuals);
  });
  stretches_.End();
}

}  // namespace armcal
