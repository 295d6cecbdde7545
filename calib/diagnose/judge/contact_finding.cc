#include "calib/diagnose/judge/contact_finding.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/judge/description.h"
#include "calib/diagnose/judge/probability.h"
#include "calib/diagnose/select/contact_events.h"
#include "calib/diagnose/select/pulse_events.h"

namespace armcal {
namespace {

// That an event is a contact, `evidence` being that of all events: of what is
// beyond friction by the chance that a log without a contact gets as far
// (ProbabilityBeyondChance), which several logs tell. A single one does not
// tell how logs differ: it is by regressions, or, if that is larger, by the
// chance of a peak so far above the log's others, and no more than what the
// model lacks as a rule leaves to it.
double ProbabilityOfEvent(const GapFit& fit, const GapEvent& event,
                          const EffectEvidence& evidence, double chance_in_log,
                          const Eigen::VectorXd& scale) {
  if (!event.beyond_friction) return ProbabilityOf(evidence);
  const double odds = Limits().odds_of_no_contact;
  if (event.chance_of_logs) return ProbabilityBeyondChance(event.chance, odds);
  const Eigen::VectorXd by_pulses = event.pulse || event.as_pulse
                                        ? scale
                                        : Eigen::VectorXd::Ones(scale.size());
  return std::min(
      std::max(ProbabilityBeyondOneReference(evidence),
               ProbabilityBeyondChance(chance_in_log, odds)),
      ProbabilityBeyondChance(
          ChanceByDiscrepancy(fit.regression(), ToldContact(event), by_pulses),
          odds));
}

bool AreOne(const Contact& a, const Contact& b) {
  return a.log == b.log && a.joint == b.joint &&
         std::abs(a.time - b.time) < Limits().shortest_push;
}

// Contacts on one joint whose peaks are nearer than any push is short are one,
// told as the one that stands out more is.
std::vector<Contact> Joined(const std::vector<Contact>& contacts) {
  std::vector<Contact> joined;
  for (const Contact& contact : contacts) {
    const auto same = std::find_if(
        joined.begin(), joined.end(),
        [&](const Contact& other) { return AreOne(contact, other); });
    if (same == joined.end()) {
      joined.push_back(contact);
    } else if (contact.deviations > same->deviations) {
      *same = contact;
    }
  }
  return joined;
}

// The window of a contact as far as its log goes, s.
TimeRange WithinLog(const GapRows& rows, const Contact& contact) {
  TimeRange log = {contact.window.end, contact.window.begin};
  for (const GapSegment& segment : rows.segments()) {
    if (segment.log != contact.log) continue;
    const Motion& motion = segment.motion;
    log.begin = std::min(log.begin, motion.time(0));
    log.end = std::max(log.end, motion.time(motion.size() - 1));
  }
  return {std::max(contact.window.begin, log.begin),
          std::min(contact.window.end, log.end)};
}

// The share of the logs' time in which there is one at least on a joint, of the
// joint where that is most.
double ShareOfTime(const GapRows& rows, const std::vector<Contact>& contacts) {
  Eigen::VectorXd touched = Eigen::VectorXd::Zero(rows.num_joints());
  double all = 0;
  for (const GapSegment& segment : rows.segments()) {
    const Motion& motion = segment.motion;
    all += motion.dt * motion.size();
    for (int k = 0; k < motion.size(); ++k) {
      std::vector<bool> on_joint(rows.num_joints(), false);
      for (const Contact& contact : contacts) {
        const bool holds = contact.log == segment.log &&
                           motion.time(k) >= contact.window.begin &&
                           motion.time(k) <= contact.window.end;
        if (holds) on_joint[contact.joint] = true;
      }
      for (int j = 0; j < rows.num_joints(); ++j) {
        if (on_joint[j]) touched[j] += motion.dt;
      }
    }
  }
  return touched.maxCoeff() / all;
}

}  // namespace

FoundEffect FindContact(const Robot& robot, const GapFit& fit,
                        const EffectEvidence& evidence) {
  FoundEffect found;
  found.evidence = evidence;
  const ToldPulses told =
      TellPulses(fit.regression(), fit.refined().effects, fit.events());
  std::vector<double> probabilities;
  for (size_t k = 0; k < fit.events().size(); ++k) {
    probabilities.push_back(ProbabilityOfEvent(
        fit, fit.events()[k], found.evidence,
        told.own.chances.row(static_cast<Eigen::Index>(k)).minCoeff(),
        told.own.scale));
    found.probability = std::max(found.probability, probabilities[k]);
  }
  const double least = std::min(found.probability, Limits().likely);
  const GapEvent* strongest = nullptr;
  const Contact* its_contact = nullptr;
  for (size_t k = 0; k < probabilities.size(); ++k) {
    if (probabilities[k] < least) continue;
    const GapEvent& event = fit.events()[k];
    found.delta_chi2 += event.delta_chi2;
    found.contacts.push_back(told.contacts[k]);
    if (!strongest || event.delta_chi2 > strongest->delta_chi2) {
      strongest = &event;
      its_contact = &told.contacts[k];
    }
  }
  found.contacts = Joined(found.contacts);
  for (Contact& contact : found.contacts) {
    contact.window = WithinLog(fit.rows(), contact);
  }
  found.share_of_time = ShareOfTime(fit.rows(), found.contacts);
  found.score = strongest->score;
  if (strongest->fitted) {
    const GapCandidate& force = strongest->fitted->effect;
    found.effect = force.effect;
    found.joint = force.joint;
    DescribeFitted(fit, force, strongest->fitted->covariance, &found);
  } else {
    found.effect = &ContactEffect();
    const auto same = std::find_if(
        found.contacts.begin(), found.contacts.end(),
        [&](const Contact& contact) { return AreOne(contact, *its_contact); });
    found.estimates = ContactEstimates(
        robot, same == found.contacts.end() ? *its_contact : *same,
        &found.stddev);
  }
  return found;
}

}  // namespace armcal
