#pragma once

#include <string>
#include <vector>

namespace armcal {

// A number that decides what a diagnosis says.
struct Threshold {
  // Whether its source is a law (a quantile, a convention, a measured value
  // that was published) or it was chosen on data.
  enum class Kind { kLaw, kTuned };

  double value;
  const char* unit;
  const char* meaning;
  Kind kind;
  const char* source;  // the law, or the data it was chosen on

  operator double() const { return value; }
};

// All of them, beside the weights of a claim's probability (judge/evidence.cc),
// the ranges of the catalogue's parameters (model/effects) and the sizes of
// grids and caps on rounds, which cost time and decide nothing.
// docs/thresholds.md has them as a table, with how much each decides.
struct Thresholds {
  using Kind = Threshold::Kind;

  // What the model may vary
  Threshold timing_with_reference = {
      .05, "s",
      "How far torque may lag behind position where a reference tells by "
      "how much",
      Kind::kTuned, "recorded logs of eight arms: 0 to 40 ms"};
  Threshold reversal_of_made_torques = {
      .005, "s",
      "When friction changes sign, beside a velocity whose low pass takes "
      "a stop for a turn; torques made of commands",
      Kind::kTuned, "the blind bench's calibration cases"};
  Threshold reversal_width = {
      6e-3, "rad/s",
      "Speed over which friction changes sign (0.3 of it in m/s), where "
      "no calibration tells",
      Kind::kTuned, "the blind bench's calibration cases"};
  Threshold width_mixture = {.5, "Coulomb friction",
                             "How much of it may change sign over other speeds",
                             Kind::kTuned,
                             "the blind bench's calibration cases"};
  Threshold offset_share = {
      .02, "usual torque", "How well a torque's zero is known", Kind::kTuned,
      "torque sensors and currents of the eight arms of tests/real"};
  Threshold reversal_doubt = {
      .3, "prior deviation",
      "Of the ways through zero velocity, how much of them is doubt of "
      "the samples next to it",
      Kind::kTuned, "the blind bench's calibration cases"};
  Threshold reversal_doubt_of_made = {
      .5, "prior deviation", "The same of torques made of commands",
      Kind::kTuned, "the blind bench's calibration cases"};
  Threshold made_torque_doubt = {
      .001, "usual torque",
      "How well torques made of commands are known, at best", Kind::kTuned,
      "the blind bench's calibration cases"};

  // What models lack as a rule
  Threshold lacked_over_position = {
      .01, "usual torque", "Torque of position, rms", Kind::kTuned,
      "90 simulated arms with and without misfit, and a KR300, a TX40 and "
      "a UR10e"};
  Threshold lacked_over_position_and_sign = {
      .005, "usual torque",
      "Torque of position that turns with the direction of motion, rms",
      Kind::kTuned,
      "90 simulated arms with and without misfit, and a KR300, a TX40 and "
      "a UR10e"};
  Threshold lacked_over_load = {
      .01, "usual torque", "Torque of the joint's load, rms", Kind::kTuned,
      "90 simulated arms with and without misfit, and a KR300, a TX40 and "
      "a UR10e"};
  Threshold lacked_over_state = {
      .01, "usual torque", "Torque of all positions and velocities, rms",
      Kind::kTuned,
      "90 simulated arms with and without misfit, and a KR300, a TX40 and "
      "a UR10e"};
  Threshold lacked_over_time = {
      .005, "usual torque", "Torque of time, rms", Kind::kTuned,
      "90 simulated arms with and without misfit, and a KR300, a TX40 and "
      "a UR10e"};
  Threshold lacked_friction_curve = {
      .1, "Coulomb friction", "How far its curve over speed may differ",
      Kind::kTuned,
      "90 simulated arms with and without misfit, and a KR300, a TX40 and "
      "a UR10e"};
  Threshold lacked_cycles = {
      4, "1 per turn", "Cycles over position, rms; higher ones are smaller",
      Kind::kTuned,
      "90 simulated arms with and without misfit, and a KR300, a TX40 and "
      "a UR10e"};
  Threshold lacked_state_frequency = {
      .6, "1", "rms rad per unit of a state's standard deviation", Kind::kTuned,
      "90 simulated arms with and without misfit, and a KR300, a TX40 and "
      "a UR10e"};

  // From day to day
  Threshold told_of_day = {
      .8, "prior variance",
      "A joint's friction is told where less than this of its prior is "
      "left",
      Kind::kTuned, "seven arms with logs of several days"};
  Threshold clear_of_many = {
      5, "standard deviations",
      "What is looked at on many joints or parameters at once is clear "
      "beyond this",
      Kind::kLaw, "5e-7 by chance"};
  Threshold several_joints = {
      3, "joints", "So many joints changed together are another day",
      Kind::kTuned, "the blind bench's calibration cases"};

  // Noise of the torque
  Threshold noise_rows = {
      60, "samples",
      "The fewest that tell a joint's noise: its deviation to a tenth",
      Kind::kTuned, "standard error 1 / sqrt(2 n) of a deviation"};
  Threshold shortest_period = {
      2, "s", "Motion that repeats sooner is vibration", Kind::kTuned,
      "the blind bench's calibration cases"};
  Threshold ends_without_repeat = {
      .12, "log", "What a log begins and ends with need not repeat",
      Kind::kTuned, "the blind bench's calibration cases"};
  Threshold repeat_tolerance = {
      .01, "rms motion", "Motion is the same again within this share",
      Kind::kTuned, "the blind bench's calibration cases"};
  Threshold doubt_of_noise = {
      .25, "variance",
      "By what share the noise told from repeats, a reference or "
      "positions may be larger",
      Kind::kTuned, "the blind bench's calibration cases"};
  Threshold doubt_of_rest = {
      1, "variance",
      "The same of what was told at rest: motion adds clocks and encoders",
      Kind::kTuned, "the blind bench's calibration cases"};
  Threshold doubt_of_residual = {
      2, "variance", "The same of what a refit leaves", Kind::kTuned,
      "the blind bench's calibration cases"};
  Threshold creep_speed = {.004, "rad/s or m/s",
                           "Below it a joint whose command rests creeps",
                           Kind::kTuned, "the blind bench's calibration cases"};
  Threshold smooth_power = {
      1000, "noise power",
      "What is left of the torque above a low pass, over the noise's "
      "power, where a delay is to be told from it",
      Kind::kTuned, "the blind bench's calibration cases"};
  Threshold burst = {
      1, "usual torque",
      "A second whose torque above the bandwidth is beyond this rings",
      Kind::kTuned, "the blind bench's calibration cases"};
  Threshold burst_over_fast = {
      10, "middle second",
      "and beyond this times what a joint's seconds have up there",
      Kind::kTuned, "the blind bench's calibration cases"};
  Threshold burst_reach = {.5, "s", "Left out on both sides, per power of ten",
                           Kind::kTuned, "the blind bench's calibration cases"};
  Threshold position_only = {
      .1, "inertial torque",
      "Torque that a law of position alone leaves less of was computed, "
      "not measured",
      Kind::kTuned, "handguided log of a pendulum, and logs with torques"};
  Threshold least_inertial = {
      .01, "torque",
      "A joint whose inertial share is less tells nothing of that",
      Kind::kTuned, "handguided log of a pendulum, and logs with torques"};

  // Choice
  Threshold score = {
      12, "chi^2", "An effect's drop of chi^2 less its price has to exceed it",
      Kind::kTuned, "the blind bench's calibration cases"};
  Threshold same_joint_share = {
      .03, "drop",
      "One more effect on a joint has to explain this share of the "
      "strongest's drop: laws' forms are never quite right",
      Kind::kTuned, "the blind bench's calibration cases"};
  Threshold other_joint_share = {.004, "drop", "The same elsewhere",
                                 Kind::kTuned,
                                 "the blind bench's calibration cases"};
  Threshold most_effects = {3, "effects", "More are not chosen", Kind::kTuned,
                            "the blind bench's calibration cases"};
  Threshold near_zero_price = {
      20, "chi^2",
      "More for laws that act next to zero velocity only, where models of "
      "friction err",
      Kind::kTuned,
      "simulated robots without effects: 40 to 60 where others stayed "
      "below 25"};
  Threshold chance_quantile = {
      .99, "1",
      "Beyond what random signs of blocks give in this share of draws",
      Kind::kLaw, "significance of 1 %"};
  Threshold block = {2, "s",
                     "Torque that is left is independent from block to block",
                     Kind::kTuned, "the blind bench's calibration cases"};

  // Contacts
  Threshold false_contacts = {
      .01, "logs", "At most this share of logs without a contact has one found",
      Kind::kLaw, "significance of 1 %"};
  Threshold odds_of_no_contact = {9, "1", "Before the log is looked at",
                                  Kind::kTuned, "one log in ten has a touch"};
  Threshold shortest_push = {.15, "s", "Shorter ones are not looked for",
                             Kind::kTuned,
                             "pushes by hand on a UR10e last .3 s and more"};
  Threshold maxima_block = {2, "s", "Blocks that maxima are taken of",
                            Kind::kTuned,
                            "the blind bench's calibration cases"};
  Threshold fewest_blocks = {
      10, "blocks", "Shorter blocks in short logs, to have so many",
      Kind::kTuned, "the blind bench's calibration cases"};
  Threshold breakaway = {
      .5, "s", "How long after a rest a joint may still be breaking away",
      Kind::kTuned, "dfki_simple_pendulum"};
  Threshold static_friction = {
      .78 / .42, "sliding friction", "What a joint holds that breaks away",
      Kind::kLaw,
      "hard steel on hard steel, dry: Marks' Standard Handbook for "
      "Mechanical Engineers"};
  Threshold clear_friction = {
      .9, "Coulomb friction",
      "Where the model's friction is beyond this its sign is clear",
      Kind::kTuned, "the blind bench's calibration cases"};
  Threshold near_rest = {
      1, "s", "A contact at rest has the arm at rest within this time",
      Kind::kTuned, "pushes on a UR10e"};
  Threshold same_posture = {.02, "rad or m", "in a posture not farther away",
                            Kind::kTuned, "pushes on a UR10e"};
  Threshold usual_lever = {
      .3, "longest lever",
      "A force with shorter levers about all joints is improbable",
      Kind::kTuned, "isotropic directions"};
  Threshold event_reach = {2.5, "widths",
                           "How far to both sides an event is left out",
                           Kind::kTuned, "exp(-2.5^2) = 0.2 % of its peak"};
  Threshold fewest_maxima = {8, "blocks", "Fewer tell no upper quartile",
                             Kind::kTuned,
                             "the blind bench's calibration cases"};

  // Probability and claims
  Threshold temperature = {
      4, "1",
      "Divides scores: neither noise nor catalogue nor forms are as a "
      "score assumes",
      Kind::kTuned, "the 95 % sets of 141 simulated cases held the truth"};
  Threshold credible = {.95, "quantile", "Of the set of candidates", Kind::kLaw,
                        "the convention of intervals"};
  Threshold least_claimed = {
      .3, "1", "Less probable effects are candidates, no more", Kind::kTuned,
      "the blind bench's calibration cases"};
  Threshold likely = {.5, "1", "Likelier than not", Kind::kLaw, "even odds"};
  Threshold likely_unseen = {
      .7, "1", "The same of what held-out data do not show", Kind::kTuned,
      "the blind bench's calibration cases"};
  Threshold form_error = {.2, "drop",
                          "What the form of a law may have wrong of its drop",
                          Kind::kTuned, "the blind bench's calibration cases"};
  Threshold visible = {
      40, "chi^2",
      "Held-out data that should have more of an effect contradict it "
      "where they have none",
      Kind::kTuned, "the blind bench's calibration cases"};
  Threshold helps = {.03, "noise", "unless their mean square falls by this",
                     Kind::kTuned, "the blind bench's calibration cases"};
  Threshold confirmation = {
      20, "chi^2",
      "Held-out data that should have less of an effect tell little",
      Kind::kTuned, "the blind bench's calibration cases"};
  Threshold seen_again = {
      .3, "1", "Held-out data that have this share of what they should show it",
      Kind::kTuned, "the blind bench's calibration cases"};
  Threshold untold = {.5, "1",
                      "What held-out data cannot tell is at most this probable",
                      Kind::kLaw, "indifference"};
  Threshold most_odds = {
      12, "1",
      "Odds of an effect against its rivals, natural logarithm, are not "
      "told beyond it",
      Kind::kTuned, "the blind bench's calibration cases"};
  Threshold tells = {.01, "drop",
                     "A joint that has less of a delay tells nothing of it",
                     Kind::kTuned, "the blind bench's calibration cases"};

  // Verdict
  Threshold real = {100, "chi^2",
                    "What is left counts beyond this: it is not chance",
                    Kind::kTuned, "the blind bench's calibration cases"};
  Threshold left = {
      .3, "gap",
      "and this share of what was there; effects that leave more explain "
      "in part",
      Kind::kTuned, "the blind bench's calibration cases"};
  Threshold absorbed = {.5, "gap",
                        "A refit that leaves less than this has absorbed it",
                        Kind::kTuned, "the blind bench's calibration cases"};
  Threshold louder_in_motion = {
      3, "variance",
      "Noise that was told at rest may be so much louder in motion",
      Kind::kTuned, "the blind bench's calibration cases"};
  Threshold most_of_time = {
      1. / 3, "log", "Windows that stand out in more of it were no touch",
      Kind::kTuned, "the blind bench's calibration cases"};
  Threshold visible_share = {
      1e-4, "column's square",
      "An effect of which the model leaves less cannot be told", Kind::kTuned,
      "the blind bench's calibration cases"};
  Threshold material = {.3, "noise",
                        "nor one of usual size that is smaller, rms",
                        Kind::kTuned, "the blind bench's calibration cases"};
  Threshold far = {2, "standard deviations",
                   "A parameter that is farther from the file's is told",
                   Kind::kLaw, "95 % of a normal distribution"};
  Threshold notable = {.5, "usual change", "One of a day is told beyond this",
                       Kind::kTuned, "seven arms with logs of several days"};
  Threshold order = {
      35, "chi^2", "Residuals are ordered by what their bins show beyond this",
      Kind::kLaw, "chi^2 of 10 bins, 99.9 %, seven coordinates"};
  Threshold fewest_logs = {3, "logs", "A drift needs so many", Kind::kLaw,
                           "two points are a line"};
};

// Those of this process.
const Thresholds& Limits();

// Each with its name.
struct NamedThreshold {
  const char* name;
  Threshold Thresholds::*threshold;
};
const std::vector<NamedThreshold>& ListThresholds();

// "name=value,..." in place of their own values, from now on; before the first
// diagnosis, so that answers can be compared. Throws std::invalid_argument
// where there is no such name or the value is no positive number.
void SetThresholds(const std::string& values);

}  // namespace armcal
