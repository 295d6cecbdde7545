#pragma once

#include "calib/gap_candidates.h"
#include "calib/gap_contacts.h"
#include "calib/gap_screen.h"
#include "model/time_base.h"

namespace armcal {

// Something that happened once.
struct GapEvent {
  Contact contact;
  // Not one that only a fit of a force's course to moving joints tells.
  bool beyond_friction = false;
  double drop = 0;  // of chi^2
  double score = 0;
  // The drop that a torque of the same course on one joint alone would bring,
  // over `drop`: a touch is felt by several joints.
  double one_joint = 0;
};

// Where in time a candidate with a time and a duration is.
TimeRange WindowOf(const GapCandidate& candidate);

// GapEvent::one_joint of an event whose window and drop are known.
double OneJointShare(const GapScreen& screen, const GapRows& rows,
                     const GapEvent& event);

}  // namespace armcal
