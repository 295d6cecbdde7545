#include "calib/drive_gains/reasons.h"

#include <algorithm>
#include <utility>

#include "model/text/option_name.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr int kMoments = 9;  // the payload's, last of (g, x, p)

}  // namespace

GainReasons::GainReasons(const GainSensitivity& sensitivity, bool has_payload)
    : sensitivity_(sensitivity), has_payload_(has_payload) {}

void GainReasons::Add(bool has_current, const VectorXd& gradient,
                      bool identifiable) {
  joints_.push_back({has_current, gradient, identifiable});
}

// Whether the gain would be seen ten times better, or at all, if the payload's
// centre of mass and inertia were known.
bool GainReasons::MomentsHide(const Joint& joint) const {
  const int size = static_cast<int>(joint.gradient.size());
  std::vector<int> known;
  for (int k = size - kMoments; k < size; ++k) known.push_back(k);
  const GainSensitivity with_known(sensitivity_, known);
  const VectorXd& d = joint.gradient;
  if (!with_known.Sees(d)) return false;
  return !sensitivity_.Sees(d) ||
         d.dot(sensitivity_.Gain() * d) > 100 * d.dot(with_known.Gain() * d);
}

std::string GainReasons::Text(Eigen::Index index) const {
  const Joint& joint = joints_[index];
  if (joint.identifiable) return "";
  if (!joint.has_current) {
    return "its current is zero throughout the logs of the bare arm or those "
           "with the payload";
  }
  if (!has_payload_) {
    return "currents of a bare arm show only products of torque constant and "
           "inertia; a log with a known payload (" +
           OptionName("payload_mass") + ", " + OptionName("payload_log") +
           ") shows their scale";
  }
  if (MomentsHide(joint)) {
    return "in the motion with the payload its mass cannot be told from its "
           "centre of mass and inertia; more joints must move there, through "
           "wider angles";
  }
  if (sensitivity_.Sees(joint.gradient)) {
    return "current per torque is not three standard deviations clear of 0, "
           "as the payload's mass hardly shows; more joints in motion, a "
           "heavier payload or longer logs with it help";
  }
  const bool others =
      std::any_of(joints_.begin(), joints_.end(),
                  [](const Joint& other) { return other.identifiable; });
  return others ? "it shows neither the payload's mass nor an inertia that it "
                  "shares with a joint which does"
                : "the payload's mass does not show in the currents";
}

std::string GainVerdict(const std::vector<DriveGain>& gains) {
  // Joints of the same reason, in the order of the first.
  std::vector<std::pair<std::string, std::string>> joints_of;
  size_t unseen = 0;
  for (const DriveGain& gain : gains) {
    if (gain.identifiable) continue;
    ++unseen;
    auto at = std::find_if(
        joints_of.begin(), joints_of.end(),
        [&gain](const auto& entry) { return entry.first == gain.reason; });
    if (at == joints_of.end()) {
      joints_of.emplace_back(gain.reason, gain.name);
    } else {
      at->second += ", " + gain.name;
    }
  }
  const bool one_for_all = unseen == gains.size() && joints_of.size() == 1;
  std::string text;
  for (const auto& [reason, joints] : joints_of) {
    text += text.empty() ? "the torque scale is not observable" : ";";
    text += (one_for_all ? ": " : " of " + joints + ": ") + reason;
  }
  return text;
}

}  // namespace armcal
