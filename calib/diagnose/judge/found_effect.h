#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "calib/diagnose/candidates/effect_odds.h"
#include "calib/diagnose/contacts/contacts.h"
#include "calib/diagnose/judge/evidence.h"
#include "calib/diagnose/judge/joint_agreement.h"
#include "calib/diagnose/judge/probability.h"
#include "calib/diagnose/select/reference_scatter.h"

namespace armcal {

// One effect that was found.
struct FoundEffect {
  const Effect* effect = nullptr;
  int joint = -1;  // from 0; -1: all joints or the whole robot
  // Whether a real arm can have the estimates (Effect::plausible): a load is
  // held by the tool.
  bool is_possible = true;
  // Whether it is of the drive of a joint that swings freely: what stands in
  // for errors of a model there, and no size that could be told.
  bool of_idle_drive = false;
  // Whether it swings at a frequency at which the motion does, so that an error
  // of the model would look like it (line_of_motion.h).
  bool of_motions_line = false;
  double probability = 0;
  double any_probability = 0;  // that it or one of `equivalent` is there
  double score = 0;
  double delta_chi2 = 0;  // by which chi^2 rises without it
  EffectEvidence evidence;
  // Which of the fit's effects it is of: one, or a law and then its mean; none
  // of what is no effect of the fit's.
  std::vector<int> fitted;
  std::vector<EffectEstimate> estimates;
  std::vector<double> stddev;  // of the estimates
  // The same if the torque's scale were known: a change since a reference of
  // the same drives is there or not whatever their torque constants are.
  std::vector<double> stddev_by_scale;
  // rms of its torque over the joint's usual one, on the joint where that is
  // most.
  double size = std::numeric_limits<double>::infinity();
  // What a refit without it leaves of held-out data where it acts, mean square
  // over the noise's; NaN where nothing was held out or no reference tells the
  // noise.
  double gap = std::numeric_limits<double>::quiet_NaN();
  // By how much it lowers the held-out mean square, over what friction of
  // another day lowers on its joint; NaN where that has not changed.
  double over_change = std::numeric_limits<double>::quiet_NaN();
  // Others that these data cannot tell from it.
  std::vector<PlacedEffect> equivalent;
  // Whether these are few, and one of them is claimed though none is by itself.
  bool one_of_few = false;
  // Of `equivalent`: where else a body may be whose place these data do not
  // tell. `probability` is that it is at one of these places.
  std::vector<PlacedEffect> or_at;
  EffectGain gain;  // given the others of the fit
  // The same over the held-out gap, with its interval; NaN: not known.
  double removed_percent = NAN;
  double ci95[2] = {NAN, NAN};
  std::string separate_by;        // the experiment that would tell them apart
  std::vector<Contact> contacts;  // of external_contact, in time's order
  double share_of_time = 0;       // of the logs, in which one joint is touched
  // Whether joints tell it alike, if it is of all of them, and its size as each
  // by itself has it where they do not.
  bool joints_agree = true;
  std::vector<JointAgreement::JointSize> joint_sizes;
  // Whether friction takes power with it.
  bool dissipates = true;
  // How much of it the reference's logs show by themselves.
  ReferenceScatter scatter;
  ShareOfEffect in_reference;  // as one log has it
  // Whether it is friction of several joints that is that of another day: one
  // change, the estimates being each joint's, and no term of the model's.
  bool of_another_day = false;
  // Whether the stamps of a log say it, which were mended before anything was
  // fitted: the data's finding tells it, no term of the model's.
  bool of_the_stamps = false;
  // The term that the file gives no joint, where it is that of all joints: the
  // estimates are each joint's.
  std::optional<JointTerm> missing_term;
};

}  // namespace armcal
