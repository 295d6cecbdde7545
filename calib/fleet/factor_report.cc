#include "calib/fleet/factor_report.h"

#include <set>

#include "calib/fleet/reduction_json.h"
#include "calib/linear/calibration_report.h"
#include "calib/linear/verdict.h"
#include "calib/numerics/json_figures.h"
#include "model/log_files/torque_columns.h"
#include "model/text/calendar_time.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using nlohmann::json;

std::string Plural(long count, const char* noun) {
  return Format("%ld %s%s", count, noun, count == 1 ? "" : "s");
}

long Units(const Reduction& reduction) {
  std::set<std::string> units;
  for (const ReducedLog& log : reduction.logs) units.insert(log.unit);
  return static_cast<long>(units.size());
}

long Samples(const Reduction& reduction) {
  long samples = 0;
  for (const ReducedLog& log : reduction.logs) samples += log.samples;
  return samples;
}

// "log.csv of unit 7, 2026-11-21".
std::string Described(const ReducedLog& log) {
  std::string text = log.file;
  if (!log.unit.empty()) text += " of " + log.unit;
  if (log.time) text += ", " + CalendarText(*log.time);
  return text;
}

json LogsJson(const Reduction& reduction) {
  json logs = json::array();
  for (const ReducedLog& log : reduction.logs) {
    json entry = {{"file", log.file},
                  {"sha256", log.sha256},
                  {"samples", log.samples},
                  {"seconds", log.range.end - log.range.begin},
                  {"begin_s", log.range.begin},
                  {"end_s", log.range.end},
                  {"resampled", log.resampled},
                  {"gaps", log.gaps},
                  {"unit", log.unit},
                  {"equations", log.factors[0].rows()},
                  {"inflation", nullptr},
                  {"time", nullptr}};
    if (log.inflation) entry["inflation"] = *log.inflation;
    if (log.time) entry["time"] = CalendarText(*log.time);
    logs.push_back(entry);
  }
  return logs;
}

json UnpoweredJson(const Robot& robot, const Reduction& reduction,
                   const LinearCalibration& result) {
  json list = json::array();
  for (const UnpoweredJoint& u : result.unpowered) {
    list.push_back({{"log", reduction.logs[u.log].file},
                    {"joint", robot.links[u.joint].joint.name},
                    {"torque_rms", u.torque_rms}});
  }
  return list;
}

}  // namespace

std::string ReductionText(const Robot& robot, const Reduction& reduction) {
  std::string text;
  for (const ReducedLog& log : reduction.logs) {
    text += "log        " + Described(log) +
            Format(": %ld samples, %ld equations per joint", log.samples,
                   log.factors[0].rows());
    text += log.inflation
                ? Format(
                      "; standard deviations %.2f times those of "
                      "independent rows\n",
                      *log.inflation)
                : std::string("; too short to tell how rows hang together\n");
  }
  const RowOptions& rows = reduction.model.rows;
  text += rows.bandwidth_hz > 0
              ? Format("model      bandwidth %.3g Hz", rows.bandwidth_hz)
              : std::string("model      no filter");
  if (rows.identification == Identification::kWeak) {
    text += Format(", windows of %.3g s", rows.window_s);
  }
  text += Format(", %ld parameters\n",
                 static_cast<long>(reduction.model.parameters.size()));
  for (size_t i = 0; i < reduction.model.transitions.size(); ++i) {
    const CoulombTransition& t = reduction.model.transitions[i];
    const Joint& joint = robot.links[i].joint;
    const bool velocity = t.law == CoulombTransition::Law::kVelocity;
    text += Format("           %s: Coulomb friction changes sign over %.3g ",
                   joint.name.c_str(), t.width) +
            PositionUnit(joint.type) + (velocity ? "/s\n" : "\n");
  }
  return text;
}

json ToJson(const Reduction& reduction) {
  return {{"format", "armcal reduction 1"},
          {"model", ToJson(reduction.model)},
          {"logs", LogsJson(reduction)}};
}

std::string BriefReport(const Robot& robot, const Reduction& reduction,
                        const LinearCalibration& result) {
  const std::string from =
      " from " + Plural(static_cast<long>(reduction.logs.size()), "log");
  if (!result.solved) {
    return robot.name + ": not calibrated" + from + ": " + result.reason;
  }
  const Identifiability& id = result.identifiability;
  std::string text =
      robot.name + Format(": %d model parameters", id.total) + from;
  if (Units(reduction) > 1) text += " of " + Plural(Units(reduction), "unit");
  if (id.batch_rank < id.total) {
    text += "; " + Plural(id.total - id.batch_rank, "direction") +
            " not identifiable from these motions";
  }
  return text;
}

std::string FullReport(const Robot& robot, const Reduction& reduction,
                       const LinearCalibration& result) {
  constexpr size_t kListed = 8;
  std::string text;
  for (size_t k = 0; k < reduction.logs.size() && k < kListed; ++k) {
    text += "log        " + Described(reduction.logs[k]) + "\n";
  }
  if (reduction.logs.size() > kListed) {
    text +=
        Format("           and %zu more\n", reduction.logs.size() - kListed);
  }
  text += "torque     " + reduction.logs[0].torque + "; " +
          ScaleText(result.torque_constants_stddev) + "\n";
  text += Format("equations  %ld per joint, of %ld samples\n", result.equations,
                 Samples(reduction));
  return text + EstimateText(robot, result) +
         BriefReport(robot, reduction, result) + "\n";
}

json ToJson(const Robot& robot, const Reduction& reduction,
            const LinearCalibration& result) {
  json out = ToJson(robot, result);
  out["logs"] = LogsJson(reduction);
  out["torque"] = reduction.logs[0].torque;
  out["torque_constants_stddev"] = result.torque_constants_stddev;
  out["unpowered"] = UnpoweredJson(robot, reduction, result);
  out["reduction"] = ToJson(reduction.model);
  return out;
}

}  // namespace armcal
