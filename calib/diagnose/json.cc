#include <cmath>

#include "calib/diagnose/next_steps.h"
#include "calib/diagnose/report.h"
#include "calib/diagnose/sentence.h"
#include "calib/numerics/json_figures.h"

namespace armcal {
namespace {

using nlohmann::json;

json PlaceJson(const PlacedEffect& place) {
  return {{"effect", place.effect->name},
          {"joint_index", place.joint + 1},
          {"probability", JsonNumber(place.probability)}};
}

json PlacesJson(const std::vector<PlacedEffect>& places) {
  json list = json::array();
  for (const PlacedEffect& place : places) list.push_back(PlaceJson(place));
  return list;
}

json EvidenceJson(const EffectEvidence& evidence) {
  return {
      {"odds", JsonNumber(evidence.odds)},
      {"odds_of_any", JsonNumber(evidence.odds_of_any)},
      {"strength", JsonNumber(evidence.strength)},
      {"chosen", evidence.chosen},
      {"stronger", evidence.stronger},
      {"least_share", evidence.least_share},
      {"stronger_beside", evidence.stronger_beside},
      {"since_reference", evidence.since_reference},
      {"next", JsonNumber(evidence.next)},
      {"events", evidence.events},
      {"one_joint", JsonNumber(evidence.one_joint)},
      {"gain", JsonNumber(evidence.gain.value)},
      {"gain_ci95",
       {JsonNumber(evidence.gain.ci95[0]), JsonNumber(evidence.gain.ci95[1])}},
      {"gain_expected", JsonNumber(evidence.gain.expected)},
      {"expected", JsonNumber(evidence.confirmation.expected)},
      {"explained", JsonNumber(evidence.confirmation.explained)}};
}

json NumbersJson(const Eigen::VectorXd& values) {
  json list = json::array();
  for (const double value : values) list.push_back(JsonNumber(value));
  return list;
}

json ContactJson(const Contact& contact, const GapDiagnosis& diagnosis) {
  json force;
  if (contact.force) force = NumbersJson(contact.force->value);
  return {{"begin", contact.window.begin},
          {"end", contact.window.end},
          {"time", contact.time},
          {"joint", diagnosis.joints[contact.joint].name},
          {"joint_index", contact.joint + 1},
          {"torque", NumbersJson(contact.torque)},
          {"torque_stddev", NumbersJson(contact.stddev)},
          {"force", force}};
}

json EstimatesJson(const std::vector<EffectEstimate>& estimates,
                   const std::vector<double>& stddev) {
  json list = json::array();
  for (size_t k = 0; k < estimates.size(); ++k) {
    const bool seen = estimates[k].value != 0 || stddev[k] > 0;
    list.push_back(
        {{"name", estimates[k].name},
         {"unit", estimates[k].unit},
         {"value", seen ? JsonNumber(estimates[k].value) : json()},
         {"stddev", stddev[k] > 0 ? JsonNumber(stddev[k]) : json()}});
  }
  return list;
}

json EffectJson(const FoundEffect& found, const GapDiagnosis& diagnosis) {
  json windows = json::array(), contacts = json::array();
  for (const Contact& contact : found.contacts) {
    windows.push_back({contact.window.begin, contact.window.end});
    contacts.push_back(ContactJson(contact, diagnosis));
  }
  json effect = {
      {"effect", found.effect->name},
      {"joint", found.joint < 0 ? "" : diagnosis.joints[found.joint].name},
      {"joint_index", found.joint + 1},
      {"probability", JsonNumber(found.probability)},
      {"score", JsonNumber(found.score)},
      {"evidence", EvidenceJson(found.evidence)},
      {"estimates", EstimatesJson(found.estimates, found.stddev)},
      {"equivalent", PlacesJson(found.equivalent)},
      {"or_at", PlacesJson(found.or_at)},
      {"any_probability", JsonNumber(found.any_probability)},
      {"separate_by", found.separate_by},
      {"removed_percent", JsonNumber(found.removed_percent)},
      {"ci95", {JsonNumber(found.ci95[0]), JsonNumber(found.ci95[1])}},
      {"time_windows", windows}};
  if (!contacts.empty()) effect["contacts"] = contacts;
  for (const JointAgreement::JointSize& one : found.joint_sizes) {
    effect["joint_sizes"].push_back(
        {{"joint", diagnosis.joints[one.joint].name},
         {"joint_index", one.joint + 1},
         {"value", JsonNumber(one.value)},
         {"stddev", JsonNumber(one.stddev)}});
  }
  return effect;
}

json LadderJson(const MissingTerms& ladder) {
  json steps = json::array();
  const auto add = [&](const std::string& name, const Eigen::VectorXd& left) {
    steps.push_back(
        {{"with", name},
         {"left_rms", std::vector<double>(left.begin(), left.end())}});
  };
  if (!ladder.terms.empty()) add("", ladder.without);
  for (const MissingTerm& term : ladder.terms) {
    add(term.effect->name, term.left);
  }
  return steps;
}

json GapJson(const GapFigures& gap) {
  return {{"nominal", JsonNumber(gap.nominal)},
          {"refit", JsonNumber(gap.refit)},
          {"after", JsonNumber(gap.after)},
          {"floor", JsonNumber(gap.floor)},
          {"removed_percent", JsonNumber(gap.removed_percent)},
          {"removed_from_nominal_percent",
           JsonNumber(gap.removed_from_nominal_percent)},
          {"ci95", {JsonNumber(gap.ci95[0]), JsonNumber(gap.ci95[1])}}};
}

json ForwardJson(const GapDiagnosis& diagnosis) {
  const ForwardGap& forward = *diagnosis.forward;
  json gap = GapJson(forward.figures);
  gap["method"] = forward.closed_loop ? "closed_loop" : "windows";
  gap["runs"] = forward.runs;
  gap["diverged"] = forward.diverged;
  gap["nominal_ci95"] = {JsonNumber(forward.figures.nominal_ci95[0]),
                         JsonNumber(forward.figures.nominal_ci95[1])};
  gap["joints"] = json::array();
  for (int j = 0; j < forward.figures.joints.rows(); ++j) {
    gap["joints"].push_back(
        {{"name", diagnosis.joints[j].name},
         {"unit", diagnosis.joints[j].unit == "N" ? "m" : "rad"},
         {"nominal_rms", JsonNumber(forward.figures.joints(j, 0))},
         {"refit_rms", JsonNumber(forward.figures.joints(j, 1))},
         {"after_rms", JsonNumber(forward.figures.joints(j, 2))},
         {"floor_rms", JsonNumber(forward.floor[j])}});
  }
  return gap;
}

json WhereJson(const std::vector<JointGap>& joints) {
  json list = json::array();
  for (const JointGap& joint : joints) {
    list.push_back({{"name", joint.name},
                    {"unit", joint.unit},
                    {"nominal_rms", JsonNumber(joint.nominal_rms)},
                    {"refit_rms", JsonNumber(joint.refit_rms)},
                    {"after_rms", JsonNumber(joint.after_rms)},
                    {"floor_rms", JsonNumber(joint.floor_rms)},
                    {"beyond_reference", JsonNumber(joint.beyond_reference)},
                    {"torque_rms", JsonNumber(joint.torque_rms)},
                    {"organised_by", joint.organised.by}});
  }
  return {{"joints", list}};
}

json ShownJson(const GapDiagnosis& diagnosis) {
  json list = json::array();
  for (const ShownEffect& shown : diagnosis.shown) {
    list.push_back(
        {{"effect", shown.effect->name},
         {"joint", shown.joint < 0 ? "" : diagnosis.joints[shown.joint].name},
         {"joint_index", shown.joint + 1},
         {"significant", shown.is_significant},
         {"estimates", EstimatesJson(shown.estimates, shown.stddev)}});
  }
  return list;
}

json DriftsJson(const std::vector<RunDrift>& drifts) {
  json list = json::array();
  for (const RunDrift& drift : drifts) {
    list.push_back({{"name", drift.name},
                    {"unit", drift.unit},
                    {"value", NumbersJson(drift.value)},
                    {"stddev", NumbersJson(drift.stddev)},
                    {"per_log", JsonNumber(drift.per_log)},
                    {"per_log_stddev", JsonNumber(drift.per_log_stddev)}});
  }
  return list;
}

json MovedJson(const std::vector<MovedParameter>& moved) {
  json list = json::array();
  for (const MovedParameter& parameter : moved) {
    list.push_back({{"name", parameter.name},
                    {"unit", parameter.unit},
                    {"nominal", JsonNumber(parameter.nominal)},
                    {"value", JsonNumber(parameter.value)},
                    {"stddev", JsonNumber(parameter.stddev)},
                    {"prior_deviations", JsonNumber(parameter.deviations)}});
  }
  return list;
}

}  // namespace

json ToJson(const GapDiagnosis& diagnosis) {
  json effects = json::array();
  for (const FoundEffect& found : diagnosis.effects) {
    effects.push_back(EffectJson(found, diagnosis));
  }
  json data = json::array();
  for (const DataFinding& finding : diagnosis.data) {
    data.push_back({{"finding", finding.finding},
                    {"evidence", finding.evidence},
                    {"flag", finding.flag}});
  }
  json unnamed = json::array();
  for (const FoundEffect& found : diagnosis.unnamed) {
    unnamed.push_back(EffectJson(found, diagnosis));
    unnamed.back()["one_of_few"] = found.one_of_few;
  }
  json untestable = json::array();
  for (const UntestableEffect& effect : diagnosis.untestable) {
    untestable.push_back({{"effect", effect.effect},
                          {"joint", effect.joint},
                          {"why", effect.why}});
  }
  json unexplained = {{"joint", diagnosis.unexplained.joint},
                      {"organised_by", diagnosis.unexplained.organised_by},
                      {"share", JsonNumber(diagnosis.unexplained.share)}};
  json gap = {{"torque", GapJson(diagnosis.torque)}};
  if (diagnosis.forward && diagnosis.forward->has_figures) {
    gap["forward"] = ForwardJson(diagnosis);
  }
  return {{"verdict", GapVerdictName(diagnosis.verdict)},
          {"sentence", BriefReport(diagnosis)},
          {"data", data},
          {"effects", effects},
          {"fitted_not_named", unnamed},
          {"next", NextSteps(diagnosis)},
          {"candidates", PlacesJson(diagnosis.candidates)},
          {"ladder", LadderJson(diagnosis.ladder)},
          {"absorbed", MovedJson(diagnosis.moved)},
          {"reference_shows", ShownJson(diagnosis)},
          {"drifts", DriftsJson(diagnosis.drifts)},
          {"where", WhereJson(diagnosis.joints)},
          {"untestable", untestable},
          {"gap", gap},
          {"floor_source", NoiseFloorName(diagnosis.floor)},
          {"bandwidth_hz", JsonNumber(diagnosis.bandwidth_hz)},
          {"trust", JsonNumber(diagnosis.trust)},
          {"torque_constants_stddev", diagnosis.torque_constants_stddev},
          {"unexplained", unexplained}};
}

}  // namespace armcal
