#include "calib/diagnose/data/thresholds.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace armcal {
namespace {

Thresholds& Own() {
  static Thresholds thresholds;
  return thresholds;
}

Threshold& Named(const std::string& name) {
  for (const NamedThreshold& known : ListThresholds()) {
    if (name == known.name) return Own().*known.threshold;
  }
  throw std::invalid_argument("no threshold \"" + name +
                              "\" (docs/thresholds.md has all)");
}

double PositiveNumber(const std::string& text) {
  size_t used = 0;
  double value = 0;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
  }
  if (used == 0 || used != text.size() || !(value > 0) ||
      !std::isfinite(value)) {
    throw std::invalid_argument("\"" + text + "\" is no positive number");
  }
  return value;
}

}  // namespace

const Thresholds& Limits() { return Own(); }

const std::vector<NamedThreshold>& ListThresholds() {
  using T = Thresholds;
  static const std::vector<NamedThreshold> all = {
      {"timing_with_reference", &T::timing_with_reference},
      {"reversal_of_made_torques", &T::reversal_of_made_torques},
      {"reversal_width", &T::reversal_width},
      {"width_mixture", &T::width_mixture},
      {"offset_share", &T::offset_share},
      {"reversal_doubt", &T::reversal_doubt},
      {"reversal_doubt_of_made", &T::reversal_doubt_of_made},
      {"made_torque_doubt", &T::made_torque_doubt},
      {"lacked_over_position", &T::lacked_over_position},
      {"lacked_over_position_and_sign", &T::lacked_over_position_and_sign},
      {"lacked_over_load", &T::lacked_over_load},
      {"lacked_over_state", &T::lacked_over_state},
      {"lacked_over_time", &T::lacked_over_time},
      {"lacked_friction_curve", &T::lacked_friction_curve},
      {"lacked_cycles", &T::lacked_cycles},
      {"lacked_state_frequency", &T::lacked_state_frequency},
      {"told_of_day", &T::told_of_day},
      {"clear_of_many", &T::clear_of_many},
      {"several_joints", &T::several_joints},
      {"noise_rows", &T::noise_rows},
      {"shortest_period", &T::shortest_period},
      {"ends_without_repeat", &T::ends_without_repeat},
      {"repeat_tolerance", &T::repeat_tolerance},
      {"doubt_of_noise", &T::doubt_of_noise},
      {"doubt_of_rest", &T::doubt_of_rest},
      {"doubt_of_residual", &T::doubt_of_residual},
      {"creep_speed", &T::creep_speed},
      {"smooth_power", &T::smooth_power},
      {"burst", &T::burst},
      {"burst_over_fast", &T::burst_over_fast},
      {"burst_reach", &T::burst_reach},
      {"position_only", &T::position_only},
      {"least_inertial", &T::least_inertial},
      {"score", &T::score},
      {"same_joint_share", &T::same_joint_share},
      {"other_joint_share", &T::other_joint_share},
      {"most_effects", &T::most_effects},
      {"near_zero_price", &T::near_zero_price},
      {"chance_quantile", &T::chance_quantile},
      {"block", &T::block},
      {"false_contacts", &T::false_contacts},
      {"odds_of_no_contact", &T::odds_of_no_contact},
      {"shortest_push", &T::shortest_push},
      {"maxima_block", &T::maxima_block},
      {"fewest_blocks", &T::fewest_blocks},
      {"breakaway", &T::breakaway},
      {"static_friction", &T::static_friction},
      {"clear_friction", &T::clear_friction},
      {"near_rest", &T::near_rest},
      {"same_posture", &T::same_posture},
      {"usual_lever", &T::usual_lever},
      {"event_reach", &T::event_reach},
      {"fewest_maxima", &T::fewest_maxima},
      {"temperature", &T::temperature},
      {"credible", &T::credible},
      {"least_claimed", &T::least_claimed},
      {"likely", &T::likely},
      {"likely_unseen", &T::likely_unseen},
      {"form_error", &T::form_error},
      {"visible", &T::visible},
      {"helps", &T::helps},
      {"confirmation", &T::confirmation},
      {"seen_again", &T::seen_again},
      {"untold", &T::untold},
      {"most_odds", &T::most_odds},
      {"tells", &T::tells},
      {"real", &T::real},
      {"left", &T::left},
      {"absorbed", &T::absorbed},
      {"louder_in_motion", &T::louder_in_motion},
      {"most_of_time", &T::most_of_time},
      {"visible_share", &T::visible_share},
      {"material", &T::material},
      {"far", &T::far},
      {"notable", &T::notable},
      {"order", &T::order},
      {"fewest_logs", &T::fewest_logs},
  };
  return all;
}

void SetThresholds(const std::string& values) {
  std::istringstream list(values);
  for (std::string entry; std::getline(list, entry, ',');) {
    const size_t equals = entry.find('=');
    if (equals == std::string::npos) {
      throw std::invalid_argument("\"" + entry + "\" is not name=value");
    }
    Named(entry.substr(0, equals)).value =
        PositiveNumber(entry.substr(equals + 1));
  }
}

}  // namespace armcal
