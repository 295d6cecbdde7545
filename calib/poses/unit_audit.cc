#include "calib/poses/unit_audit.h"

#include <cmath>
#include <limits>
#include <vector>

#include "calib/numerics/median.h"
#include "calib/poses/follow.h"
#include "calib/poses/identifiability.h"
#include "calib/poses/some_poses.h"
#include "calib/poses/start.h"
#include "model/text/format.h"
#include "model/text/option_error.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

// As many as tell a factor of 57 from 1.
constexpr int kEnoughPoses = 60;
// Of what is left in the units as read: more than nine tenths of it go with the
// units. The frame has 6 unknowns and the targets 3 each, of which none makes
// up for a factor of joint positions or of all lengths.
constexpr double kTinyPart = 0.1;
// A step that lowers the squares by less than this was the last: distances then
// fall by half of it, where a factor of ten is asked for. In wrong units fits
// may creep for ever.
constexpr double kLastFall = 1e-3;
constexpr double kDegree = M_PI / 180;

// What numbers are times those that were read.
struct ReadUnits {
  double angles, lengths;
};

PoseMeasurements Read(PoseMeasurements measured, const Robot& robot,
                      const ReadUnits& units) {
  for (int i = 0; i < robot.num_joints(); ++i) {
    if (!IsRotational(robot.links[i].joint.type)) continue;
    measured.q.col(i) *= units.angles;
  }
  for (Eigen::MatrixXd& target : measured.targets) target *= units.lengths;
  if (measured.poses.size() > 0) measured.poses.leftCols(3) *= units.lengths;
  measured.lengths *= units.lengths;
  return measured;
}

// Median distance with the file's geometry, m; infinite where there is none.
// One fit from the start values: gross errors do not hide a factor, and the
// median is not theirs.
double GeometryLeaves(const Robot& robot, const PoseMeasurements& measured) {
  PoseCalibrationOptions options;
  options.refine = RefineGeometry::kNothing;
  options.loss = RobustLoss::kSquared;
  PoseFit fit(robot, measured, options);
  const std::vector<int> rows = fit.AllRows();
  PoseUnknowns at = StartPoses(fit.geometry(), measured);
  const std::vector<bool> free =
      HoldUnseen(fit, fit.Wanted(options.refine), rows, at, nullptr);
  if (!fit.WhyTooFew(free).empty() ||
      !fit.Solve(free, rows, options.loss, &at, kLastFall)) {
    return std::numeric_limits<double>::infinity();
  }
  return Median(fit.Distances(rows, at));
}

const char* LengthColumn(const PoseMeasurements& measured) {
  if (measured.lengths.size() > 0) return "length1";
  return measured.targets.empty() ? "x" : "x1";
}

// "joint positions are degrees: expected [deg] in their names, as in q1 [deg]"
std::string Meant(const PoseMeasurements& measured, const ReadUnits& units) {
  std::string text;
  if (units.angles != 1) {
    const bool degrees = units.angles < 1;
    text += std::string("joint positions are ") +
            (degrees ? "degrees that were read as radians: expected names that "
                       "end with [deg], as in 'q1 [deg]'"
                     : "radians that were read as degrees: expected names "
                       "without [deg]");
  }
  if (units.lengths != 1) {
    const std::string column = LengthColumn(measured);
    const bool millimetres = units.lengths < 1;
    text += (text.empty() ? "" : "; ") +
            (millimetres
                 ? "lengths are millimetres that were read as metres: expected "
                   "names that end with [mm], as in '" +
                       column + " [mm]'"
                 : std::string("lengths are metres that were read as "
                               "millimetres: expected names without [mm]"));
  }
  return text;
}

}  // namespace

// Distances are compared as shares of the poses' extent, which has their unit.
std::string WrongUnits(const Robot& robot, const PoseMeasurements& measured) {
  // Tilts and touched points have no extent in metres.
  if (measured.tilts.size() > 0 || !measured.touched.empty()) return "";
  const PoseMeasurements some = SomePoses(measured, kEnoughPoses);
  const double extent = PoseExtent(some);
  const double left = GeometryLeaves(robot, some);
  if (FollowsJoints(left, extent) || !std::isfinite(left)) return "";
  // Of images lengths are in the board's unit, in which covariances are, too.
  const bool scales = measured.covariance.empty();
  ReadUnits best = {1, 1};
  double least = kTinyPart * left / extent;
  for (const double angles : {1., kDegree, 1 / kDegree}) {
    for (const double lengths : {1., 1e-3, 1e3}) {
      if (!scales && lengths != 1) continue;
      const PoseMeasurements other = Read(some, robot, {angles, lengths});
      const double of_extent = GeometryLeaves(robot, other) / PoseExtent(other);
      if (!(of_extent < least) || !FollowsJoints(of_extent, 1)) continue;
      least = of_extent;
      best = {angles, lengths};
    }
  }
  if (best.angles == 1 && best.lengths == 1) return "";
  return Meant(measured, best) +
         Format(
             " (the file's geometry is then %.3g %% of the poses' extent "
             "away from them, as read %.3g %%)",
             100 * least, 100 * left / extent);
}

void RequireUnits(const Robot& robot, const PoseMeasurements& measured,
                  const char* option) {
  const std::string wrong = WrongUnits(robot, measured);
  if (!wrong.empty()) throw OptionError(OptionName(option) + ": " + wrong);
}

}  // namespace armcal
