#include "calib/diagnose/changes/changes.h"

#include <cmath>
#include <functional>
#include <limits>

#include "calib/diagnose/changes/series_scatter.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A change is told where it is 19 times as likely as none that goes with how
// the robot moved: an interval of 95 %.
constexpr double kMayBeMotion = .05;

// What was looked for, and found.
struct SeriesSearch {
  std::vector<NamedHypothesis> hypotheses;
  std::vector<ScatterComponent> components;
  SeriesChanges found;
};

// Each log is one step of time.
VectorXd TimesOf(const LogSeries& series) {
  return VectorXd::LinSpaced(series.size(), 0, series.size() - 1);
}

SeriesSearch SearchSeries(const Robot& robot, const LogSeries& series,
                          const MatrixXd& levels) {
  SeriesSearch told{MakeHypotheses(robot, series, levels),
                    MakeScatter(series, levels.col(0)),
                    {}};
  std::vector<ChangeHypothesis> changes;
  for (const NamedHypothesis& named : told.hypotheses) {
    changes.push_back(named.change);
  }
  told.found =
      FindChanges(series.equations, told.components, changes, TimesOf(series));
  return told;
}

std::string ChangePlace(const Robot& robot, const NamedHypothesis& what) {
  if (what.joint < 0) return "";
  const Link& link = robot.links[what.joint];
  return what.part == ChangedPart::kMass ? link.name : link.joint.name;
}

// What makes such changes as a rule.
std::string ChangeReading(const NamedHypothesis& what, const FoundChange& found,
                          bool last_link) {
  switch (what.part) {
    case ChangedPart::kAllFriction:
      return "temperature or lubricant";
    case ChangedPart::kFriction:
      if (found.course.form != ChangeForm::kDrift) {
        return "this joint's seal, brake, bearing or lubricant";
      }
      return found.value.sum() > 0 ? "wear" : "running in, or warming";
    case ChangedPart::kOffset:
      return "torque zero, a spring or a balance";
    case ChangedPart::kArmature:
      return "rotor or gear";
    case ChangedPart::kTorqueScale:
      return "torque constant or torque sensor";
    case ChangedPart::kAllScales:
      return "temperature of the motors, supply or units";
    case ChangedPart::kMass:
      return last_link ? "tool or load"
                       : "something fixed to this link or taken off it";
  }
  return "";
}

// Relative to the parameter as it was, where it is friction.
double RelativeOf(const NamedHypothesis& what, size_t amount, double value,
                  const LogSeries& series, const VectorXd& level) {
  if (what.units[amount] == "1") return value;
  if (what.part != ChangedPart::kFriction) return NAN;
  const JointTerm term =
      what.names[amount] == JointTermName(JointTerm::kViscous)
          ? JointTerm::kViscous
          : JointTerm::kCoulomb;
  const double before = level[series.TermIndex(what.joint, term)];
  return before > 0 ? value / before : NAN;
}

NamedChange NameChange(const Robot& robot, const LogSeries& series,
                       const SeriesSearch& told, const VectorXd& level,
                       const FoundChange& found) {
  constexpr double kWorthSaying = .02;
  // Of the prior's standard deviation: what is known no better was not seen.
  constexpr double kSeen = .5;
  NamedChange change;
  change.what = told.hypotheses[found.hypothesis];
  change.found = found;
  change.place = ChangePlace(robot, change.what);
  change.reading =
      found.course.form == ChangeForm::kMotion
          ? "no change of the robot: its model is not that of all motions"
          : ChangeReading(change.what, found,
                          change.what.joint + 1 == robot.num_joints());
  const MatrixXd& told_of = change.what.told;
  change.value = told_of * found.value;
  change.stddev =
      (told_of * found.covariance * told_of.transpose()).diagonal().cwiseSqrt();
  const VectorXd prior =
      (told_of * change.what.change.prior.asDiagonal()).rowwise().norm();
  for (size_t k = 0; k < change.what.names.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    change.seen.push_back(change.stddev[i] < kSeen * prior[i]);
    change.relative.push_back(
        RelativeOf(change.what, k, change.value[i], series, level));
  }
  for (const FoundChange::Rival& rival : found.rivals) {
    if (rival.probability < kWorthSaying) break;
    const NamedHypothesis& other = told.hypotheses[rival.hypothesis];
    const std::string place = ChangePlace(robot, other);
    change.rivals.push_back(ChangeFormName(rival.form) + std::string(" of ") +
                            ChangedPartName(other.part) +
                            (place.empty() ? "" : " " + place));
    change.rival_probability.push_back(rival.probability);
  }
  return change;
}

// Each log's parameters (parameters x logs) with some of the changes; `level`:
// those of the first.
MatrixXd LevelsWith(const LogSeries& series, const SeriesSearch& told,
                    const VectorXd& level,
                    const std::function<bool(const NamedHypothesis&)>& counts) {
  MatrixXd levels = level.replicate(1, series.size());
  for (const FoundChange& found : told.found.changes) {
    const NamedHypothesis& what = told.hypotheses[found.hypothesis];
    if (!counts(what)) continue;
    const VectorXd course =
        CourseOf(found.course, TimesOf(series), what.change.motion);
    for (int l = 0; l < series.size(); ++l) {
      levels.col(l) += course[l] * series.torque.cwiseProduct(
                                       what.directions[l] * found.value);
    }
  }
  return levels;
}

// Each log's parameters, as its own equations have them and with the changes.
std::vector<ParameterSeries> ParametersOver(const LogSeries& series,
                                            const SeriesSearch& told,
                                            const VectorXd& level) {
  MatrixXd stddev;
  const MatrixXd own = series.Own(told.found.scatter.inflation, &stddev);
  const MatrixXd model = LevelsWith(
      series, told, level, [](const NamedHypothesis&) { return true; });
  VectorXd variance = VectorXd::Zero(level.size());
  for (size_t c = 0; c < told.components.size(); ++c) {
    const double size = told.found.scatter.stddev[static_cast<Eigen::Index>(c)];
    variance += (size * told.components[c].direction).cwiseAbs2();
  }
  std::vector<ParameterSeries> parameters;
  for (int k = 0; k < series.parameters.size(); ++k) {
    const ModelParameter& p = series.parameters.parameters()[k];
    parameters.push_back({p.name, p.unit, p.block, p.is_joint_term, own.row(k),
                          stddev.row(k), model.row(k),
                          series.torque[k] * std::sqrt(variance[k])});
  }
  return parameters;
}

}  // namespace

LogChanges FindLogChanges(const Robot& robot, const LogSeries& series) {
  LogChanges result;
  result.logs = series.logs;
  if (series.equations.empty()) {
    result.refusal = "the logs together do not tell the robot's parameters";
    return result;
  }
  SeriesSearch told =
      SearchSeries(robot, series, series.pooled.replicate(1, series.size()));
  VectorXd level = series.pooled + series.torque.cwiseProduct(told.found.level);
  if (!told.found.changes.empty()) {
    // Friction relative to what it was before it changed; a factor on all of
    // it, to what it is after the other changes.
    const auto other = [](const NamedHypothesis& what) {
      return what.part != ChangedPart::kAllFriction;
    };
    told = SearchSeries(robot, series, LevelsWith(series, told, level, other));
    level = series.pooled + series.torque.cwiseProduct(told.found.level);
  }
  for (const FoundChange& found : told.found.changes) {
    (found.with_motion > kMayBeMotion         ? result.with_motion
     : found.course.form == ChangeForm::kOnce ? result.single_logs
                                              : result.changes)
        .push_back(NameChange(robot, series, told, level, found));
  }
  result.parameters = ParametersOver(series, told, level);
  const VectorXd& scatter = told.found.scatter.stddev;
  result.viscous_scatter = scatter[series.pooled.size()];
  result.coulomb_scatter = scatter[series.pooled.size() + 1];
  result.inflation = told.found.scatter.inflation;
  return result;
}

LogChanges FindLogChanges(const Robot& robot,
                          const std::vector<LogSource>& logs,
                          const LogReaderOptions& reading,
                          const TimeRange& crop,
                          std::optional<double> bandwidth_hz,
                          const Progress& progress) {
  LinearCalibrationOptions options;
  options.bandwidth_hz = bandwidth_hz;
  options.progress = progress;
  std::vector<std::string> names;
  for (const LogSource& log : logs) names.push_back(log.name);
  const Reduction reduction = ReduceSeries(robot, reading, options, logs, crop);
  if (progress) progress("what changed from log to log", -1);
  return FindLogChanges(robot, MakeSeries(robot, reduction, names));
}

}  // namespace armcal
