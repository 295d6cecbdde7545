#include "calib/diagnose/judge/contact_finding.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/judge/description.h"
#include "calib/diagnose/judge/outstanding.h"
#include "calib/diagnose/judge/probability.h"
#include "calib/diagnose/select/contact_events.h"

namespace armcal {
namespace {

// That an event is a contact, `evidence` being that of all events: of what is
// beyond friction by the chance that a log without a contact gets as far
// (ProbabilityBeyondChance), which several logs tell, else by regressions, or,
// if that is larger, by the chance of a peak so far above the log's others.
double ProbabilityOfEvent(const GapEvent& event, const EffectEvidence& evidence,
                          double chance_among_peaks) {
  if (!event.beyond_friction) return ProbabilityOf(evidence);
  const double odds = Limits().odds_of_no_contact;
  if (event.chance_of_logs) return ProbabilityBeyondChance(event.chance, odds);
  return std::max(ProbabilityBeyondOneReference(evidence),
                  ProbabilityBeyondChance(chance_among_peaks, odds));
}

// The torque of each event on the joint that felt it most, over the noise's.
std::vector<double> SizesOf(const GapFit& fit) {
  std::vector<double> sizes;
  for (const GapEvent& event : fit.events()) {
    const int j = event.contact.joint;
    sizes.push_back(std::abs(event.contact.torque[j]) /
                    fit.noise().joints[j].stddev());
  }
  return sizes;
}

}  // namespace

FoundEffect FindContact(const Robot& robot, const GapFit& fit,
                        const EffectEvidence& evidence) {
  FoundEffect found;
  found.evidence = evidence;
  const std::vector<double> chances = ChancesAmongPeaks(SizesOf(fit));
  std::vector<double> probabilities;
  for (size_t k = 0; k < chances.size(); ++k) {
    probabilities.push_back(
        ProbabilityOfEvent(fit.events()[k], found.evidence, chances[k]));
    found.probability = std::max(found.probability, probabilities[k]);
  }
  const double least = std::min(found.probability, Limits().likely);
  const GapEvent* strongest = nullptr;
  for (size_t k = 0; k < probabilities.size(); ++k) {
    if (probabilities[k] < least) continue;
    const GapEvent& event = fit.events()[k];
    found.delta_chi2 += event.delta_chi2;
    found.contacts.push_back(event.contact);
    if (!strongest || event.delta_chi2 > strongest->delta_chi2) {
      strongest = &event;
    }
  }
  found.score = strongest->score;
  if (strongest->fitted) {
    const GapCandidate& force = strongest->fitted->effect;
    found.effect = force.effect;
    found.joint = force.joint;
    DescribeFitted(fit, force, strongest->fitted->covariance, &found);
  } else {
    found.effect = &ContactEffect();
    found.estimates =
        ContactEstimates(robot, strongest->contact, &found.stddev);
  }
  return found;
}

}  // namespace armcal
