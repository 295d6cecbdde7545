#include "calib/inspect/log_coverage.h"

#include <algorithm>
#include <cmath>

#include "calib/diagnose/data/audit.h"
#include "calib/diagnose/data/enough_motion.h"
#include "calib/diagnose/data/rows.h"
#include "calib/diagnose/data/segments.h"
#include "calib/excite/motion_advice.h"
#include "calib/linear/calibrate_linear.h"
#include "calib/linear/calibration.h"
#include "calib/linear/calibration_report.h"
#include "calib/linear/outlier_report.h"
#include "calib/logs/prepared_logs.h"
#include "calib/numerics/median.h"
#include "model/signals/bandwidth.h"
#include "model/text/format.h"
#include "model/text/input_error.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

double Wander(const TimeBase& base) {
  double least = 0, most = 0;
  for (const StampError& e : base.stamp_errors) {
    least = std::min(least, e.error);
    most = std::max(most, e.error);
  }
  return most - least;
}

// Torques that are a law of the positions.
void AddAuditedTorque(const Robot& robot, double bandwidth_hz,
                      const LogSet& logs, LogCoverage* coverage) {
  const std::vector<GapSegment> segments = ReadSegments(bandwidth_hz, {}, logs);
  const GapRows rows(segments, bandwidth_hz);
  if (rows.num_thin() == 0) return;
  for (const DataFinding& finding : AuditTorque(robot, rows)) {
    coverage->findings.push_back(
        {"computed_torque", finding.finding, finding.evidence, finding.flag});
  }
}

// A diagnosis checks what it finds on parts of the log that it holds out, and
// refuses a log that leaves it no rows at all. Both take so much motion in one
// piece, as filters bend the ends.
std::string TooShort(const LogSet& logs) {
  const double bandwidth_hz = DiagnosisBandwidth(logs.time_bases());
  const std::vector<GapSegment> segments = ReadSegments(bandwidth_hz, {}, logs);
  const auto has_rows = [&](const LogPart& part) {
    return GapRows(segments, bandwidth_hz, part).num_rows() > 0;
  };
  if (has_rows(LogPart::AnyFold())) return "";
  const bool refused = !has_rows(LogPart());
  const SplittingGaps gaps = GapsThatSplit(bandwidth_hz, logs);
  const std::string split =
      gaps.count == 0 ? ""
                      : ", and " + gaps.Text() + " split" +
                            (gaps.count == 1 ? "s" : "") + " this log there";
  return std::string("too short for armcal diagnose") +
         (refused ? "" : " to hold some of it out") +
         Format(": %.3g s in motion without a gap are needed at %.3g Hz",
                GapRows::ShortestSplit(bandwidth_hz), bandwidth_hz) +
         split +
         (refused ? "" : ", or another log as " + OptionName("validate"));
}

// Times at which joint j of the log turns round, s, ascending.
std::vector<std::vector<double>> Reversals(const LogSet& logs,
                                           const PreparationOptions& options,
                                           int num_joints) {
  std::vector<std::vector<double>> times(num_joints);
  Prepare(logs, options).ForEach("", nullptr, [&](int, const Trajectory& t) {
    for (int row = std::max(1, t.core_begin); row < t.core_end; ++row) {
      for (int j = 0; j < num_joints; ++j) {
        if (t.qd(row - 1, j) * t.qd(row, j) < 0) {
          times[j].push_back(t.time(row));
        }
      }
    }
  });
  return times;
}

// Whether an outlier lies apart from the rows around it: gross errors do. Where
// a command jumps, or the arm is pushed, the rows after it stay there.
bool LiesApart(const Log& log, const TorqueOutlier& outlier) {
  constexpr int kReach = 8;    // rows to both sides
  constexpr double kFar = 10;  // mean deviations of the rows around
  const auto row = static_cast<int>(outlier.row - log.first_row);
  std::vector<double> around, off;
  for (int k = std::max(0, row - kReach);
       k <= std::min(log.size() - 1, row + kReach); ++k) {
    around.push_back(log.tau(k, outlier.joint));
  }
  const double middle = Median(around);
  for (const double x : around) off.push_back(std::abs(x - middle));
  return std::abs(outlier.recorded - middle) > kFar * Median(off);
}

// Gross errors per joint but for those where the joint turns round: there
// friction jumps, and a model whose transition is a little off leaves samples
// as large. Positions low-passed at f Hz tell where that is to half a period.
std::vector<long> ErrorsInMotion(const LinearCalibration& result,
                                 const LogSet& logs, const Log& recorded,
                                 int num_joints) {
  std::vector<long> counts(num_joints, 0);
  if (CountOutliers(result) == 0) return counts;
  const double f = result.preparation.bandwidth_hz;
  const double near = f > 0 ? .5 / f : 0;
  const auto turns = Reversals(logs, result.preparation, num_joints);
  for (const TorqueOutlier& o : result.preparation.outliers->front()) {
    const std::vector<double>& of_joint = turns[o.joint];
    const auto next =
        std::lower_bound(of_joint.begin(), of_joint.end(), o.time - near);
    if (next != of_joint.end() && *next <= o.time + near) continue;
    if (LiesApart(recorded, o)) ++counts[o.joint];
  }
  return counts;
}

// Told are those in motion, of all that the calibration leaves out.
void AddOutliers(const Robot& robot, const std::vector<long>& errors,
                 long samples, LogCoverage* coverage) {
  constexpr double kMany = .005;  // of the samples
  for (size_t j = 0; j < errors.size(); ++j) {
    const double share = static_cast<double>(errors[j]) /
                         static_cast<double>(std::max(1L, samples));
    if (share < kMany) continue;
    coverage->findings.push_back(
        {"outliers",
         "the torque of " + robot.links[j].joint.name + " has gross errors",
         Format("%ld samples (%.1f %%) lie apart from those around them and "
                "from reversals; %ld stick out of a fit",
                errors[j], 100 * share, coverage->outliers[j]),
         "armcal calibrate leaves the latter out and lists them in "
         "outliers.csv",
         static_cast<int>(j)});
  }
}

}  // namespace

LogCoverage CoverageOf(const Robot& robot, const LogSource& log,
                       const LogReaderOptions& options) {
  LogCoverage coverage;
  try {
    const LogSet logs({log}, options, TimeRange());
    coverage.time_base = logs.time_bases()[0].Describe();
    coverage.stamp_wander = Wander(logs.time_bases()[0]);
    const LinearCalibrationOptions linear;
    const LinearCalibration result =
        CalibrateLinear(robot, linear, logs, nullptr);
    coverage.reason = result.reason;
    if (!result.solved) return coverage;
    const Identifiability& id = result.identifiability;
    coverage.known = true;
    coverage.rank = id.batch_rank;
    coverage.total = id.total;
    coverage.unpowered = result.unpowered;
    for (const auto& d : id.directions) coverage.unseen.push_back(d.text);
    coverage.residual_percent = result.training->moving().stacked_percent;
    coverage.noise_source = NoiseSourceName(result.sample_noise[0].source);
    for (int j = 0; j < robot.num_joints(); ++j) {
      coverage.outliers.push_back(CountOutliers(result, j));
    }
    AddOutliers(robot,
                ErrorsInMotion(result, logs, ReadWholeLog(log, options),
                               robot.num_joints()),
                logs.time_bases()[0].samples, &coverage);
    coverage.advice =
        AdviceText(robot, AdviseMotions(robot, result, linear, logs), id.total);
    AddAuditedTorque(robot, result.preparation.bandwidth_hz, logs, &coverage);
    coverage.too_short = TooShort(logs);
  } catch (const InputError& error) {
    coverage.reason = error.what();
  }
  return coverage;
}

}  // namespace armcal
