#include <cmath>

#include "calib/numerics/json_figures.h"
#include "calib/poses/diagnosis/interval.h"
#include "calib/poses/diagnosis/report.h"

namespace armcal {
namespace {

using nlohmann::json;

std::string JointOf(const Robot& robot, int joint) {
  return joint < 0 ? "" : robot.links[joint].joint.name;
}

json PlacedJson(const Robot& robot, const PoseMeasurements& measured,
                const PlacedPoseEffect& placed) {
  const auto row = [&](int pose) -> json {
    if (pose < 0) return nullptr;
    return measured.row[pose];
  };
  const PosePlace& place = placed.place;
  return {{"effect", placed.effect->name},
          {"joint", JointOf(robot, place.joint)},
          {"joint_index", place.joint + 1},
          {"by", JointOf(robot, place.by)},
          {"by_index", place.by + 1},
          {"first_row", row(place.begin)},
          {"last_row", row(place.end < 0 ? -1 : place.end - 1)}};
}

json GainJson(const HeldOutGain& gain) {
  return {{"removed_percent", JsonNumber(100 * gain.removed_share)},
          {"deviance", JsonNumber(gain.deviance)},
          {"deviance_stddev", JsonNumber(gain.stddev)}};
}

json AmountJson(const PoseAmount& amount) {
  json object = {{"name", amount.name},
                 {"unit", amount.unit},
                 {"value", JsonNumber(amount.value)},
                 {"ci95",
                  {JsonNumber(amount.value - amount.half_width),
                   JsonNumber(amount.value + amount.half_width)}}};
  if (amount.told.stddev > 0) {
    const Told& poses = amount.by_poses;
    object["by_logs"] = {{"value", amount.told.value},
                         {"stddev", amount.told.stddev}};
    object["by_poses"] = {{"value", JsonNumber(poses.value)},
                          {"stddev", JsonNumber(poses.stddev)}};
    object["deviations_apart"] = JsonNumber(amount.Apart());
  }
  return object;
}

json RangeJson(const PoseMeasurements& measured, const int range[2],
               int shift) {
  if (range[0] < 0) return nullptr;
  return {measured.row[range[0] - shift], measured.row[range[1] - shift]};
}

json FindingJson(const Robot& robot, const PoseMeasurements& measured,
                 const PoseFinding& finding) {
  json effect = PlacedJson(robot, measured, finding.placed);
  effect["name"] = finding.name;
  effect["means"] = finding.placed.effect->means;
  effect["probability"] = JsonNumber(finding.probability);
  effect["probability_of_none"] = JsonNumber(finding.none);
  effect["estimates"] = json::array();
  for (const PoseAmount& amount : finding.amounts) {
    effect["estimates"].push_back(AmountJson(amount));
  }
  if (finding.placed.effect->is_harmonic) {
    effect["amplitude"] =
        AmountJson(LengthOf("amplitude", finding.amounts, finding.ci95));
  }
  effect["first_row_ci95"] = RangeJson(measured, finding.begin, 0);
  effect["last_row_ci95"] = RangeJson(measured, finding.end, 1);
  effect["displacement"] = {{"rms", JsonNumber(finding.displacement_rms)},
                            {"max", JsonNumber(finding.displacement_max)}};
  effect["removed_percent"] =
      JsonNumber(100 * finding.interleaved.removed_share);
  effect["held_out"] = {{"interleaved", GainJson(finding.interleaved)},
                        {"contiguous", GainJson(finding.contiguous)}};
  effect["equivalent"] = json::array();
  for (const PoseEquivalent& other : finding.equivalents) {
    json equivalent = PlacedJson(robot, measured, other.placed);
    equivalent["name"] = other.name;
    equivalent["probability"] = JsonNumber(other.probability);
    const auto& q = other.told_apart_at;
    equivalent["told_apart_at"] = std::vector<double>(q.begin(), q.end());
    equivalent["differ"] = JsonNumber(other.differ);
    effect["equivalent"].push_back(equivalent);
  }
  effect["separate_by"] = finding.placed.effect->separate_by;
  return effect;
}

json PoseGapJson(const PoseGap& gap) {
  const auto removed = [](double before, double after) {
    return JsonNumber(100 * (1 - after * after / (before * before)));
  };
  return {{"frame", JsonNumber(gap.file)},
          {"geometry", JsonNumber(gap.geometry)},
          {"after", JsonNumber(gap.after)},
          {"held_out",
           {{"interleaved",
             {{"geometry", JsonNumber(gap.held_out_geometry)},
              {"after", JsonNumber(gap.held_out_after)},
              {"removed_percent",
               removed(gap.held_out_geometry, gap.held_out_after)}}},
            {"contiguous",
             {{"geometry", JsonNumber(gap.stretches_geometry)},
              {"after", JsonNumber(gap.stretches_after)},
              {"removed_percent",
               removed(gap.stretches_geometry, gap.stretches_after)}}}}}};
}

json LeftJson(const PoseMeasurements& measured,
              const PoseDiagnosis& diagnosis) {
  json outliers = json::array();
  for (const int k : diagnosis.outliers) outliers.push_back(measured.row[k]);
  const PoseMisfit& misfit = diagnosis.misfit;
  const double u95 = misfit.instrument_u95;
  return {{"coordinate_rms", JsonNumber(diagnosis.coordinate_rms)},
          {"instrument_u95", u95 > 0 ? JsonNumber(u95) : json(nullptr)},
          {"instrument_ratio", JsonNumber(misfit.instrument_ratio)},
          {"order_correlation", JsonNumber(misfit.order_correlation)},
          {"order_stddev", JsonNumber(misfit.order_stddev)},
          {"outlier_rows", outliers}};
}

}  // namespace

json PoseDiagnosisJson(const Robot& robot, const PoseMeasurements& measured,
                       const PoseDiagnosis& diagnosis) {
  json effects = json::array();
  for (const PoseFinding& finding : diagnosis.findings) {
    effects.push_back(FindingJson(robot, measured, finding));
  }
  json result = {{"format", "armcal pose diagnosis 1"},
                 {"robot", robot.name},
                 {"verdict", PoseVerdictName(diagnosis.verdict)},
                 {"sentence", PoseSentence(diagnosis)},
                 {"effects", effects},
                 {"poses", measured.size()}};
  if (diagnosis.verdict == PoseVerdict::kNotTestable) return result;
  result["unit"] = "m";
  result["gap"] = {{"position", PoseGapJson(diagnosis.gap)}};
  result["left"] = LeftJson(measured, diagnosis);
  result["where"] = {{"distances", diagnosis.distances}};
  result["fitted_not_named"] = diagnosis.unconfirmed;
  result["unlikely"] = json::array();
  for (const UnlikelyPoseEffect& effect : diagnosis.unlikely) {
    result["unlikely"].push_back(
        {{"name", effect.name},
         {"probability", JsonNumber(effect.probability)},
         {"probability_of_none", JsonNumber(effect.none)}});
  }
  result["design_effect"] = JsonNumber(diagnosis.design_effect);
  result["heavy_tails"] = std::isfinite(diagnosis.nu);
  result["unknowns"] = diagnosis.unknowns;
  return result;
}

}  // namespace armcal
