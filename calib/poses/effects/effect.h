#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "calib/poses/effects/campaign.h"
#include "calib/poses/effects/posture_signal.h"

namespace armcal {

// An amount that displaces something by itself times `signal`, which has a
// value for each pose. Displacements add up.
struct PoseTerm {
  enum class Acts {
    kJoint,   // index: joint, rad or m
    kBase,    // rotation about axis `index` of the base frame, rad
    kTool,    // 0-2: the tool along its axes, m; 3-5: about them, rad
    kTarget,  // 3 target + axis: one target on the tool, m
    kFrame,   // 0-2: the arm in the instrument's frame, m; 3-5: about its axes
              // through the middle of what was measured, rad
    kScale,   // all distances from the base, by a share of themselves
    kLength,  // what a wire's length reads, m
  };
  Acts acts;
  int index;
  Eigen::VectorXd signal;
  std::string name;  // of the amount
  std::string unit;
  PostureSignal goes_with = {};  // what `signal` is made from
  Told told = {};                // of the amount, by others than the poses
  // Below this the amount is nothing that there is, as a negative compliance.
  double least = -std::numeric_limits<double>::infinity();
};

// One whose signal is that of the posture.
PoseTerm PostureTerm(const PoseCampaign& campaign, PoseTerm::Acts acts,
                     int index, const PostureSignal& goes_with,
                     const std::string& name, const std::string& unit);

// Which of an effect's forms: of which joint, by which other, from which pose
// on up to which other; -1: the effect has none.
struct PosePlace {
  int joint = -1;
  int by = -1;
  int begin = -1, end = -1;  // indices of poses
  int parts = 0;             // the effect's own: axes, knots, a target
  int knots = 0;

  bool operator==(const PosePlace& o) const {
    return joint == o.joint && by == o.by && begin == o.begin && end == o.end &&
           parts == o.parts && knots == o.knots;
  }
};

// A cause for errors of geometry that links of fixed lengths do not have: its
// file says all that others ask of it.
struct PoseEffect {
  std::string name;
  std::string means;  // for people
  // The name of the effect that has this one on some joint; empty: none.
  std::string part_of;
  // Whether it depends on when a pose was measured, or on the arm's posture.
  bool in_order = false;
  // What tells it from its rivals, for people.
  std::string separate_by;
  // Amounts of it that a fit may not reach from 0, beside 0.
  std::vector<double> far_amounts;
  // Its amount where the joint counts the other way than its file; 0: it has
  // none.
  double turned_round_at = 0;
  // Its amounts are those of a sine and a cosine: of an amplitude.
  bool is_harmonic = false;
  // Beyond this much from 0 and from each of `far_amounts` it is another
  // effect in disguise; 0: no limit.
  double most_amount = 0;
  std::vector<PosePlace> (*places)(const PoseCampaign&) = nullptr;
  std::vector<PoseTerm> (*terms)(const PoseCampaign&,
                                 const PosePlace&) = nullptr;
  // In how many places it is looked for; 0: as many as places() has, which is
  // fewer where these are refined.
  double (*count)(const PoseCampaign&) = nullptr;
};

// "coupling of joint3 with joint2", "tool_step from pose 86 on", by the
// campaign's numbers of poses.
std::string PlacedName(const PoseEffect& effect, const PoseCampaign& campaign,
                       const PosePlace& place);

// All of the list.
const std::vector<PoseEffect>& PoseEffects();

}  // namespace armcal
