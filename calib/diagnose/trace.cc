#include "calib/diagnose/trace.h"

#include <algorithm>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Samples of a spectrum: stretches that are held out are short.
constexpr int kSpectrumWindow = 128;

// Thinned samples x n of the segments' motions and torques.
struct Courses {
  MatrixXd tau, q, qd;
};

Courses CoursesOf(const GapRows& rows) {
  std::vector<MatrixXd> tau, q, qd;
  for (const GapSegment& segment : rows.segments()) {
    tau.push_back(segment.tau);
    q.push_back(segment.motion.q);
    qd.push_back(segment.motion.qd);
  }
  return {rows.ThinAll(tau), rows.PickAll(q), rows.PickAll(qd)};
}

using Flags = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>;

// Thinned samples x n: the joint moves there, or (`still`) rests.
Flags SamplesIn(const GapRows& rows, bool still) {
  Flags in = Flags::Constant(rows.num_thin(), rows.num_joints(), false);
  for (int j = 0; j < rows.num_joints(); ++j) {
    for (const GapRows::Run& run : still ? rows.still_runs(j) : rows.runs(j)) {
      in.col(j).segment(run.begin, run.size) = true;
    }
  }
  return in;
}

}  // namespace

std::vector<TorqueTrace> TraceHeldOut(const GapRows& rows,
                                      const HeldOut::Residuals& residuals,
                                      bool effects) {
  std::vector<TorqueTrace> traces;
  if (rows.segments().empty()) return traces;
  const int n = rows.num_joints(), models = effects ? 3 : 2;
  const int logs = rows.segments().back().log + 1;
  const Courses courses = CoursesOf(rows);
  const Flags moves = SamplesIn(rows, false), still = SamplesIn(rows, true);
  for (size_t i = 0; i < rows.segments().size(); ++i) {
    const int s = static_cast<int>(i), log = rows.segments()[i].log;
    if (traces.empty() || traces.back().log != log) {
      traces.emplace_back(log, n, models, MostTraceBins(logs, n, models),
                          rows.step(s), kSpectrumWindow);
    }
    traces.back().Break();
    for (int k = rows.thin_begin(s); k < rows.thin_begin(s + 1); ++k) {
      if (!moves.row(k).any() && !still.row(k).any()) {
        traces.back().Break();
        continue;
      }
      MatrixXd predicted = courses.tau.row(k).transpose().replicate(1, models);
      predicted.col(0) -= residuals.nominal.row(k);
      predicted.col(1) -= residuals.refit.row(k);
      if (effects) predicted.col(2) -= residuals.after.row(k);
      std::vector<bool> counts(n);
      for (int j = 0; j < n; ++j) counts[j] = moves(k, j);
      traces.back().Add(rows.thin_time(s, k), courses.tau.row(k), predicted,
                        courses.q.row(k), courses.qd.row(k), counts);
    }
  }
  return traces;
}

}  // namespace armcal
