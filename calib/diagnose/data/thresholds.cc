#include "calib/diagnose/data/thresholds.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace armcal {
namespace {

using T = Thresholds;
using Kind = ThresholdInfo::Kind;

const std::vector<ThresholdInfo> kAll = {
    // What the model may vary
    {"reversal_width", &T::reversal_width, "rad/s",
     "Speed over which friction changes sign (0.3 of it in m/s), where "
     "no calibration tells",
     Kind::kTuned, "a prototype's simulated arms, of 5 to 12 mrad/s"},
    {"width_mixture", &T::width_mixture, "Coulomb friction",
     "How much of it may change sign over other speeds", Kind::kTuned,
     "a prototype's simulated arms, of 5 to 12 mrad/s"},
    {"offset_share", &T::offset_share, "usual torque",
     "How well a torque's zero is known", Kind::kTuned,
     "nothing that was noted, on 2026-11-20"},
    {"reversal_extra_stddev", &T::reversal_extra_stddev, "prior deviation",
     "Of the ways through zero velocity, how much of them is an extra "
     "deviation of the samples next to it",
     Kind::kTuned, "107 calibration cases of seed 301 and a UR10e"},
    {"reconstructed_torque_stddev", &T::reconstructed_torque_stddev,
     "usual torque", "How well reconstructed torques are known, at best",
     Kind::kTuned,
     "the 618 cases of seed 850757257, after their evaluation, and seed 93: "
     ".005 and .002 were tried"},
    // What models lack as a rule
    {"discrepancy", &T::discrepancy, "usual torque",
     "Torque of position, of the joint's load, and of all positions and "
     "velocities, rms each",
     Kind::kTuned,
     "90 simulated arms with and without misfit, and a KR300, a TX40 and "
     "a UR10e"},
    {"discrepancy_of_sign", &T::discrepancy_of_sign, "usual torque",
     "Torque of position that turns with the direction of motion, and "
     "torque of time, rms each",
     Kind::kTuned,
     "90 simulated arms with and without misfit, and a KR300, a TX40 and "
     "a UR10e"},
    {"least_discrepancy", &T::least_discrepancy, "discrepancy",
     "The best of models lack no less than this share of it: a smaller effect "
     "is none",
     Kind::kDefinition, "the smallest discrepancy that a log can ask for"},
    {"discrepancy_friction_curve", &T::discrepancy_friction_curve,
     "Coulomb friction", "How far its curve over speed may differ",
     Kind::kTuned,
     "90 simulated arms with and without misfit, and a KR300, a TX40 and "
     "a UR10e"},
    {"discrepancy_cycles", &T::discrepancy_cycles, "1 per turn",
     "Cycles over position, rms; higher ones are smaller", Kind::kTuned,
     "90 simulated arms with and without misfit, and a KR300, a TX40 and "
     "a UR10e"},
    {"discrepancy_state_frequency", &T::discrepancy_state_frequency, "1",
     "rms rad per unit of a state's standard deviation", Kind::kTuned,
     "90 simulated arms with and without misfit, and a KR300, a TX40 and "
     "a UR10e"},
    // From day to day
    {"by_chance", &T::by_chance, "standard deviations",
     "What is looked at by itself is more than chance beyond this, and tests "
     "have the same tail",
     Kind::kLaw, "0.27 % of a normal distribution"},
    {"clear_of_many", &T::clear_of_many, "standard deviations",
     "What is looked at on many joints or parameters at once is clear "
     "beyond this",
     Kind::kLaw, "5e-7 by chance"},
    {"several_joints", &T::several_joints, "joints",
     "So many joints changed together are another day", Kind::kDefinition,
     "what another day is"},
    // Noise of the torque
    {"noise_rows", &T::noise_rows, "samples",
     "The fewest that tell a joint's noise: its deviation to a tenth",
     Kind::kLaw, "its standard error is 1 / sqrt(2 n): 9 %"},
    {"shortest_period", &T::shortest_period, "s",
     "Motion that repeats sooner is no repeat", Kind::kDefinition,
     "a motion between two postures takes longer"},
    {"repeat_tolerance", &T::repeat_tolerance, "rms motion",
     "Motion is the same again within this share", Kind::kTuned,
     "nothing that was noted, on 2026-11-20"},
    {"extra_variance_of_noise", &T::extra_variance_of_noise, "variance",
     "By what share the noise told from repeats, a reference or "
     "positions may be larger",
     Kind::kTuned,
     "107 calibration cases of seed 301; 250 independent rows tell a variance "
     "so well"},
    {"extra_variance_of_others", &T::extra_variance_of_others, "variance",
     "The same of noise that was not told in motion, or by what a refit "
     "leaves: "
     "clocks, encoders and what the model lacks add to it",
     Kind::kTuned, "107 calibration cases of seed 301"},
    {"creep_speed", &T::creep_speed, "rad/s or m/s",
     "Below it a joint whose command rests creeps", Kind::kTuned,
     "calibration cases of seeds 91 to 94: 4 of 5 false alarms were contacts "
     "made of creep"},
    {"smooth_power", &T::smooth_power, "noise power",
     "What is left of the torque above a low pass, over the noise's "
     "power, where a delay is to be told from it",
     Kind::kTuned,
     "177 cases of elasticity and delay of seeds 839538295, 1917308019 and "
     "641418970"},
    {"burst", &T::burst, "usual torque",
     "A second whose torque above the bandwidth is beyond this rings",
     Kind::kDefinition, "what a loop is that rings"},
    {"position_only", &T::position_only, "torque",
     "Torque that a law of position alone leaves less of was computed, "
     "not measured",
     Kind::kTuned, "handguided log of a pendulum, and logs with torques"},
    {"least_inertial", &T::least_inertial, "torque",
     "A joint whose inertial share is less tells nothing of that", Kind::kTuned,
     "handguided log of a pendulum, and logs with torques"},
    // Choice
    {"score", &T::score, "chi^2",
     "An effect's delta chi^2 less its penalty has to exceed it", Kind::kTuned,
     "the misses and false alarms of calibration cases of seeds 303 and 304: "
     "25 before"},
    {"same_joint_share", &T::same_joint_share, "delta_chi2",
     "One more effect on a joint has to explain this share of the "
     "strongest's delta chi^2: laws' forms are never quite right",
     Kind::kTuned, "a prototype's simulated arm of six joints"},
    {"other_joint_share", &T::other_joint_share, "delta_chi2",
     "The same elsewhere", Kind::kTuned,
     "a prototype's simulated arm of six joints"},
    {"most_effects", &T::most_effects, "effects", "More are not chosen",
     Kind::kDefinition, "what a report can hold"},
    {"near_zero_penalty", &T::near_zero_penalty, "chi^2",
     "More for laws that act next to zero velocity only, where models of "
     "friction err",
     Kind::kTuned,
     "simulated robots without effects: 40 to 60 where others stayed "
     "below 25"},
    {"odds_of_same_construction", &T::odds_of_same_construction, "1",
     "Before the data, that a change since the reference is none of the arm's "
     "lengths, masses and rotors",
     Kind::kTuned, "one arm in ten was rebuilt since"},
    {"chance_quantile", &T::chance_quantile, "quantile",
     "Beyond what random signs of blocks give in this share of draws",
     Kind::kLaw, "significance of 1 %"},
    {"block", &T::block, "s",
     "Torque that is left, and its maxima, are independent from block to "
     "block",
     Kind::kTuned, "107 calibration cases of seed 301"},
    // Contacts
    {"false_contacts", &T::false_contacts, "logs",
     "At most this share of logs without a contact has one found", Kind::kLaw,
     "significance of 1 %"},
    {"odds_of_no_contact", &T::odds_of_no_contact, "1",
     "Before the log is looked at", Kind::kTuned, "one log in ten has a touch"},
    {"shortest_push", &T::shortest_push, "s", "Shorter ones are not looked for",
     Kind::kDefinition, "what a contact is"},
    {"fewest_blocks", &T::fewest_blocks, "blocks",
     "Shorter blocks in short logs, to have so many; fewer tell no upper "
     "quartile",
     Kind::kTuned,
     "nothing that was noted, on 2026-11-20; two of eight are beyond the upper "
     "quartile"},
    {"breakaway", &T::breakaway, "s",
     "How long after a rest a joint may still be breaking away", Kind::kTuned,
     "dfki_simple_pendulum"},
    {"static_friction", &T::static_friction, "sliding friction",
     "What a joint holds that breaks away", Kind::kLaw,
     "hard steel on hard steel, dry: Marks' Standard Handbook for "
     "Mechanical Engineers"},
    {"clear_friction", &T::clear_friction, "Coulomb friction",
     "Where the model's friction is beyond this its sign is clear",
     Kind::kTuned, "nothing that was noted, on 2026-11-20"},
    {"near_rest", &T::near_rest, "s",
     "A contact at rest has the arm at rest within this time", Kind::kTuned,
     "nothing that was noted, on 2026-11-20"},
    {"same_posture", &T::same_posture, "rad or m",
     "in a posture not farther away", Kind::kDefinition,
     "what the same posture is"},
    {"usual_lever", &T::usual_lever, "longest lever",
     "A force with shorter levers about all joints is improbable", Kind::kTuned,
     "isotropic directions"},
    {"event_reach", &T::event_reach, "widths",
     "How far to both sides an event is left out", Kind::kLaw,
     "exp(-2.5^2): 0.2 % of its peak is left"},
    {"usual_motion", &T::usual_motion, "quantile",
     "Of a reference's speeds and accelerations: pulses are looked for where "
     "none is beyond",
     Kind::kDefinition,
     "a reference's usual motion: what it has 5 % of the "
     "time tells the noise there, a jump of an encoder "
     "does not"},
    // Probability and claims
    {"temperature", &T::temperature, "1",
     "Divides scores: neither noise nor catalogue nor forms are as a "
     "score assumes",
     Kind::kTuned, "the 95 % sets of 141 simulated cases held the truth"},
    {"credible", &T::credible, "quantile",
     "Of the set of candidates; what is significant is outside of it",
     Kind::kLaw, "the convention of intervals and tests"},
    {"likely", &T::likely, "1", "What is less likely is a candidate, no more",
     Kind::kLaw, "even odds"},
    {"likely_unseen", &T::likely_unseen, "1",
     "The same of what held-out data do not show", Kind::kTuned,
     "the 618 cases of seed 567429353, after their evaluation"},
    {"form_error", &T::form_error, "delta_chi2",
     "What the form of a law may have wrong of its delta chi^2", Kind::kTuned,
     "cases 938 and 426 of seed 962768770, after their evaluation"},
    {"visible", &T::visible, "chi^2",
     "Held-out data that should have more of an effect contradict it "
     "where they have none",
     Kind::kLaw,
     "explained is N(E, 4 E) of an effect that is there: below 0 in 1 % where "
     "E = 4 (2.33)^2"},
    {"confirmation", &T::confirmation, "chi^2",
     "Held-out data that should have less of an effect tell little", Kind::kLaw,
     "explained / expected is the share within 2 / sqrt(expected); its "
     "mean given N(0, 1) before"},
    {"seen_again", &T::seen_again, "1",
     "Held-out data that have this share of what they should show it",
     Kind::kTuned, "the 618 cases of seed 567429353, after their evaluation"},
    {"untold", &T::untold, "1",
     "What held-out data cannot tell is at most this probable", Kind::kLaw,
     "indifference"},
    {"few", &T::few, "effects",
     "So many that data cannot tell apart are named together",
     Kind::kDefinition, "what a sentence can hold"},
    {"explains", &T::explains, "gap",
     "What is claimed may remove this share of it: more than it leaves",
     Kind::kDefinition, "what explains"},
    // Verdict
    {"left", &T::left, "gap",
     "and this share of what was there; effects that leave more explain "
     "in part",
     Kind::kDefinition, "the verdicts `explained` and `unknown`"},
    {"absorbed", &T::absorbed, "gap",
     "A refit that leaves less than this has absorbed it", Kind::kDefinition,
     "the verdict `absorbed`"},
    {"louder_in_motion", &T::louder_in_motion, "variance",
     "Noise that was told at rest may be so much louder in motion",
     Kind::kTuned,
     "calibration cases of seed 303 and 78 withheld ones of seed 1"},
    {"most_of_time", &T::most_of_time, "log",
     "Windows that stand out in more of it were no touch", Kind::kDefinition,
     "what a touch is"},
    {"same_state", &T::same_state, "usual motion",
     "Positions and velocities that are no farther apart, rms over joints, are "
     "the same",
     Kind::kDefinition, "what coming back is"},
    {"material", &T::material, "noise",
     "nor one of usual size that is smaller, rms", Kind::kDefinition,
     "what is `not testable`"},
    {"far", &T::far, "standard deviations",
     "A parameter that is farther from the file's is told", Kind::kLaw,
     "95 % of a normal distribution"},
    {"notable", &T::notable, "usual change", "One of a day is told beyond this",
     Kind::kDefinition, "what is listed as `absorbed`"},
    {"order", &T::order, "chi^2",
     "Residuals are ordered by what their bins show beyond this", Kind::kLaw,
     "chi^2 of 10 bins, 99.9 %, seven coordinates"},
    {"fewest_logs", &T::fewest_logs, "logs", "A drift needs so many",
     Kind::kLaw, "two points are a line"},
};

Thresholds& Own() {
  static Thresholds thresholds;
  return thresholds;
}

double& Named(const std::string& name) {
  for (const ThresholdInfo& known : ListThresholds()) {
    if (name == known.name) return Own().*known.value;
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

double SeveralOf(int joints) {
  return std::min<double>(Limits().several_joints, joints);
}

// P(|x| > z) = erfc(z / sqrt 2) of a standard normal x.
double ChanceBeyond() { return std::erfc(Limits().by_chance / std::sqrt(2.)); }

const std::vector<ThresholdInfo>& ListThresholds() { return kAll; }

void SetThresholds(const std::string& values) {
  std::istringstream list(values);
  for (std::string entry; std::getline(list, entry, ',');) {
    const size_t equals = entry.find('=');
    if (equals == std::string::npos) {
      throw std::invalid_argument("\"" + entry + "\" is not name=value");
    }
    Named(entry.substr(0, equals)) = PositiveNumber(entry.substr(equals + 1));
  }
}

}  // namespace armcal
