#include "calib/diagnose/select/pulse_events.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/select/contact_events.h"
#include "calib/diagnose/select/pulse_search.h"

namespace armcal {
namespace {

double VelocityAt(const GapRows& rows, const Contact& contact, int joint) {
  for (const GapSegment& segment : rows.segments()) {
    const Motion& motion = segment.motion;
    const double k = (contact.time - motion.time(0)) / motion.dt;
    if (segment.log != contact.log || k < 0 || k >= motion.size()) continue;
    return motion.qd(static_cast<int>(k), joint);
  }
  return 0;
}

// Whether what acts on a joint is against its motion each time, which of pushes
// is so by chance in 2^-k of k cases: friction that comes and goes is no touch.
bool OnlyBrakes(const GapRows& rows, const std::vector<GapEvent>& events,
                int joint) {
  constexpr int kLeastCases = 5;  // 3 %
  int with = 0, against = 0;
  for (const GapEvent& event : events) {
    if (event.contact.joint != joint) continue;
    const double power =
        event.contact.torque[joint] * VelocityAt(rows, event.contact, joint);
    (power < 0 ? against : with) += 1;
  }
  return against >= kLeastCases && with == 0;
}

// How much of the logs pulses take, those on one joint or (-1) all, s.
double TimeOfPulses(const std::vector<GapEvent>& events, int joint) {
  double time = 0;
  for (const GapEvent& event : events) {
    if (joint >= 0 && event.contact.joint != joint) continue;
    const TimeRange& window = event.contact.window;
    time += (window.end - window.begin) / Limits().event_reach;
  }
  return time;
}

// The logs of a regression, of which nothing is masked.
std::unique_ptr<GapData> SeenAgain(const GapRegression& regression) {
  std::unique_ptr<GapData> data = regression.DataOf(regression.rows().part());
  data->Unmask();
  regression.GiveNoise(data.get());
  return data;
}

// A fit that does not see these events, and all the rest.
GapRegression MaskedBy(const std::vector<GapEvent>& events,
                       const GapRegression& regression) {
  GapRegression masked(regression, regression.rows().part());
  masked.data()->Unmask();
  MaskEvents(events, masked.data());
  masked.Refit();
  return masked;
}

std::vector<bool> SpoiltJoints(const GapRows& rows,
                               const std::vector<GapEvent>& events) {
  std::vector<bool> spoilt;
  for (int j = 0; j < rows.num_joints(); ++j) {
    spoilt.push_back(TimeOfPulses(events, j) >
                         Limits().most_of_time * rows.time() ||
                     OnlyBrakes(rows, events, j));
  }
  return spoilt;
}

// Whether all joints together have them in too much of the time.
bool TakeMostOfTheTime(const GapRows& rows,
                       const std::vector<GapEvent>& events) {
  return TimeOfPulses(events, -1) > Limits().most_of_time * rows.time();
}

// Whether a pulse is improbable without a contact. A single reference does not
// tell how logs differ: there the pulse has to speak for a contact as well
// where the model lacks what models lack as a rule. A chance p bounds the odds
// for a contact by 1 / (-e p ln p), so that one of 1 / e and more says nothing
// (ProbabilityBeyondChance). Where the pulses of reference and log are far
// smaller than their standard deviations say, one that is not is improbable
// among them, and may yet be no more than any model lacks.
bool StandsOut(const GapRegression& regression, const GapEvent& pulse) {
  if (!(pulse.chance < Limits().false_contacts)) return false;
  if (regression.has_several_references()) return true;
  const Eigen::VectorXd scale =
      Eigen::VectorXd::Ones(pulse.contact.stddev.size());
  return ChanceByDiscrepancy(regression, pulse.contact, scale) < 1 / M_E;
}

}  // namespace

// Those of the first bank, less what they spoil, and then each longer one that
// spoils nothing.
void DropSpoilt(const GapRows& rows, std::vector<GapEvent>* events) {
  std::vector<GapEvent> kept, longer;
  for (const GapEvent& event : *events) {
    (event.bank == 0 ? kept : longer).push_back(event);
  }
  const std::vector<bool> spoilt = SpoiltJoints(rows, kept);
  kept.erase(std::remove_if(kept.begin(), kept.end(),
                            [&](const GapEvent& event) {
                              return spoilt[event.contact.joint];
                            }),
             kept.end());
  if (TakeMostOfTheTime(rows, kept)) kept.clear();
  for (const GapEvent& event : longer) {
    std::vector<GapEvent> with = kept;
    with.push_back(event);
    const bool spoils = TakeMostOfTheTime(rows, with) ||
                        SpoiltJoints(rows, with)[event.contact.joint];
    if (!spoils) kept = with;
  }
  *events = kept;
}

std::vector<GapEvent> FindPulses(const GapRegression& regression,
                                 const std::vector<GapCandidate>& effects) {
  if (!regression.reference()) return {};
  std::vector<GapEvent> events =
      PulseSearch(regression, effects, *regression.data()).Find();
  // What stands out less spoils others as well: many of them are what the model
  // lacks, of which the larger ones are a part.
  DropSpoilt(regression.rows(), &events);
  events.erase(std::remove_if(events.begin(), events.end(),
                              [&](const GapEvent& event) {
                                return !StandsOut(regression, event);
                              }),
               events.end());
  for (GapEvent& event : events) {
    event.chance_of_logs = regression.has_several_references();
  }
  return events;
}

std::vector<GapEvent> WithoutExplainedPulses(
    const GapRegression& regression, const std::vector<GapCandidate>& effects,
    const std::vector<GapEvent>& events) {
  std::vector<GapEvent> kept;
  std::copy_if(events.begin(), events.end(), std::back_inserter(kept),
               [](const GapEvent& event) { return !event.pulse; });
  const GapRegression unmasked = MaskedBy(kept, regression);
  const PulseSearch search(unmasked, effects, *unmasked.data());
  kept.clear();
  const std::vector<GapEvent> pulses = search.LargestIn(events);
  for (size_t k = 0; k < events.size(); ++k) {
    if (events[k].pulse && !StandsOut(unmasked, pulses[k])) continue;
    kept.push_back(events[k]);
  }
  return kept;
}

void ConfirmTouches(const GapRegression& regression,
                    const std::vector<GapCandidate>& effects,
                    std::vector<GapEvent>* events) {
  const bool any =
      std::any_of(events->begin(), events->end(),
                  [](const GapEvent& event) { return !event.beyond_friction; });
  if (!any || !regression.reference()) return;
  const GapRegression unmasked = MaskedBy(BeyondFriction(*events), regression);
  const PulseSearch search(unmasked, effects, *unmasked.data());
  const std::vector<GapEvent> pulses = search.LargestIn(*events);
  for (size_t k = 0; k < events->size(); ++k) {
    GapEvent& event = (*events)[k];
    if (event.beyond_friction) continue;
    const GapEvent& pulse = pulses[k];
    if (!StandsOut(unmasked, pulse)) continue;
    event.beyond_friction = true;
    event.chance = pulse.chance;
    event.as_pulse = pulse.contact;
    event.chance_of_logs = regression.has_several_references();
  }
}

ToldPulses TellPulses(const GapRegression& regression,
                      const std::vector<GapCandidate>& effects,
                      const std::vector<GapEvent>& events) {
  ToldPulses told;
  for (const GapEvent& event : events) told.contacts.push_back(event.contact);
  if (events.empty() || !regression.reference()) {
    const int n = regression.rows().num_joints();
    const auto size = static_cast<Eigen::Index>(events.size());
    told.own = {Eigen::MatrixXd::Ones(size, n), Eigen::VectorXd::Ones(n)};
    return told;
  }
  const std::unique_ptr<GapData> seen = SeenAgain(regression);
  const PulseSearch search(regression, effects, *seen);
  told.own = search.BesideEvents(events);
  for (size_t k = 0; k < events.size(); ++k) {
    if (events[k].pulse) told.contacts[k] = search.Fitted(told.contacts[k]);
  }
  return told;
}

}  // namespace armcal
