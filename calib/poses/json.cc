#include "calib/linear/verdict.h"
#include "calib/numerics/json_figures.h"
#include "calib/poses/pose_label.h"
#include "calib/poses/report.h"
#include "calib/poses/verdict.h"

namespace armcal {
namespace {

using nlohmann::json;

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

json NotesJson(const Robot& robot, const PoseCalibration& result) {
  json notes = json::array();
  for (const std::string& note : PoseNotes(robot, result))
    notes.push_back(note);
  return notes;
}

}  // namespace

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
            {"kind", MeasuredKind(measured)},
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
            {"notes", NotesJson(robot, result)}}},
          {"termination",
           {{"converged", result.solved}, {"reason", result.reason}}}};
}

}  // namespace armcal
