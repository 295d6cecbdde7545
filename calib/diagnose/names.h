#pragma once

#include <string>

#include "calib/diagnose/diagnosis.h"
#include "model/effects/effect.h"

namespace armcal {

// An effect and where it is in words: "payload", "stribeck on elbow".
std::string NameOf(const Effect& effect, int joint,
                   const GapDiagnosis& diagnosis);

// The same of what was found, with the places of a body that may be elsewhere:
// "added mass on wrist_2 or payload".
std::string NameOf(const FoundEffect& found, const GapDiagnosis& diagnosis);

// The same of an effect that is a change since a reference, with its direction
// where the effect has one, which is where it has a single linear parameter of
// either sign, or is a body that was added or taken off. What adds to a number
// that any robot has is told as more or less of that ("less coulomb friction on
// elbow"), anything else with its signed size ("torque gain on elbow (-0.08)",
// "payload (-0.5 kg)").
std::string ChangeOf(const FoundEffect& found, const GapDiagnosis& diagnosis);

// Whether it is a body that the robot lacks and the model has.
bool IsTakenOff(const FoundEffect& found);

// What changes are told since: "the reference" or "the calibration"; empty: the
// robot file, since which nothing is said to have changed.
std::string SinceWhat(const GapDiagnosis& diagnosis);

// Whether it is a law that a reference would not have shown: one of the robot's
// all the time, as far as that says.
bool IsUntoldByReference(const FoundEffect& found,
                         const GapDiagnosis& diagnosis);

// Whether an effect of this probability is told without a "probably".
bool IsConfident(double probability);

}  // namespace armcal
