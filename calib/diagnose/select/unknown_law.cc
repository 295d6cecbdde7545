#include "calib/diagnose/select/unknown_law.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "calib/diagnose/candidates/refinement.h"
#include "calib/diagnose/data/segment.h"
#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/select/pulses.h"

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

GapScreen Sized(GapScreen screen, const std::vector<int>& lacked, double size) {
  screen.ScaleBaseline(lacked, size);
  return screen;
}

std::vector<int> LackedOf(const GapBaseline& baseline, int joint) {
  std::vector<int> lacked;
  for (int c = 0; c < baseline.size(); ++c) {
    const BaselineColumn& column = baseline.columns()[c];
    if (column.kind == BaselineColumn::Kind::kDiscrepancy &&
        column.joint == joint) {
      lacked.push_back(c);
    }
  }
  return lacked;
}

// A pulse's course on its joint, whitened.
JointRows ColumnOf(const GapRows& rows, const VectorXd& usual_torque,
                   const GapEvent& event) {
  const int j = event.contact.joint;
  JointRows column(rows.num_joints());
  column[j] = rows.Whiten(j, usual_torque[j] * CourseOf(rows, event));
  return column;
}

double PlacesOfPulses(const GapRows& rows) {
  double places = 0;
  for (const double width : PulseScan::Widths()) places += rows.time() / width;
  return places * rows.num_joints();
}

}  // namespace

double LackedSize(const GapScreen& screen, const std::vector<int>& lacked,
                  const VectorXd& stddev) {
  std::vector<EvidenceNoise> noise;
  VectorXd time = VectorXd::Constant(screen.num_joints(), -kMinusInfinity);
  for (const double size : kSizes) {
    noise.push_back(SettleNoise(Sized(screen, lacked, size), stddev));
    time = time.cwiseMin(noise.back().time);
  }
  double most = kMinusInfinity, likeliest = kSizes.front();
  for (size_t i = 0; i < kSizes.size(); ++i) {
    noise[i].time = time;
    const double evidence =
        LogEvidence(Sized(screen, lacked, kSizes[i]), noise[i]);
    if (evidence > most) most = evidence, likeliest = kSizes[i];
  }
  return likeliest;
}

double UnknownLawOdds(const GapScreen& screen, const std::vector<int>& lacked,
                      double usual_size, const std::vector<JointRows>& pulses,
                      double places, const VectorXd& stddev) {
  const GapScreen with_pulses =
      WithColumns(Sized(screen, lacked, usual_size), pulses);
  const EvidenceNoise of_pulses = SettleNoise(with_pulses, stddev);
  double odds = kMinusInfinity;
  for (const double size : kSizes) {
    if (size <= usual_size) continue;
    const GapScreen law = Sized(screen, lacked, size);
    EvidenceNoise common = SettleNoise(law, stddev);
    common.time = common.time.cwiseMin(of_pulses.time);
    odds = std::max(
        odds, LogEvidence(law, common) - LogEvidence(with_pulses, common));
  }
  return odds + 2 * static_cast<double>(pulses.size()) * std::log(places) -
         2 * std::log(kSizes.size() * screen.num_joints());
}

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
    for (const GapCandidate& effect : effects) {
      lasting.push_back(WhitenEach(rows, unmasked.TorqueOf({effect})));
    }
    for (const GapEvent& event : pulses) {
      (event.contact.joint == joint ? own : lasting)
          .push_back(ColumnOf(rows, usual_torque, event));
    }
    const std::vector<int> lacked = LackedOf(unmasked.baseline(), joint);
    const double usual_size =
        LackedSize(before, lacked, reference.rows().evidence());
    const double odds =
        UnknownLawOdds(WithColumns(unmasked.screen(), lasting), lacked,
                       usual_size, own, PlacesOfPulses(rows), rows.evidence());
    if (odds > 0) found.push_back(joint);
  }
  return found;
}

}  // namespace armcal
