#include "calib/diagnose/select/contact_events.h"

#include <algorithm>
#include <cmath>

#include "calib/diagnose/data/position_noise.h"
#include "calib/diagnose/data/thresholds.h"
#include "calib/numerics/maxima.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

// How large the excess of a log without a contact gets: of the reference, and
// of the log itself but for a few windows.
UsualMaximum UsualExcess(const GapRegression& regression,
                         const FrictionExcess& excess, bool of_itself) {
  const GapData* reference = regression.reference();
  const GapRows& rows = regression.rows();
  const GapRows& before = reference ? reference->rows() : rows;
  const double block = BlockTime(before);
  const std::vector<double> own = BlockMaxima(rows, block, excess.Largest());
  UsualMaximum usual{static_cast<double>(own.size()), {}};
  if (of_itself) {
    usual.tails.push_back(UsualTailOf(own, Limits().fewest_blocks));
  }
  if (!reference) return usual;
  const VectorXd& x = regression.refit();
  const FrictionExcess known = ExcessOverFriction(
      regression.baseline(), x, before, reference->ResidualWith(x));
  usual.tails.push_back(TailOf(BlockMaxima(before, block, known.Largest())));
  return usual;
}

}  // namespace

FrictionExcess ExcessGiven(const GapRegression& regression,
                           const std::vector<GapCandidate>& effects) {
  const JointRows torque = regression.TorqueOf(effects);
  const VectorXd x = regression.BaselineGiven(torque);
  return ExcessOverFriction(regression.baseline(), x, regression.rows(),
                            regression.data()->ResidualWith(x, torque));
}

bool LastsTooLong(double seconds, const Contact& contact) {
  return contact.window.end - contact.window.begin >
         Limits().most_of_time * seconds;
}

double ChanceByDiscrepancy(const GapRegression& regression,
                           const Contact& contact, const VectorXd& scale) {
  VectorXd stddev = contact.stddev.cwiseProduct(scale);
  for (int j = 0; j < stddev.size(); ++j) {
    stddev[j] = std::hypot(stddev[j], regression.DiscrepancyOn(j));
  }
  double duration = 0;
  for (const GapSegment& segment : regression.rows().segments()) {
    duration += segment.motion.dt * static_cast<double>(segment.motion.size());
  }
  const double length = contact.window.end - contact.window.begin;
  const double stretches = std::max(1., duration / std::max(1e-9, length));
  return ChanceOfLargest(contact.torque, stddev, stretches);
}

// The threshold is the excess that a log without a contact passes with the
// probability false_contacts, by the tail of its block maxima
// (calib/numerics/maxima.h): of the reference for arms of several joints, also
// of the log itself for one joint. Neither knows of a distribution of friction,
// which nobody has; they know how large its excess got.
std::vector<GapEvent> ContactsGiven(const GapRegression& regression,
                                    const std::vector<GapCandidate>& effects,
                                    const std::vector<GapEvent>& known,
                                    ContactSearch search) {
  const GapRows& rows = regression.rows();
  const bool of_itself = search == ContactSearch::kInMotion;
  const bool at_rest = search == ContactSearch::kAtRest;
  if (HaveNoiseOfPositions(rows.segments())) return {};
  if (of_itself ? rows.num_joints() > 1 : !regression.reference()) return {};
  const FrictionExcess excess = ExcessGiven(regression, effects);
  const UsualMaximum usual = UsualExcess(regression, excess, of_itself);
  std::vector<GapEvent> events;
  for (const Contact& contact :
       FindContacts(regression.baseline().robot(), rows, excess,
                    usual.Quantile(Limits().false_contacts), search)) {
    if (IsKnown(known, contact.log, contact.time)) continue;
    if (!at_rest && LastsTooLong(rows.time(), contact)) continue;
    events.push_back(EventBeyondFriction(rows, excess, contact));
    events.back().chance = usual.Chance(contact.deviations);
    events.back().chance_of_logs =
        of_itself || regression.has_several_references();
    events.back().at_rest = at_rest;
  }
  return events;
}

}  // namespace armcal
