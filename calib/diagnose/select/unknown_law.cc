#include "calib/diagnose/select/unknown_law.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "calib/diagnose/candidates/refinement.h"
#include "calib/diagnose/contacts/pulses.h"
#include "calib/diagnose/data/segment.h"
#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/select/returning_events.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr std::array<double, 4> kSizes = {1, 3, 10, 30};
constexpr double kMinusInfinity = -std::numeric_limits<double>::infinity();

GapScreen WithColumns(GapScreen screen, const std::vector<JointRows>& more) {
  for (const JointRows& column : more) screen.AddColumn(column);
  screen.Factor();
  return screen;
}

GapScreen Sized(GapScreen screen, const std::vector<int>& discrepancy,
                double size) {
  screen.ScaleBaseline(discrepancy, size);
  return screen;
}

std::vector<int> DiscrepancyColumns(const GapBaseline& baseline, int joint) {
  std::vector<int> discrepancy;
  for (int c = 0; c < baseline.size(); ++c) {
    const BaselineColumn& column = baseline.columns()[c];
    if (column.kind == BaselineColumn::Kind::kDiscrepancy &&
        column.joint == joint) {
      discrepancy.push_back(c);
    }
  }
  return discrepancy;
}

// A push of any course within its window that is as smooth as the shortest one
// that is looked for: pulses of that width, a width apart, about the window's
// centre, and none closer than a width to its ends.
std::vector<GapEvent> CourseOfAny(const GapEvent& push) {
  const TimeRange& window = push.contact.window;
  const double width = Limits().shortest_push;
  const double reach = Limits().event_reach * width;
  const double inside = window.end - window.begin - 2 * width;
  const int count = 1 + std::max(0, static_cast<int>(inside / width + .5));
  std::vector<GapEvent> course(count, push);
  for (int k = 0; k < count; ++k) {
    const double centre =
        (window.begin + window.end) / 2 + (k - (count - 1) / 2.) * width;
    course[k].contact.window = {centre - reach, centre + reach};
  }
  return course;
}

// A pulse's course on its joint, whitened.
JointRows ColumnOf(const GapRows& rows, const VectorXd& usual_torque,
                   const GapEvent& event) {
  const int j = event.contact.joint;
  JointRows column(rows.num_joints());
  column[j] = rows.Whiten(j, usual_torque[j] * CourseOf(rows, event));
  return column;
}

std::vector<JointRows> ColumnsOfAny(const GapRows& rows,
                                    const VectorXd& usual_torque,
                                    const std::vector<GapEvent>& pushes) {
  std::vector<JointRows> columns;
  for (const GapEvent& push : pushes) {
    for (const GapEvent& part : CourseOfAny(push)) {
      columns.push_back(ColumnOf(rows, usual_torque, part));
    }
  }
  return columns;
}

// In how many places a pulse could have been: how many of a width's length fit
// into the time, over all widths and joints. A pulse had to be chosen among
// them.
double PlacesOfPulses(const GapRows& rows) {
  double places = 0;
  for (const std::vector<double>& bank : PulseScan::Banks()) {
    for (const double width : bank) places += rows.time() / width;
  }
  return places * rows.num_joints();
}

}  // namespace

// All sizes are compared under one correlation time, the least that any of them
// leaves: evidences that are tempered by different exponents cannot be compared
// (CompareLarger).
double DiscrepancySize(const GapScreen& screen,
                       const std::vector<int>& discrepancy,
                       const VectorXd& stddev) {
  std::vector<EvidenceNoise> noise;
  VectorXd time = VectorXd::Constant(screen.num_joints(), -kMinusInfinity);
  for (const double size : kSizes) {
    noise.push_back(SettleNoise(Sized(screen, discrepancy, size), stddev));
    time = time.cwiseMin(noise.back().time);
  }
  double most = kMinusInfinity, likeliest = kSizes.front();
  for (size_t i = 0; i < kSizes.size(); ++i) {
    noise[i].time = time;
    const double evidence =
        LogEvidence(Sized(screen, discrepancy, kSizes[i]), noise[i]);
    if (evidence > most) most = evidence, likeliest = kSizes[i];
  }
  return likeliest;
}

// Two models of what a joint has left, under the same effects and the same
// data: a law of state and time that no catalogue has, told by a discrepancy of
// s times its usual size, and pulses that came and went, a column each. The
// first acts in all of the log and pays for its freedom by the determinant in
// the evidence; the second pays for the places it was chosen from, 2 ln(places)
// each push, and both for the choice among sizes and joints. Above 0 the law is
// likelier.
double UnknownLawOdds(const GapScreen& screen,
                      const std::vector<int>& discrepancy, double usual_size,
                      const std::vector<JointRows>& pulses, double log_places,
                      const VectorXd& stddev) {
  const GapScreen with_pulses =
      WithColumns(Sized(screen, discrepancy, usual_size), pulses);
  const EvidenceNoise of_pulses = SettleNoise(with_pulses, stddev);
  double odds = kMinusInfinity;
  for (const double size : kSizes) {
    if (size <= usual_size) continue;
    const GapScreen law = Sized(screen, discrepancy, size);
    EvidenceNoise common = SettleNoise(law, stddev);
    common.time = common.time.cwiseMin(of_pulses.time);
    odds = std::max(
        odds, LogEvidence(law, common) - LogEvidence(with_pulses, common));
  }
  return odds + 2 * log_places -
         2 * std::log(kSizes.size() * screen.num_joints());
}

// Events that are no pulses stay masked, and each pulse becomes a column of its
// own joint: the log is seen as it is, and only what explains it differs.
// Effects that were chosen, and the pulses of other joints, are in both models,
// lest what they explain be taken for a law of this one. How large a
// discrepancy the reference already shows is where the larger ones start from.
// A push is a pulse of one of two widths, or of any course within its window:
// a hold of a second that single pulses are fitted to leaves so much that a law
// would be the likelier one. The law has to be likelier than either.
std::vector<int> JointsWithUnknownLaw(const GapRegression& regression,
                                      const std::vector<GapCandidate>& effects,
                                      const std::vector<GapEvent>& events) {
  GapRegression unmasked(regression, regression.rows().part());
  std::vector<GapEvent> pulses, others;
  for (const GapEvent& event : events) {
    (event.pulse ? pulses : others).push_back(event);
  }
  MaskEvents(others, unmasked.data());
  unmasked.Refit();
  const GapRows& rows = unmasked.rows();
  const VectorXd usual_torque = UsualTorque(rows.segments());
  const GapData& reference = *unmasked.reference();
  GapScreen before = reference.Screen();
  before.Factor();
  std::set<int> joints;
  for (const GapEvent& event : pulses) joints.insert(event.contact.joint);
  std::vector<int> found;
  for (const int joint : joints) {
    std::vector<JointRows> lasting, own;
    std::vector<GapEvent> own_pulses;
    for (const GapCandidate& effect : effects) {
      lasting.push_back(WhitenEach(rows, unmasked.TorqueOf({effect})));
    }
    for (const GapEvent& event : pulses) {
      const bool is_own = event.contact.joint == joint;
      if (is_own) own_pulses.push_back(event);
      (is_own ? own : lasting).push_back(ColumnOf(rows, usual_torque, event));
    }
    const std::vector<int> discrepancy =
        DiscrepancyColumns(unmasked.baseline(), joint);
    const double usual_size =
        DiscrepancySize(before, discrepancy, reference.rows().evidence());
    const GapScreen given = WithColumns(unmasked.screen(), lasting);
    const auto odds_against = [&](const std::vector<JointRows>& columns,
                                  size_t count) {
      return UnknownLawOdds(
          given, discrepancy, usual_size, columns,
          static_cast<double>(count) * std::log(PlacesOfPulses(rows)),
          rows.evidence());
    };
    const std::vector<GapEvent> pushes = JoinedPulses(own_pulses);
    const double odds = std::min(
        odds_against(own, own.size()),
        odds_against(ColumnsOfAny(rows, usual_torque, pushes), pushes.size()));
    if (odds > 0) found.push_back(joint);
  }
  return found;
}

bool IsLawRefuted(const std::vector<GapEvent>& events,
                  const std::vector<Returning>& torques, int joint) {
  std::vector<Returning> asked;
  double all = 0, own = 0;
  for (size_t k = 0; k < events.size(); ++k) {
    if (!events[k].pulse || events[k].contact.joint != joint) continue;
    const double square = torques[k].own * torques[k].own;
    all += square;
    if (torques[k].times == 0) continue;
    own += square;
    asked.push_back(torques[k]);
  }
  return own > .5 * all && !Returns(asked);
}

std::vector<GapEvent> WithoutPulsesOfUnknownLaws(
    const GapRegression& regression, const std::vector<GapCandidate>& effects,
    const std::vector<GapEvent>& events) {
  const auto is_pulse = [](const GapEvent& event) { return event.pulse; };
  if (std::none_of(events.begin(), events.end(), is_pulse)) return events;
  const std::vector<int> joints =
      JointsWithUnknownLaw(regression, effects, events);
  if (joints.empty()) return events;
  const std::vector<Returning> torques =
      ReturningTorques(regression, effects, events);
  std::vector<GapEvent> kept;
  for (const GapEvent& event : events) {
    const bool of_law =
        std::count(joints.begin(), joints.end(), event.contact.joint) > 0 &&
        !IsLawRefuted(events, torques, event.contact.joint);
    if (!event.pulse || !of_law) kept.push_back(event);
  }
  return kept;
}

}  // namespace armcal
