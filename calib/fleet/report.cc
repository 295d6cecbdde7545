#include "calib/fleet/report.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "calib/numerics/json_figures.h"
#include "calib/numerics/readable_sum.h"
#include "model/text/calendar_time.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using nlohmann::json;

constexpr double kDay = 86400;  // s

// Standard deviations with the fleet over those of a unit alone: the median of
// all parameters that it determines alone; NaN where there is none.
double Gain(const FleetCalibration& fleet, Eigen::Index unit) {
  std::vector<double> ratios;
  for (Eigen::Index k = 0; k < fleet.own.cols(); ++k) {
    const double own = fleet.own_stddev(unit, k);
    if (!std::isfinite(own) || !(own > 0)) continue;
    ratios.push_back(fleet.fit.unit_stddev(unit, k) / own);
  }
  if (ratios.empty()) return std::nan("");
  const auto middle = ratios.begin() + static_cast<long>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  return *middle;
}

std::string OutlierText(const LinearCalibration& pooled,
                        const FleetCalibration& fleet,
                        const FleetOptions& options) {
  const FleetFit& fit = fleet.fit;
  std::set<int> units;
  for (const FleetOutlier& o : fit.outliers) units.insert(o.unit);
  if (units.empty()) return "\nno unit is out of the ordinary\n";
  std::string text = Format(
      "\n%zu of %zu units %s out of the ordinary (a fleet without any has one "
      "named in %.3g %% of cases)\n",
      units.size(), fleet.units.size(), units.size() == 1 ? "is" : "are",
      100 * options.false_alarms);
  for (const FleetOutlier& o : fit.outliers) {
    const ModelParameter& p = pooled.parameters.parameters()[o.parameter];
    text += Format(
        "  %-16s %-28s %+.4g %s from the fleet's %.4g, +- %.2g; "
        "%.1f sigma\n",
        fleet.units[o.unit].c_str(), ReadableSum(p.name).c_str(), o.deviation,
        p.unit.c_str(), fit.mean[o.parameter], o.stddev, o.sigmas);
  }
  return text;
}

std::string DriftText(const LinearCalibration& pooled, const FleetFit& fit) {
  if (!fit.has_drift) return "no drift was looked for: dates are needed\n";
  std::string text;
  for (size_t k = 0; k < fit.drifts.size(); ++k) {
    if (!fit.drifts[k]) continue;
    const ModelParameter& p = pooled.parameters.parameters()[k];
    text += Format("drift      %s by %+.3g +- %.2g %s a day; %.1f sigma\n",
                   ReadableSum(p.name).c_str(), kDay * fit.drift[k],
                   kDay * fit.drift_stddev[k], p.unit.c_str(),
                   std::abs(fit.drift[k]) / fit.drift_stddev[k]);
  }
  return text.empty() ? "nothing drifts\n" : text;
}

json ParametersJson(const LinearCalibration& pooled, const FleetFit& fit) {
  json list = json::array();
  for (int k = 0; k < pooled.parameters.size(); ++k) {
    const ModelParameter& p = pooled.parameters.parameters()[k];
    const bool seen = fit.seen[k];
    json entry = {{"name", p.name},
                  {"unit", p.unit},
                  {"value", JsonNumber(fit.mean[k])},
                  {"stddev", seen ? JsonNumber(fit.mean_stddev[k]) : nullptr},
                  {"spread", JsonNumber(fit.spread[k])},
                  {"identifiable", seen},
                  {"drift_per_day", nullptr},
                  {"drift_stddev", nullptr},
                  {"drifts", bool(fit.drifts[k])}};
    if (fit.has_drift) {
      entry["drift_per_day"] = JsonNumber(kDay * fit.drift[k]);
      entry["drift_stddev"] = JsonNumber(kDay * fit.drift_stddev[k]);
    }
    list.push_back(entry);
  }
  return list;
}

json Numbers(const Eigen::VectorXd& values) {
  json list = json::array();
  for (const double x : values) list.push_back(JsonNumber(x));
  return list;
}

json UnitsJson(const FleetCalibration& fleet) {
  const FleetFit& fit = fleet.fit;
  json list = json::array();
  for (size_t u = 0; u < fleet.units.size(); ++u) {
    const auto row = static_cast<Eigen::Index>(u);
    const bool outlier =
        std::any_of(fit.outliers.begin(), fit.outliers.end(),
                    [&](const FleetOutlier& o) { return o.unit == row; });
    json entry = {{"name", fleet.units[u]},
                  {"logs", fleet.logs[u]},
                  {"equations", fleet.equations[u]},
                  {"outlier", outlier},
                  {"values", Numbers(fit.unit.row(row))},
                  {"stddev", Numbers(fit.unit_stddev.row(row))},
                  {"own_values", Numbers(fleet.own.row(row))},
                  {"own_stddev", Numbers(fleet.own_stddev.row(row))},
                  {"stddev_ratio", JsonNumber(Gain(fleet, row))},
                  {"time", nullptr}};
    if (fit.has_drift) entry["time"] = CalendarText(fit.unit_time[row]);
    list.push_back(entry);
  }
  return list;
}

}  // namespace

std::string FleetText(const Robot& robot, const LinearCalibration& pooled,
                      const FleetCalibration& fleet,
                      const FleetOptions& options) {
  const FleetFit& fit = fleet.fit;
  std::string text = Format(
      "\n%-36s fleet (standard error)      spread of units\n", "parameter");
  for (int k = 0; k < pooled.parameters.size(); ++k) {
    const ModelParameter& p = pooled.parameters.parameters()[k];
    text += Format("  %-30s ", ReadableSum(p.name).c_str());
    text += fit.seen[k] ? Format("%11.5g +- %-9.3g %12.3g ", fit.mean[k],
                                 fit.mean_stddev[k], fit.spread[k]) +
                              p.unit + "\n"
                        : Format("%11.5g (not seen)\n", fit.mean[k]);
  }
  text += OutlierText(pooled, fleet, options) + DriftText(pooled, fit);
  if (!fit.settled) {
    text += "which units are out of the ordinary did not settle\n";
  }
  std::vector<double> gains;
  for (size_t u = 0; u < fleet.units.size(); ++u) {
    const double gain = Gain(fleet, static_cast<Eigen::Index>(u));
    if (std::isfinite(gain)) gains.push_back(gain);
  }
  if (!gains.empty()) {
    std::sort(gains.begin(), gains.end());
    text += Format(
        "standard deviations of a unit are %.2f times those of its own logs "
        "alone (median; %.2f to %.2f)\n",
        gains[gains.size() / 2], gains.front(), gains.back());
  }
  return text + Format("%s: a fleet of %zu units\n", robot.name.c_str(),
                       fleet.units.size());
}

json ToJson(const Robot& robot, const LinearCalibration& pooled,
            const FleetCalibration& fleet, const FleetOptions& options) {
  const FleetFit& fit = fleet.fit;
  json outliers = json::array();
  for (const FleetOutlier& o : fit.outliers) {
    const ModelParameter& p = pooled.parameters.parameters()[o.parameter];
    outliers.push_back({{"unit", fleet.units[o.unit]},
                        {"parameter", p.name},
                        {"parameter_unit", p.unit},
                        {"deviation", JsonNumber(o.deviation)},
                        {"stddev", JsonNumber(o.stddev)},
                        {"sigmas", JsonNumber(o.sigmas)}});
  }
  json out = {{"format", "armcal fleet 1"},
              {"robot", robot.name},
              {"false_alarms", options.false_alarms},
              {"settled", fit.settled},
              {"reference_time", nullptr},
              {"parameters", ParametersJson(pooled, fit)},
              {"outliers", outliers},
              {"units", UnitsJson(fleet)}};
  if (fit.has_drift) {
    out["reference_time"] = CalendarText(fit.reference_time);
  }
  return out;
}

}  // namespace armcal
