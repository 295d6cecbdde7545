#pragma once

#include <vector>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/select/events.h"
#include "calib/diagnose/select/pulse_search.h"
#include "calib/diagnose/select/regression.h"

namespace armcal {

// Pushes on joints that move, one joint or several, as pulses of torque
// (PulseScan) given the baseline and `effects`. Only a reference, in which
// nothing touched the arm, tells what pulses a model leaves by itself, of
// motion as it has (MotionRange): one of the log has to stand out from them,
// and beside a single reference from what models lack as a rule.
// None where there is no reference, nor of what no touch is (DropSpoilt). Times
// that are masked already have none.
std::vector<GapEvent> FindPulses(const GapRegression& regression,
                                 const std::vector<GapCandidate>& effects);

// Pulses that take more of the time than contacts do (most_of_time) are what
// the model lacks, and forces that only ever brake a joint are friction that
// comes and goes. On one joint, of which the reference may not have shown
// enough, either spoils what is found there: one that is real cannot be told
// among them. What all joints together have in too much of the time spoils all.
// Longer pulses (GapEvent::bank) spoil no shorter ones.
void DropSpoilt(const GapRows& rows, std::vector<GapEvent>* events);

// Events without the pulses that no longer stand out given these effects, all
// samples of theirs seen: they were found given others, which left more.
std::vector<GapEvent> WithoutExplainedPulses(
    const GapRegression& regression, const std::vector<GapCandidate>& effects,
    const std::vector<GapEvent>& events);

// Touches that were fitted as a force, and of which one joint's pulse alone
// stands out as FindPulses asks of it, are as probable contacts as that says:
// they become events beyond friction, with the chance of the pulse. Others stay
// as they are.
void ConfirmTouches(const GapRegression& regression,
                    const std::vector<GapCandidate>& effects,
                    std::vector<GapEvent>* events);

// Events once it is known which effects there are.
struct ToldPulses {
  // What the log says of its pulses beside them: chances of 1 and scales of 1
  // where there is no reference.
  OwnPulses own;
  // Of each, pulses with the time and width that fit them best.
  std::vector<Contact> contacts;
};
// Given effects, and a model that was fitted without the events' windows.
ToldPulses TellPulses(const GapRegression& regression,
                      const std::vector<GapCandidate>& effects,
                      const std::vector<GapEvent>& events);

}  // namespace armcal
