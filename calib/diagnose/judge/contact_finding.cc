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

// How probable it is that what the model lacks as a rule is as large on some
// joint in some stretch of the log, as long as this one, as what was felt, each
// joint's torque known to its noise. A chi squared of many samples does not ask
// this: what lasts through a stretch is not averaged there.
double ChanceByDiscrepancy(const GapFit& fit, const Contact& contact) {
  Eigen::VectorXd stddev = contact.stddev;
  for (int j = 0; j < stddev.size(); ++j) {
    stddev[j] = std::hypot(stddev[j], fit.regression().DiscrepancyOn(j));
  }
  double duration = 0;
  for (const GapSegment& segment : fit.rows().segments()) {
    duration += segment.motion.dt * static_cast<double>(segment.motion.size());
  }
  const double length = contact.window.end - contact.window.begin;
  const double stretches = std::max(1., duration / std::max(1e-9, length));
  return ChanceOfLargest(contact.torque, stddev, stretches);
}

// That an event is a contact, `evidence` being that of all events: of what is
// beyond friction by the chance that a log without a contact gets as far
// (ProbabilityBeyondChance), which several logs tell. A single one does not
// tell how logs differ: it is by regressions, or, if that is larger, by the
// chance of a peak so far above the log's others, and no more than what the
// model lacks as a rule leaves to it.
double ProbabilityOfEvent(const GapFit& fit, const GapEvent& event,
                          const EffectEvidence& evidence,
                          double chance_among_peaks) {
  if (!event.beyond_friction) return ProbabilityOf(evidence);
  const double odds = Limits().odds_of_no_contact;
  if (event.chance_of_logs) return ProbabilityBeyondChance(event.chance, odds);
  return std::min(std::max(ProbabilityBeyondOneReference(evidence),
                           ProbabilityBeyondChance(chance_among_peaks, odds)),
                  ProbabilityBeyondChance(
                      ChanceByDiscrepancy(fit, ToldContact(event)), odds));
}

// Of what is left of moving joints' torques where there is no event, over the
// noise's: the largest in every block of time.
std::vector<double> PeaksBesideEvents(const GapFit& fit) {
  const GapRows& rows = fit.rows();
  const RefinedEffects& refined = fit.refined();
  const Eigen::MatrixXd left = fit.data()->ResidualWith(
      refined.baseline, fit.regression().TorqueOf(refined.effects));
  Eigen::VectorXd series = Eigen::VectorXd::Zero(left.rows());
  for (int j = 0; j < rows.num_joints(); ++j) {
    for (const GapRows::Place& place : rows.PlacesOfRows(j)) {
      const int log = rows.segments()[place.segment].log;
      const bool in_event = std::any_of(
          fit.events().begin(), fit.events().end(), [&](const auto& event) {
            return event.contact.log == log &&
                   event.contact.window.Contains(place.time);
          });
      if (in_event) continue;
      series[place.sample] =
          std::max(series[place.sample], std::abs(left(place.sample, j)) /
                                             fit.noise().joints[j].stddev());
    }
  }
  std::vector<double> peaks = BlockMaxima(rows, BlockTime(rows), series);
  peaks.erase(std::remove(peaks.begin(), peaks.end(), 0), peaks.end());
  return peaks;
}

// The square of each event's torque on the joint that felt it most, over the
// noise's; then of what else peaks in the logs, which an event has to stand out
// from. Squares of normal errors have an exponential tail, whatever their
// variance, which the peaks tell.
std::vector<double> SquaresOf(const GapFit& fit) {
  std::vector<double> sizes;
  for (const GapEvent& event : fit.events()) {
    const Contact& contact = ToldContact(event);
    const int j = contact.joint;
    sizes.push_back(std::abs(contact.torque[j]) /
                    fit.noise().joints[j].stddev());
  }
  const std::vector<double> others = PeaksBesideEvents(fit);
  sizes.insert(sizes.end(), others.begin(), others.end());
  for (double& size : sizes) size *= size;
  return sizes;
}

}  // namespace

FoundEffect FindContact(const Robot& robot, const GapFit& fit,
                        const EffectEvidence& evidence) {
  FoundEffect found;
  found.evidence = evidence;
  const std::vector<double> chances = ChancesAmongPeaks(SquaresOf(fit));
  std::vector<double> probabilities;
  for (size_t k = 0; k < fit.events().size(); ++k) {
    probabilities.push_back(
        ProbabilityOfEvent(fit, fit.events()[k], found.evidence, chances[k]));
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
