#include "calib/poses/reading_audit.h"

#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "calib/numerics/median.h"
#include "calib/poses/follow.h"
#include "calib/poses/identifiability.h"
#include "calib/poses/pose_readings.h"
#include "calib/poses/some_poses.h"
#include "calib/poses/start.h"
#include "model/text/format.h"
#include "model/text/option_error.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

// As many as tell a factor of 57 from 1.
constexpr int kEnoughPoses = 60;
// Of what is left as read: more than nine tenths of it go with another reading.
// The frame has 6 unknowns and the targets 3 each, of which none makes up for a
// factor of joint positions or of all lengths, nor for a sign. Both readings
// have as many unknowns, so that with errors of standard deviation s twice the
// logarithm of the Bayes factor is at least N log(10^2) = 4.6 N for N poses,
// each counted as one error: with 8 poses and 50 readings that are tried (2 log
// 50 = 8) it is 29, where 10 are very strong (Kass and Raftery 1995).
constexpr double kTinyPart = 0.1;
// A step that lowers the squares by less than this was the last: distances then
// fall by half of it, where a factor of ten is asked for. In wrong units fits
// may creep for ever.
constexpr double kLastFall = 1e-3;

// Median distance as a share of the poses' extent, which has their unit, with
// the file's geometry but for the zeros of `joints`; of whole poses with the
// median angle in radians, which is the extent of rotations: of random ones the
// mean is pi / 2 + 2 / pi. Infinite where there is no fit. One fit from the
// start values: gross errors do not hide another reading, and the median is not
// theirs.
double GeometryLeaves(const Robot& robot, const PoseMeasurements& measured,
                      const std::vector<int>& joints) {
  PoseCalibrationOptions options;
  options.refine = RefineGeometry::kNothing;
  options.loss = RobustLoss::kSquared;
  options.prior_angle = M_PI;  // a zero may be anywhere
  PoseFit fit(robot, measured, options);
  const std::vector<int> rows = fit.AllRows();
  PoseUnknowns at = StartPoses(fit.geometry(), measured);
  std::vector<bool> wanted = fit.Wanted(options.refine);
  for (const int joint : joints) {
    const int zero = fit.geometry().ZeroOf(joint);
    if (zero >= 0) wanted[zero] = true;
  }
  const std::vector<bool> free = HoldUnseen(fit, wanted, rows, at, nullptr);
  if (!fit.WhyTooFew(free).empty() ||
      !fit.Solve(free, rows, options.loss, &at, kLastFall)) {
    return std::numeric_limits<double>::infinity();
  }
  const double share = Median(fit.Distances(rows, at)) / PoseExtent(measured);
  if (measured.poses.size() == 0) return share;
  std::vector<double> angles;
  for (const auto& w : RotationErrors(fit.geometry(), measured, at).rowwise()) {
    angles.push_back(w.norm());
  }
  return std::hypot(share, Median(angles));
}

struct TriedReading {
  const PoseReading* reading;
  double left, as_read;
};

// All that leave a tenth of what the poses as read leave, and no reading a
// tenth of what they leave: where two are as good as that, the poses do not
// tell which it is.
std::vector<TriedReading> Likely(const Robot& robot,
                                 const PoseMeasurements& measured,
                                 const std::vector<PoseReading>& readings) {
  std::map<std::vector<int>, double> as_read;
  const auto left_as_read = [&](const std::vector<int>& joints) {
    const auto known = as_read.find(joints);
    if (known != as_read.end()) return known->second;
    return as_read[joints] = GeometryLeaves(robot, measured, joints);
  };
  std::vector<TriedReading> tried;
  double least = std::numeric_limits<double>::infinity();
  if (!std::isfinite(left_as_read({}))) return tried;
  for (const PoseReading& reading : readings) {
    PoseMeasurements other = measured;
    reading.apply(&other);
    const double left = GeometryLeaves(robot, other, reading.joints);
    if (!FollowsJoints(left, 1)) continue;
    const double before = left_as_read(reading.joints);
    if (!(left < kTinyPart * before)) continue;
    tried.push_back({&reading, left, before});
    least = std::min(least, left);
  }
  std::vector<TriedReading> likely;
  for (const TriedReading& one : tried) {
    if (kTinyPart * one.left <= least) likely.push_back(one);
  }
  return likely;
}

}  // namespace

std::string WrongReading(const Robot& robot, const PoseMeasurements& measured,
                         TurnedJoints turned) {
  // Tilts and touched points have no extent in metres.
  if (measured.tilts.size() > 0 || !measured.touched.empty()) return "";
  const PoseMeasurements some = SomePoses(measured, kEnoughPoses);
  const std::vector<PoseReading> readings = PoseReadings(robot, some);
  const std::vector<TriedReading> likely = Likely(robot, some, readings);
  std::string text;
  for (const TriedReading& one : likely) {
    if (turned == TurnedJoints::kAreFindings &&
        one.reading->turns_joint_round) {
      return "";
    }
    text += (text.empty() ? "" : "; or ") + one.reading->meant +
            Format(
                " (the file's geometry is then %.3g %% of the poses' extent "
                "away from them, as read %.3g %%)",
                100 * one.left, 100 * one.as_read);
  }
  return text;
}

void RequireReading(const Robot& robot, const PoseMeasurements& measured,
                    const char* option, TurnedJoints turned) {
  const std::string wrong = WrongReading(robot, measured, turned);
  if (!wrong.empty()) throw OptionError(OptionName(option) + ": " + wrong);
}

}  // namespace armcal
