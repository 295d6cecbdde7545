#include "calib/diagnose/data/segments.h"

#include <algorithm>
#include <cmath>

#include "calib/diagnose/data/enough_motion.h"
#include "calib/diagnose/data/segment_rate.h"
#include "calib/diagnose/data/smooth_torque.h"
#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/data/torque_bursts.h"
#include "calib/linear/calibration_checks.h"
#include "calib/logs/position_noise.h"
#include "calib/numerics/append_rows.h"
#include "model/signals/low_pass.h"
#include "model/signals/position_spikes.h"
#include "model/signals/standstill.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Thermometers are noisy, and gears warm up in minutes.
constexpr double kSmoothTemperatureHz = .2;
// Of errors of stamps, which are known every second.
constexpr double kSmoothStampHz = .3;
constexpr double kMotionBandwidth = 5;  // of the torque's

void AppendCore(const Trajectory& trajectory, GapSegment* segment) {
  const int begin = trajectory.core_begin;
  const int rows = trajectory.core_end - begin;
  Motion& motion = segment->motion;
  if (motion.size() == 0) {
    motion.t0 = trajectory.time(begin);
    motion.dt = trajectory.dt;
  }
  AppendRows(trajectory.q.middleRows(begin, rows), &motion.q);
  AppendRows(trajectory.qd.middleRows(begin, rows), &motion.qd);
  AppendRows(trajectory.qdd.middleRows(begin, rows), &motion.qdd);
  AppendRows(trajectory.tau.middleRows(begin, rows), &segment->tau);
  AddCounts(trajectory.position_spikes, &segment->position_spikes);
  if (trajectory.temperature.size() == 0) return;
  AppendRows(trajectory.temperature.middleRows(begin, rows),
             &motion.temperature);
}

// Rows of x, of the times t (two or more), at the motion's samples:
// interpolated linearly between rows, and as the nearest beyond their ends.
// Both ascend, so that one index goes forwards.
MatrixXd AtSamples(const VectorXd& t, const MatrixXd& x, const Motion& motion) {
  MatrixXd at(motion.size(), x.cols());
  Eigen::Index k = 1;
  for (int row = 0; row < motion.size(); ++row) {
    const double now = motion.time(row);
    while (k + 1 < t.size() && t[k] < now) ++k;
    const double share =
        std::clamp((now - t[k - 1]) / (t[k] - t[k - 1]), 0., 1.);
    at.row(row) = x.row(k - 1) + share * (x.row(k) - x.row(k - 1));
  }
  return at;
}

// At the segment's samples, smooth.
VectorXd StampErrors(const std::vector<StampError>& errors,
                     const Motion& motion) {
  VectorXd t(errors.size()), error(errors.size());
  for (size_t k = 0; k < errors.size(); ++k) {
    t[static_cast<long>(k)] = errors[k].stamp;
    error[static_cast<long>(k)] = errors[k].error;
  }
  return ZeroPhaseLowPass(AtSamples(t, error, motion), 1 / motion.dt,
                          kSmoothStampHz);
}

// What makes a reconstructed torque wrong, low-passed as motion and torque are.
void AddErrors(const ReconstructedTorque& reconstructed, double bandwidth_hz,
               GapSegment* segment) {
  if (reconstructed.t.size() < 2) return;
  Motion& motion = segment->motion;
  const auto smooth = [&](const MatrixXd& x) {
    return ZeroPhaseLowPass(AtSamples(reconstructed.t, x, motion),
                            1 / motion.dt, MotionBandwidth(bandwidth_hz));
  };
  segment->position_noise = smooth(reconstructed.position_noise);
  segment->torque_noise = smooth(reconstructed.torque_noise);
  motion.torque_by_rate = smooth(reconstructed.by_rate);
}

// Joint by joint, on positions that are smooth already. Of a joint whose torque
// is 0 throughout, as it has no motor or none that is recorded, nothing is
// asked either, as of one that rests: its equation would be fitted best by
// links that weigh nothing.
void FindStillJoints(const MatrixXd& velocity, GapSegment* segment) {
  const Motion& motion = segment->motion;
  segment->still.resize(motion.size(), motion.num_joints());
  const int reach =
      static_cast<int>(std::ceil(kStandstillMeanTime / 2 / motion.dt));
  // Drives creep for a while when their command has come to rest: a torque that
  // was reconstructed from it is more certain than what friction is there.
  const double speed =
      segment->reconstructed_torque ? Limits().creep_speed : kStandstillSpeed;
  for (int j = 0; j < motion.num_joints(); ++j) {
    if (segment->tau.col(j).isZero(0)) {
      segment->still.col(j) = true;
      continue;
    }
    segment->still.col(j) =
        FindStandstill(velocity.col(j), motion.dt, reach, speed)
            .matrix()
            .array();
  }
}

// Joint by joint, once it is known where they stand still. A log that begins
// without motion began in a rest. Torques that were reconstructed from commands
// tell of friction by how far it keeps drives from these, which is most when a
// joint leaves a rest.
void FindBreakaway(const MatrixXd& velocity, GapSegment* segment) {
  const Motion& motion = segment->motion;
  segment->breaks_away.setConstant(motion.size(), motion.num_joints(), false);
  for (int j = 0; j < motion.num_joints(); ++j) {
    bool breaks_away = std::abs(velocity(0, j)) < kStandstillSpeed;
    double rest = motion.q(0, j);
    for (int k = 0; k < motion.size(); ++k) {
      if (segment->still(k, j)) {
        breaks_away = true;
        rest = motion.q(k, j);
        continue;
      }
      breaks_away &= std::abs(motion.q(k, j) - rest) < kPreslidingDisplacement;
      segment->breaks_away(k, j) = breaks_away;
    }
  }
}

}  // namespace

// Trajectories that a log yields, smoothed at kMotionBandwidth times the
// bandwidth and cut where rows are missing, with what the diagnosis has to know
// of them: where each joint stands still, where it breaks away from a rest,
// what makes a reconstructed torque wrong, and which times are not to be
// believed. Segments that are too short for one run have no part in it.
std::vector<GapSegment> ReadSegments(double bandwidth_hz,
                                     const Progress& progress,
                                     const LogSet& logs) {
  if (!(bandwidth_hz > 0)) {
    throw InputError("", OptionName("bandwidth"), NumberText(bandwidth_hz),
                     "expected a frequency above 0 Hz: torques are compared "
                     "below it");
  }
  CheckBandwidth(bandwidth_hz, logs);
  PreparationOptions prepared;
  prepared.bandwidth_hz = MotionBandwidth(bandwidth_hz);
  prepared.longest_gap_s = kGapPeriods / bandwidth_hz;
  prepared.friction_motion = false;
  std::vector<GapSegment> segments;
  int log = -1, part = -1;
  Prepare(logs, prepared)
      .ForEach("reading the logs", progress,
               [&](int index, const Trajectory& trajectory) {
                 if (index != log || trajectory.segment != part) {
                   segments.emplace_back();
                   segments.back().log = log = index;
                   if (const ReconstructedTorque* reconstructed =
                           logs.reconstructed_torque(index)) {
                     segments.back().reconstructed_torque = true;
                     segments.back().torque_drifts = reconstructed->drifts;
                     segments.back().lost = logs.time_bases()[index].gaps;
                   }
                   part = trajectory.segment;
                 }
                 AppendCore(trajectory, &segments.back());
               });
  const auto is_short = [](const GapSegment& segment) {
    return segment.size() * segment.motion.dt < kShortestSegment;
  };
  segments.erase(std::remove_if(segments.begin(), segments.end(), is_short),
                 segments.end());
  for (GapSegment& segment : segments) {
    const MatrixXd velocity = MeanVelocity(segment.motion.q, segment.motion.dt);
    FindStillJoints(velocity, &segment);
    if (!segment.reconstructed_torque) FindBreakaway(velocity, &segment);
    if (const ReconstructedTorque* reconstructed =
            logs.reconstructed_torque(segment.log)) {
      AddErrors(*reconstructed, bandwidth_hz, &segment);
    }
    for (const TimeRange& burst :
         TimesOf(FindTorqueBursts(segment, bandwidth_hz), bandwidth_hz)) {
      segment.lost.push_back(burst);
    }
    Motion& motion = segment.motion;
    motion.torque = SmoothTorqueOf(segment);
    const auto& errors = logs.time_bases()[segment.log].stamp_errors;
    if (errors.size() > 1) motion.stamp_error = StampErrors(errors, motion);
    if (motion.temperature.size() > 0) {
      motion.temperature =
          ZeroPhaseLowPass(motion.temperature, 1 / motion.dt,
                           kSmoothTemperatureHz, Ends::kExtrapolate);
    }
    DecimateSegment(MotionBandwidth(bandwidth_hz), &segment);
  }
  return segments;
}

void SetUsualTemperature(VectorXd* usual, std::vector<GapSegment>* segments) {
  for (GapSegment& segment : *segments) {
    Motion& motion = segment.motion;
    if (motion.temperature.size() == 0) continue;
    if (usual->size() == 0) *usual = motion.temperature.row(0);
    motion.usual_temperature = *usual;
  }
}

double ResolvedTime(double bandwidth_hz) {
  return 1 / (2 * M_PI * bandwidth_hz);
}

double MotionBandwidth(double bandwidth_hz) {
  return kMotionBandwidth * bandwidth_hz;
}

RecordedPositions AuditPositions(const Progress& progress, const LogSet& logs) {
  RecordedPositions recorded;
  Prepare(logs, {}).ForEach(
      "reading the logs", progress, [&](int, const Trajectory& trajectory) {
        if (recorded.noise.size() > 0 || trajectory.size() < 100) {
          return;
        }
        recorded.noise = PositionNoise(trajectory.q);
        recorded.rate_hz = 1 / trajectory.dt;
      });
  return recorded;
}

}  // namespace armcal
