#include "calib/diagnose/changes/report.h"

#include <algorithm>
#include <cmath>

#include "calib/numerics/json_figures.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using nlohmann::json;

// "friction of joint2", "a mass on link3".
std::string ChangeText(const NamedChange& change) {
  switch (change.what.part) {
    case ChangedPart::kAllFriction:
      return "friction of all joints";
    case ChangedPart::kFriction:
      return "friction of " + change.place;
    case ChangedPart::kOffset:
      return "the offset of " + change.place;
    case ChangedPart::kArmature:
      return "the armature of " + change.place;
    case ChangedPart::kTorqueScale:
      return "the torque scale of " + change.place;
    case ChangedPart::kAllScales:
      return "the torque scale of all joints";
    case ChangedPart::kMass:
      return "the mass on " + change.place;
  }
  return "";
}

// "changed at log 8", "changed at log 8 (or 7 to 9)".
std::string ChangeTime(const NamedChange& change, size_t logs) {
  const FoundChange& found = change.found;
  std::string text;
  switch (found.course.form) {
    case ChangeForm::kStep:
      text = Format("changed at log %d", found.course.log + 1);
      break;
    case ChangeForm::kOnce:
      text = Format("differs in log %d alone", found.course.log + 1);
      break;
    case ChangeForm::kDrift:
      text = Format("drifts from log %d to log %zu%s", found.course.log + 1,
                    logs, found.course.shape > 0 ? " and settles" : "");
      break;
    case ChangeForm::kMotion:
      return std::string("goes with the ") +
             MotionMeasureName(found.course.shape) + " of the motion";
  }
  if (found.logs.size() > 1) {
    text += Format(" (from %d to %d)", found.logs.front() + 1,
                   found.logs.back() + 1);
  }
  return text;
}

std::string AmountText(const NamedChange& change, size_t k) {
  const auto i = static_cast<Eigen::Index>(k);
  const double value = change.value[i], stddev = change.stddev[i];
  const std::string& name = change.what.names[k];
  if (!change.seen[k]) return name + " not seen";
  if (change.what.units[k] == "1") {
    return name + Format(" %+.0f +- %.1g %%", 100 * value, 100 * stddev);
  }
  std::string text =
      name + Format(" %+.3g +- %.1g ", value, stddev) + change.what.units[k];
  if (std::isfinite(change.relative[k])) {
    text += Format(" (%+.0f %%)", 100 * change.relative[k]);
  }
  return text;
}

std::string AmountsText(const NamedChange& change) {
  // Of a mass, its inertia is for programs; of all joints, each one is.
  const size_t most =
      change.what.joint < 0
          ? std::count_if(change.what.names.begin(), change.what.names.end(),
                          [](const std::string& name) {
                            return name.find(' ') == std::string::npos;
                          })
          : std::min<size_t>(4, change.what.names.size());
  std::string text;
  for (size_t k = 0; k < most; ++k) {
    text += (k > 0 ? ", " : "") + AmountText(change, k);
  }
  return text;
}

std::string FirstLog(const NamedChange& change,
                     const std::vector<std::string>& logs) {
  if (change.found.course.form == ChangeForm::kMotion)
    return ", e times as much:";
  return ", " + logs[change.found.course.log];
}

std::string ChangeLines(const std::vector<NamedChange>& changes,
                        const std::vector<std::string>& logs) {
  std::string text;
  for (const NamedChange& change : changes) {
    text += Format("  %3.0f %%  ", 100 * change.found.probability) +
            ChangeText(change) + " " + ChangeTime(change, logs.size()) +
            FirstLog(change, logs) + "\n         " + AmountsText(change) +
            "; " + change.reading + "\n";
    for (size_t k = 0; k < change.rivals.size(); ++k) {
      text +=
          Format("         or %.0f %% ", 100 * change.rival_probability[k]) +
          change.rivals[k] + "\n";
    }
  }
  return text;
}

json AmountsJson(const NamedChange& change) {
  json list = json::array();
  for (size_t k = 0; k < change.what.names.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const double value = change.seen[k] ? change.value[i] : NAN;
    const double stddev = change.seen[k] ? change.stddev[i] : NAN;
    list.push_back({{"name", change.what.names[k]},
                    {"unit", change.what.units[k]},
                    {"value", JsonNumber(value)},
                    {"stddev", JsonNumber(stddev)},
                    {"ci95",
                     {JsonNumber(value - 1.96 * stddev),
                      JsonNumber(value + 1.96 * stddev)}},
                    {"relative", JsonNumber(change.relative[k])}});
  }
  return list;
}

// Where in the logs, or with what of their motion, it goes.
json CourseJson(const FoundChange& found, const LogChanges& changes) {
  if (found.course.form == ChangeForm::kMotion) {
    return {{"measure", MotionMeasureName(found.course.shape)}};
  }
  json logs = json::array();
  for (const int log : found.logs) logs.push_back(log + 1);
  return {{"log", found.course.log + 1},
          {"log_name", changes.logs[found.course.log]},
          {"logs", logs}};
}

json ChangeJson(const NamedChange& change, const LogChanges& changes) {
  json rivals = json::array();
  for (size_t k = 0; k < change.rivals.size(); ++k) {
    rivals.push_back(
        {{"change", change.rivals[k]},
         {"probability", JsonNumber(change.rival_probability[k])}});
  }
  json told = {{"kind", ChangeFormName(change.found.course.form)},
               {"part", ChangedPartName(change.what.part)},
               {"place", change.place},
               {"joint_index", change.what.joint + 1},
               {"sentence", ChangeText(change) + " " +
                                ChangeTime(change, changes.logs.size())},
               {"amounts", AmountsJson(change)},
               {"any_probability", JsonNumber(change.found.any)},
               {"probability", JsonNumber(change.found.probability)},
               {"reading", change.reading},
               {"rivals", rivals}};
  told.update(CourseJson(change.found, changes));
  return told;
}

json SeriesJson(const Eigen::VectorXd& values) {
  json list = json::array();
  for (const double value : values) list.push_back(JsonNumber(value));
  return list;
}

}  // namespace

std::string BriefChanges(const LogChanges& changes) {
  std::string text;
  for (const NamedChange& change : changes.changes) {
    text += (text.empty() ? "From log to log: " : "; ") + ChangeText(change) +
            " " + ChangeTime(change, changes.logs.size());
  }
  return text.empty() ? "" : text + ".";
}

std::string FullChanges(const LogChanges& changes) {
  std::string text =
      Format("\nwhat changed over %zu logs\n", changes.logs.size());
  if (!changes.refusal.empty()) return text + "  " + changes.refusal + "\n";
  text += ChangeLines(changes.changes, changes.logs);
  if (changes.changes.empty()) text += "  no step and no drift";
  text += Format(
      "%s beyond what logs differ by anyway: all viscous friction "
      "together by %.2g %%, Coulomb by %.2g %%\n",
      changes.changes.empty() ? "" : "  all this",
      100 * changes.viscous_scatter, 100 * changes.coulomb_scatter);
  if (!changes.single_logs.empty()) {
    text += "  single logs, by their motion or their day\n" +
            ChangeLines(changes.single_logs, changes.logs);
  }
  if (!changes.with_motion.empty()) {
    text +=
        "  may go with how the robot moved in these logs, and be no change\n" +
        ChangeLines(changes.with_motion, changes.logs);
  }
  return text;
}

json ChangesJson(const std::vector<NamedChange>& list,
                 const LogChanges& changes) {
  json all = json::array();
  for (const NamedChange& change : list) {
    all.push_back(ChangeJson(change, changes));
  }
  return all;
}

json ToJson(const LogChanges& changes) {
  json series = json::array();
  for (const ParameterSeries& parameter : changes.parameters) {
    series.push_back({{"name", parameter.name},
                      {"unit", parameter.unit},
                      {"joint_index", parameter.joint + 1},
                      {"joint_term", parameter.is_joint_term},
                      {"value", SeriesJson(parameter.value)},
                      {"stddev", SeriesJson(parameter.stddev)},
                      {"model", SeriesJson(parameter.model)},
                      {"scatter", JsonNumber(parameter.scatter)}});
  }
  return {{"reason", changes.refusal},
          {"logs", changes.logs},
          {"changes", ChangesJson(changes.changes, changes)},
          {"single_logs", ChangesJson(changes.single_logs, changes)},
          {"with_motion", ChangesJson(changes.with_motion, changes)},
          {"series", series},
          {"scatter",
           {{"viscous", JsonNumber(changes.viscous_scatter)},
            {"coulomb", JsonNumber(changes.coulomb_scatter)},
            {"inflation", JsonNumber(changes.inflation)}}}};
}

}  // namespace armcal
