#pragma once

#include <string>
#include <vector>

namespace armcal {

// Every number that decides what a diagnosis says, beside the weights of a
// claim's probability (judge/evidence.cc), the ranges of the catalogue's
// parameters (model/effects) and the sizes of grids and caps on rounds, which
// cost time and decide nothing. thresholds.cc has the unit, the meaning and the
// source of each; docs/thresholds.md has them as a table, with what each
// decides.
struct Thresholds {
  // What the model may vary
  double reversal_width = 6e-3;
  double width_mixture = .5;
  double offset_share = .02;
  double reversal_extra_stddev = .3;
  double reconstructed_torque_stddev = .001;

  // What models lack as a rule
  double discrepancy = .01;
  double discrepancy_of_sign = .005;
  double least_discrepancy = .1;
  double discrepancy_friction_curve = .1;
  double discrepancy_cycles = 4;
  double discrepancy_state_frequency = .6;

  // From day to day
  double by_chance = 3;
  double clear_of_many = 5;
  double several_joints = 3;

  // Noise of the torque
  double noise_rows = 60;
  double shortest_period = 2;
  double repeat_tolerance = .01;
  double extra_variance_of_noise = .25;
  double extra_variance_of_others = 1;
  double creep_speed = .004;
  double smooth_power = 1000;
  double burst = 1;
  double position_only = .1;
  double least_inertial = .01;

  // Choice
  double score = 12;
  double same_joint_share = .03;
  double other_joint_share = .004;
  double most_effects = 3;
  double near_zero_penalty = 20;
  double odds_of_same_construction = 9;
  double chance_quantile = .99;
  double block = 2;

  // Contacts
  double false_contacts = .01;
  double odds_of_no_contact = 9;
  double shortest_push = .15;
  double fewest_blocks = 8;
  double breakaway = .5;
  double static_friction = .78 / .42;
  double clear_friction = .9;
  double near_rest = 1;
  double same_posture = .02;
  double usual_lever = .3;
  double event_reach = 2.5;
  double usual_motion = .95;

  // Probability and claims
  double temperature = 4;
  double credible = .95;
  double likely = .5;
  double likely_unseen = .7;
  double form_error = .2;
  double visible = 21.6;
  double confirmation = 4;
  double seen_again = .3;
  double untold = .5;
  double few = 4;
  double explains = .5;

  // Verdict
  double left = .3;
  double absorbed = .5;
  double louder_in_motion = 3;
  double most_of_time = 1. / 3;
  double same_state = .1;
  double material = .3;
  double far = 2;
  double notable = .5;
  double order = 35;
  double fewest_logs = 3;
};

// Those of this process.
const Thresholds& Limits();
// What counts as several of so many joints: several_joints, or all of fewer.
double SeveralOf(int joints);
// How probable a normal variable is by_chance standard deviations and more from
// its mean, to either side.
double ChanceBeyond();

struct ThresholdInfo {
  // Whether it follows from a law (a quantile, a count, a published
  // measurement), defines a word of the answer or what is looked for, or was
  // chosen on data.
  enum class Kind { kLaw, kDefinition, kTuned };

  const char* name;
  double Thresholds::*value;
  const char* unit;
  const char* meaning;
  Kind kind;
  const char* source;  // the law, what it defines, the data it was chosen on
};
// Of every one, in the order of the struct.
const std::vector<ThresholdInfo>& ListThresholds();

// "name=value,..." in place of their own values, from now on; before the first
// diagnosis, so that answers can be compared. Throws std::invalid_argument
// where there is no such name or the value is no positive number.
void SetThresholds(const std::string& values);

}  // namespace armcal
