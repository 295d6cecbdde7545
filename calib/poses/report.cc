#include "calib/poses/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "calib/linear/verdict.h"
#include "calib/numerics/json_figures.h"
#include "calib/poses/pose_label.h"
#include "calib/poses/verdict.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using nlohmann::json;

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
  if (std::isfinite(p.stddev)) {
    std::snprintf(spread, sizeof(spread), "+- %-9.2g", unit.scale * p.stddev);
  }
  std::snprintf(text, sizeof(text), "  %-22s %12.4f -> %12.4f %s %s\n",
                p.name.c_str(), unit.scale * p.nominal, unit.scale * p.value,
                spread, unit.name.c_str());
  return text;
}

const char* Kind(const PoseMeasurements& measured) {
  if (measured.lengths.size() > 0) return "wire lengths";
  if (measured.tilts.size() > 0) return "tilts";
  if (measured.planes) return "touched planes";
  if (!measured.touched.empty()) return "touched points";
  if (measured.pixel_stddev > 0) return "images";
  return measured.targets.empty() ? "tool poses" : "targets";
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

json ObservedJson(const PoseCalibration& result) {
  json all = json::array();
  for (const ObservedEstimate& p : result.observed) {
    all.push_back({{"name", p.name},
                   {"unit", p.unit},
                   {"value", JsonNumber(p.value)},
                   {"stddev", JsonNumber(p.stddev)}});
  }
  return all;
}

json ValidationJson(const PoseCalibration& result) {
  if (!result.validation) return nullptr;
  return {{"count", result.validation->count},
          {"file_rms", JsonNumber(result.validation->file_rms)},
          {"rms", JsonNumber(result.validation->rms)},
          {"median", JsonNumber(result.validation->median)}};
}

json InstrumentJson(const PoseCalibration& result) {
  json all = json::array();
  for (const InstrumentEstimate& p : result.instrument) {
    all.push_back({{"name", p.name},
                   {"unit", p.unit},
                   {"start", JsonNumber(p.start)},
                   {"value", JsonNumber(p.value)},
                   {"stddev", JsonNumber(p.stddev)}});
  }
  return all;
}

// What is left beside the instrument, and what else there is to say of it.
std::string MisfitText(const PoseCalibration& result, const char* unit) {
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
  for (const std::string& note : PoseNotes(result)) {
    text += "note       " + note + "\n";
  }
  return text;
}

json CouplingJson(const Robot& robot, const PoseCalibration& result) {
  if (!result.coupling) return nullptr;
  const PoseCoupling& c = *result.coupling;
  return {{"joint", robot.links[c.joint].joint.name},
          {"by", robot.links[c.by].joint.name},
          {"factor", c.factor},
          {"stddev", JsonNumber(c.stddev)},
          {"rms_before", c.rms_before},
          {"rms_after", c.rms_after},
          {"angle_before", c.angle_before},
          {"angle_after", c.angle_after}};
}

json NotesJson(const PoseCalibration& result) {
  json notes = json::array();
  for (const std::string& note : PoseNotes(result)) notes.push_back(note);
  return notes;
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
                "poses      %d, %s; noise %.3g %s\n"
                "deviation  %.4f %s rms with the file's geometry, %.4f %s with "
                "the estimate\n"
                "           median %.4f %s, max %.4f %s; cross-validated "
                "%.4f %s rms, median %.4f %s\n",
                measured.size(), Kind(measured), 1e3 * result.noise.position,
                unit, 1e3 * result.before_rms, unit, 1e3 * result.rms, unit,
                1e3 * result.median, unit, 1e3 * result.max, unit,
                1e3 * result.held_out_rms, unit, 1e3 * result.held_out_median,
                unit);
  std::string text = WorseText(result, unit) + line +
                     HeldOutText(result, unit) + CameraText(measured) +
                     LossText(result) + OutlierText(measured, result) +
                     MisfitText(result, unit) +
                     "\ngeometry                       file        estimate\n";
  for (const GeometryEstimate& p : result.parameters) text += Estimate(p);
  for (const std::string& sentence : result.held) {
    text += "held       " + sentence + "\n";
  }
  return text + ObservedText(result) + InstrumentText(result) +
         VerdictText(Shortcomings(robot, result));
}

json PoseJson(const Robot& robot, const PoseMeasurements& measured,
              const PoseCalibration& result) {
  json geometry = json::array(), outliers = json::array();
  for (const GeometryEstimate& p : result.parameters) {
    geometry.push_back(
        {{"name", p.name},
         {"unit", p.unit},
         {"nominal", p.nominal},
         {"value", JsonNumber(p.value)},
         {"stddev", JsonNumber(p.stddev)},
         {"prior_stddev", p.prior > 0 ? JsonNumber(p.prior) : json(nullptr)},
         {"identifiable", p.identifiable}});
  }
  const double u95 = result.misfit.instrument_u95;
  for (const int k : result.outliers) outliers.push_back(measured.row[k]);
  return {{"format", "armcal calibration 1"},
          {"robot", robot.name},
          {"estimate", "refined"},
          {"geometry", geometry},
          {"held", result.held},
          {"observed", ObservedJson(result)},
          {"instrument", InstrumentJson(result)},
          {"verdict", VerdictJson(Shortcomings(robot, result))},
          {"poses",
           {{"count", measured.size()},
            {"kind", Kind(measured)},
            {"unit", result.unit},
            {"rms", result.rms},
            {"max", result.max},
            {"median", result.median},
            {"before_rms", result.before_rms},
            {"loss", LossName(result.loss)},
            {"cross_validated_rms", result.held_out_rms},
            {"cross_validated_median", result.held_out_median},
            {"file_cross_validated_rms",
             result.file_held_out_rms > 0 ? JsonNumber(result.file_held_out_rms)
                                          : json(nullptr)},
            {"compared",
             {{"rms", result.compared_rms},
              {"file_rms", result.file_compared_rms},
              {"excess", result.held_out_excess.mean},
              {"excess_stderr", result.held_out_excess.stderr_of_mean}}},
            {"validation", ValidationJson(result)},
            {"noise_stddev", result.noise.position},
            {"pixel_stddev", measured.pixel_stddev > 0
                                 ? JsonNumber(measured.pixel_stddev)
                                 : json(nullptr)},
            {"outlier_rows", outliers},
            {"instrument_u95", u95 > 0 ? JsonNumber(u95) : json(nullptr)},
            {"instrument_ratio", JsonNumber(result.misfit.instrument_ratio)},
            {"order_correlation", result.misfit.order_correlation},
            {"coupling", CouplingJson(robot, result)},
            {"notes", NotesJson(result)}}},
          {"termination",
           {{"converged", result.solved}, {"reason", result.reason}}}};
}

}  // namespace armcal
