#include "calib/force_torque/change.h"

#include <algorithm>
#include <cmath>

#include "calib/force_torque/report.h"
#include "calib/numerics/json_figures.h"
#include "calib/numerics/median.h"
#include "calib/numerics/undefined.h"
#include "model/text/format.h"

namespace armcal {
namespace {

constexpr double kInterval = 1.96;  // standard deviations, 95 %

// Of a sample's six residuals in units of their noise, and of its force, N.
struct ResidualLength {
  double relative = 0, force = 0;
};

std::vector<ResidualLength> LengthsOf(const ForceTorqueFit& fit,
                                      const ForceTorqueSamples& samples) {
  std::vector<ResidualLength> lengths;
  for (const ForceTorqueSample& s : samples) {
    const Vector6d r = s.wrench - fit.model.Predict(s.motion);
    lengths.push_back({r.cwiseQuotient(fit.noise).norm(), r.head<3>().norm()});
  }
  return lengths;
}

double ContactThreshold(const ForceTorqueFit& reference,
                        const ForceTorqueSamples& samples) {
  constexpr double kNormal = 6.19;  // chi of six coordinates, one in 10^6
  constexpr double kMargin = 2, kShare = .99;
  std::vector<double> relative;
  for (const ResidualLength& length : LengthsOf(reference, samples)) {
    relative.push_back(length.relative);
  }
  return std::max(kNormal, kMargin * Quantile(relative, kShare));
}

std::vector<ForceTorqueContact> FindContacts(
    const std::vector<ResidualLength>& lengths, double threshold,
    const ForceTorqueSamples& samples) {
  constexpr double kApart = .25, kShortest = .05;  // s
  std::vector<ForceTorqueContact> all;
  for (size_t k = 0; k < samples.size(); ++k) {
    if (lengths[k].relative <= threshold) continue;
    const ForceTorqueSample& s = samples[k];
    const bool goes_on = !all.empty() && all.back().log == s.log &&
                         s.t - all.back().end < kApart;
    if (!goes_on) all.push_back({s.log, s.t, s.t, 0});
    all.back().end = s.t;
    all.back().force = std::max(all.back().force, lengths[k].force);
  }
  all.erase(std::remove_if(all.begin(), all.end(),
                           [](const ForceTorqueContact& c) {
                             return c.end - c.begin < kShortest;
                           }),
            all.end());
  return all;
}

}  // namespace

ForceTorqueChange CompareForceTorque(const ForceTorqueSamples& before,
                                     const ForceTorqueSamples& now) {
  ForceTorqueChange change;
  change.before = EstimateForceTorqueSensor(before);
  change.now = EstimateForceTorqueSensor(now);
  change.mass = change.mass_stddev = kNaN;
  if (!change.is_told()) return change;
  constexpr int kMass = ForceTorqueModel::kMass;
  change.mass = change.now.fit.model.mass - change.before.fit.model.mass;
  change.mass_stddev =
      std::hypot(change.now.Stddev(kMass), change.before.Stddev(kMass));
  change.contacts =
      FindContacts(LengthsOf(change.now.fit, now),
                   ContactThreshold(change.before.fit, before), now);
  return change;
}

nlohmann::json ForceTorqueJson(const ForceTorqueChange& change,
                               const std::vector<std::string>& logs) {
  const double half = kInterval * change.mass_stddev;
  nlohmann::json contacts = nlohmann::json::array();
  for (const ForceTorqueContact& c : change.contacts) {
    contacts.push_back({{"log", logs[c.log]},
                        {"begin", c.begin},
                        {"end", c.end},
                        {"peak_force", c.force}});
  }
  return {{"mass_change", JsonNumber(change.mass)},
          {"mass_change_stddev", JsonNumber(change.mass_stddev)},
          {"ci95",
           {JsonNumber(change.mass - half), JsonNumber(change.mass + half)}},
          {"contacts", contacts},
          {"reference", ForceTorqueJson(change.before)},
          {"logs", ForceTorqueJson(change.now)}};
}

std::string ForceTorqueText(const ForceTorqueChange& change) {
  if (!change.is_told()) {
    std::string text;
    for (const auto* sensor : {&change.before, &change.now}) {
      for (const std::string& why : sensor->not_told) {
        text += std::string("force-torque sensor  the ") +
                (sensor == &change.before ? "reference" : "logs") +
                " cannot tell " + why + "\n";
      }
    }
    return text;
  }
  const double half = kInterval * change.mass_stddev;
  std::string text = Format(
      "force-torque sensor  carries %+.3g kg beside the reference (95 "
      "%%: %+.3g "
      "to %+.3g kg), told by it alone\n",
      change.mass, change.mass - half, change.mass + half);
  if (change.contacts.empty()) {
    return text + "force-torque sensor  nothing but its load acts on it\n";
  }
  const auto strongest = std::max_element(
      change.contacts.begin(), change.contacts.end(),
      [](const auto& a, const auto& b) { return a.force < b.force; });
  return text + Format(
                    "force-torque sensor  more than its load acts on it in %zu "
                    "stretch%s, most from %.2f to %.2f s with up to %.3g N\n",
                    change.contacts.size(),
                    change.contacts.size() > 1 ? "es" : "", strongest->begin,
                    strongest->end, strongest->force);
}

}  // namespace armcal
