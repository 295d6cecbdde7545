#pragma once

#include "calib/diagnose/data/noise.h"
#include "calib/diagnose/judge/removed_share.h"

namespace armcal {

// The `verdict` of diagnosis.json (docs/diagnose.md).
enum class GapVerdict {
  kNoiseFloor,
  kAbsorbed,
  kExplained,
  kPartlyExplained,
  kUnknown,
  kNotTestable
};
const char* GapVerdictName(GapVerdict verdict);

// What effects leave of one joint.
struct JointLeft {
  double excess = 0;  // chi^2 beyond the noise's, in sample
  int rows = 0;
  NoiseFloor floor = NoiseFloor::kAssumed;  // where the noise was told from
  bool is_ordered = false;                  // by position, velocity, time, ...
  double held_out = 0;  // rms over the noise's; 0 or NaN: not known
};

// How much of the excess is more than noise, chi^2.
double UnexplainedOf(const JointLeft& left);

// What a verdict is spoken on.
struct GapFacts {
  GapFigures torque;  // of held-out data, in units of the floor
  bool effects = false;
  bool found_without_name = false;
  bool since_reference = false;  // the question is what has changed since
  double left = 0;        // chi^2 beyond the noise's in sample, all joints
  double left_share = 0;  // of what a refit leaves beyond the noise
};

// Held-out mean square over the noise's from which on it is more than noise
// that is louder than was told.
double LoudestNoise();

// Whether nothing is named, and held-out data are farther off than noise is
// louder there than it was told to be, whatever the fitted logs show: it may be
// louder still, or something is missing that these do not show.
bool IsLoudHeldOut(const GapFacts& facts);

// For data that can be diagnosed. What is left counts when it is much more than
// chance gives and much of what was there. Nothing held out is no agreement.
GapVerdict JudgeGap(const GapFacts& facts);

}  // namespace armcal
