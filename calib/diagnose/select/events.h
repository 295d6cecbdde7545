#pragma once

#include <optional>
#include <vector>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/contacts/contacts.h"
#include "calib/diagnose/data/data.h"
#include "calib/diagnose/data/screen.h"
#include "model/log_files/time_base.h"

namespace armcal {

// Something that happened once.
struct GapEvent {
  Contact contact;
  // A force and its course, fitted to joints that move: the effect's parameters
  // and their covariance. None of what was found beyond friction, nor where
  // joints have no lever to tell the force by.
  struct Fitted {
    GapCandidate effect;
    Eigen::MatrixXd covariance;
  };
  std::optional<Fitted> fitted;
  bool beyond_friction = false;
  // Of what was found beyond friction: how probable such an excess is in a log
  // without a contact, and whether that was told by more than one such log: the
  // parts of a single one differ less from each other than logs do.
  double chance = 1;
  bool chance_of_logs = true;
  // Found at rest: it is told without what effects that were fitted to motion
  // say of rest.
  bool at_rest = false;
  // A pulse of torque on joints that move (pulse_events.h), and which of
  // PulseScan's banks found it.
  bool pulse = false;
  int bank = 0;
  // Of a touch that stands out as a pulse does (ConfirmTouches): that pulse,
  // which its chance is of. The touch itself is described where its excess over
  // friction peaks, where a push on joints that slide may be small.
  std::optional<Contact> as_pulse;
  double delta_chi2 = 0;
  double score = 0;
  // The delta chi^2 that a torque of the same course on one joint alone would
  // bring, over `delta_chi2`: a touch is felt by several joints.
  double one_joint = 0;
};

// What the chance of an event is of: the pulse of one that was confirmed by it.
const Contact& ToldContact(const GapEvent& event);

GapEvent EventBeyondFriction(const GapRows& rows, const FrictionExcess& excess,
                             const Contact& contact);
void SortByTime(std::vector<GapEvent>* events);
// Pulses on one joint whose windows overlap are one push, which lasts longer
// than the widest pulse that is looked for: one event with the window of all
// and the sum of their delta chi^2, the rest of it as of the strongest. All
// events are in the order of time.
std::vector<GapEvent> JoinedPulses(std::vector<GapEvent> events);
// As they are given what was fitted without them, pulses joined: the excess
// given the baseline alone, and given effects as well.
void DescribeAgain(const Robot& robot, const GapRows& rows,
                   const FrictionExcess& alone, const FrictionExcess& given,
                   std::vector<GapEvent>* events);

// Where in time a candidate with a time and a duration is.
TimeRange WindowOf(const GapCandidate& candidate);
// Whether a time of a log is in the window of one of these.
bool IsKnown(const std::vector<GapEvent>& events, int log, double time);

// Rows that are not believed once the event is taken out.
int RowsOf(const GapRows& rows, const GapEvent& event);

// Those whose chance is known (GapEvent::chance).
std::vector<GapEvent> BeyondFriction(const std::vector<GapEvent>& events);
// Takes their windows out of the rows that are believed.
void MaskEvents(const std::vector<GapEvent>& events, GapData* data);

// The course in time of an event of known window, 1 at its centre, per thinned
// sample: exp(-((t - centre) / width)^2), 0 in other logs.
Eigen::VectorXd CourseOf(const GapRows& rows, const GapEvent& event);

// GapEvent::one_joint of an event whose window and delta chi^2 are known.
double OneJointShare(const GapScreen& screen, const GapRows& rows,
                     const GapEvent& event);

}  // namespace armcal
