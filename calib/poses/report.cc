#include "calib/poses/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "calib/linear/verdict.h"
#include "calib/poses/held_text.h"
#include "calib/poses/pose_label.h"
#include "calib/poses/repeated_poses.h"
#include "calib/poses/verdict.h"
#include "model/text/format.h"

namespace armcal {
namespace {

// Lengths in mm and angles in degrees, as people read them; others as they are.
struct ShownUnit {
  explicit ShownUnit(const std::string& unit)
      : scale(unit == "rad" ? 57.29577951308232
              : unit == "m" ? 1e3
                            : 1),
        name(unit == "rad" ? "deg"
             : unit == "m" ? "mm"
                           : unit) {}
  double scale;
  std::string name;
};

std::string Estimate(const GeometryEstimate& p) {
  const ShownUnit unit(p.unit);
  char text[128], spread[32] = "(not seen)  ";
  // The poses tell less of it than the file, at whose value the prior holds it.
  if (p.prior > 0 && p.stddev > p.prior) {
    std::snprintf(spread, sizeof(spread), "(held)      ");
  } else if (std::isfinite(p.stddev)) {
    std::snprintf(spread, sizeof(spread), "+- %-9.2g", unit.scale * p.stddev);
  }
  std::snprintf(text, sizeof(text), "  %-22s %12.4f -> %12.4f %s %s\n",
                p.name.c_str(), unit.scale * p.nominal, unit.scale * p.value,
                spread, unit.name.c_str());
  return text;
}

// "49, read 147 times": a pose that is read again is no other pose.
std::string CountText(const PoseMeasurements& measured) {
  const int poses = CountPoses(RepeatedPoses(measured.q));
  if (poses == measured.size()) return std::to_string(poses);
  return std::to_string(poses) + ", read " + std::to_string(measured.size()) +
         " times";
}

std::string OutlierText(const PoseMeasurements& measured,
                        const PoseCalibration& result) {
  if (result.outliers.empty()) return "";
  std::string text = "outliers   " + std::to_string(result.outliers.size()) +
                     " poses beyond Tukey's limit, " + PoseWord(measured) + "s";
  constexpr size_t kShown = 12;
  for (size_t k = 0; k < std::min(kShown, result.outliers.size()); ++k) {
    text += " " + std::to_string(PoseLabel(measured, result.outliers[k]));
  }
  if (result.outliers.size() > kShown) text += " ... (all in calibration.json)";
  return text + "\n";
}

// Tukey's is the usual one.
std::string LossText(const PoseCalibration& result) {
  if (result.loss == RobustLoss::kTukey) return "";
  return std::string("loss       ") + LossName(result.loss) + "\n";
}

std::string CameraText(const PoseMeasurements& measured) {
  if (!(measured.pixel_stddev > 0)) return "";
  return Format(
      "camera     %.3g px, standard deviation of a coordinate in the images\n",
      measured.pixel_stddev);
}

// Of the cameras themselves.
std::string InstrumentText(const PoseCalibration& result) {
  if (result.instrument.empty()) return "";
  std::string text = "\ninstrument\n";
  for (const InstrumentEstimate& p : result.instrument) {
    const ShownUnit unit(p.unit);
    text += Format("  %-22s %12.6g +- ", p.name.c_str(), unit.scale * p.value) +
            (p.unit == "1" ? Format("%.2g\n", unit.scale * p.stddev)
                           : Format("%-9.2g %s\n", unit.scale * p.stddev,
                                    unit.name.c_str()));
  }
  return text;
}

// The first line where the result does harm.
std::string WorseText(const PoseCalibration& result, const char* unit) {
  if (!IsWorseThanFile(result)) return "";
  return Format(
      "WORSE than the file on poses that were left out: %.3g %s rms against "
      "%.3g %s\n",
      1e3 * result.compared_rms, unit, 1e3 * result.file_compared_rms, unit);
}

// Of poses left out, beside the estimate's own figures.
std::string HeldOutText(const PoseCalibration& result, const char* unit) {
  std::string text;
  if (result.file_held_out_rms > 0) {
    text += Format(
        "           cross-validated with the file's geometry %.4f %s rms\n",
        1e3 * result.file_held_out_rms, unit);
  }
  if (!result.validation) return text;
  const PoseValidation& v = *result.validation;
  return text +
         Format(
             "validation %d poses: %.4f %s rms with the file's geometry, "
             "%.4f %s with the estimate, median %.4f %s\n",
             v.count, 1e3 * v.file_rms, unit, 1e3 * v.rms, unit, 1e3 * v.median,
             unit);
}

// Of what the instrument looks at, or hangs on.
std::string ObservedText(const PoseCalibration& result) {
  if (result.observed.empty()) return "";
  std::string text = "\nwhat was measured\n";
  for (const ObservedEstimate& p : result.observed) {
    const ShownUnit unit(p.unit);
    text += Format("  %-22s %12.4f ", p.name.c_str(), unit.scale * p.value) +
            (std::isfinite(p.stddev)
                 ? Format("+- %-9.2g %s\n", unit.scale * p.stddev,
                          unit.name.c_str())
                 : "(not seen)   " + unit.name + "\n");
  }
  return text;
}

// What is left beside the instrument, and what else there is to say of it.
std::string MisfitText(const Robot& robot, const PoseCalibration& result,
                       const char* unit) {
  const PoseMisfit& misfit = result.misfit;
  std::string text;
  if (std::isfinite(misfit.instrument_ratio)) {
    char line[128];
    std::snprintf(line, sizeof(line),
                  "instrument u95 %.3g %s (median); what is left of inliers is "
                  "%.3g times its deviation\n",
                  1e3 * misfit.instrument_u95, unit, misfit.instrument_ratio);
    text = line;
  }
  for (const std::string& note : PoseNotes(robot, result)) {
    text += "note       " + note + "\n";
  }
  return text;
}

}  // namespace

std::string PoseReport(const Robot& robot, const PoseMeasurements& measured,
                       const PoseCalibration& result) {
  if (!result.solved) {
    return robot.name + ": not calibrated: " + result.reason + "\n";
  }
  char line[320];
  const std::string milli = "m" + result.unit;
  const char* const unit = milli.c_str();
  std::snprintf(line, sizeof(line),
                "poses      %s, %s; noise %.3g %s\n"
                "deviation  %.4f %s rms with the file's geometry, %.4f %s with "
                "the estimate\n"
                "           median %.4f %s, max %.4f %s; cross-validated "
                "%.4f %s rms, median %.4f %s\n",
                CountText(measured).c_str(), MeasuredKind(measured),
                1e3 * result.noise.position, unit, 1e3 * result.before_rms,
                unit, 1e3 * result.rms, unit, 1e3 * result.median, unit,
                1e3 * result.max, unit, 1e3 * result.held_out_rms, unit,
                1e3 * result.held_out_median, unit);
  std::string text = WorseText(result, unit) + line +
                     HeldOutText(result, unit) + CameraText(measured) +
                     LossText(result) + OutlierText(measured, result) +
                     MisfitText(robot, result, unit) +
                     "\ngeometry                       file        estimate\n";
  for (const GeometryEstimate& p : result.parameters) text += Estimate(p);
  return text + HeldText(result.held) + ObservedText(result) +
         InstrumentText(result) + VerdictText(Shortcomings(robot, result));
}

}  // namespace armcal
