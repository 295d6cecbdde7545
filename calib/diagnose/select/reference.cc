#include "calib/diagnose/select/reference.h"

#include <cmath>

#include "calib/diagnose/data/data.h"
#include "calib/diagnose/select/reference_fit.h"
#include "calib/diagnose/select/reference_laws.h"
#include "model/signals/delayed_signal.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr int kMostMoves = 8;
constexpr double kSettled = 1e-4;  // s

}  // namespace

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
  const KnownEffects laws = FindReferenceLaws(model.baseline, *segments, &data);
  model.baseline.FreeDays();
  model.baseline.AddKnown(laws);
  return model;
}

}  // namespace armcal
