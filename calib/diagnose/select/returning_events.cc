#include "calib/diagnose/select/returning_events.h"

#include <algorithm>
#include <cmath>

#include "calib/diagnose/data/thresholds.h"
#include "model/signals/standstill.h"

namespace armcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Positions and velocities of thinned samples, each joint's over how far it is
// from its mean as a rule (rms); 0 of joints that rest, whose noise is no
// state. Over the root of the number of others, so that a distance is an rms of
// them.
MatrixXd StatesOf(const GapRows& rows) {
  std::vector<MatrixXd> fine;
  for (const GapSegment& segment : rows.segments()) {
    MatrixXd& state =
        fine.emplace_back(segment.motion.q.rows(), 2 * segment.motion.q.cols());
    state << segment.motion.q, segment.motion.qd;
  }
  MatrixXd states = rows.PickAll(fine);
  states.rowwise() -= states.colwise().mean();
  const Index n = states.cols() / 2;
  const auto rms = [&](Index c) {
    return std::sqrt(states.col(c).squaredNorm() /
                     static_cast<double>(states.rows()));
  };
  int moving = 0;
  for (Index j = 0; j < n; ++j) {
    const bool rests = rms(n + j) < kStandstillSpeed;
    for (const Index c : {j, n + j}) states.col(c) *= rests ? 0 : 1 / rms(c);
    moving += !rests;
  }
  return states / std::sqrt(std::max(1., 2. * moving));
}

double Distance(const MatrixXd& states, int a, int b) {
  return (states.row(a) - states.row(b)).norm();
}

// The thinned sample of a log next to a time; -1: there is none within a step.
int SampleAt(const GapRows& rows, int log, double time) {
  for (int s = 0; s < static_cast<int>(rows.segments().size()); ++s) {
    if (rows.segments()[s].log != log) continue;
    for (int k = rows.thin_begin(s); k < rows.thin_begin(s + 1); ++k) {
      if (std::abs(rows.thin_time(s, k) - time) <= rows.step(s)) return k;
    }
  }
  return -1;
}

// How near to a sample's state another passage may come: as near as the same
// state is, and as far as the arm goes in half a step, which samples of another
// passage may be off by.
double Tolerance(const MatrixXd& states, int sample) {
  const int before = std::max(0, sample - 1);
  const int after = std::min(static_cast<int>(states.rows()) - 1, sample + 1);
  const double step =
      Distance(states, before, after) / std::max(1, after - before);
  return Limits().same_state + step / 2;
}

// The samples nearest to a state, one for each time that the arm comes back to
// it: of each uninterrupted stretch of near ones that does not touch the
// event's window, in which the arm has not yet left the state.
std::vector<int> ReturnsTo(const GapRows& rows, const MatrixXd& states,
                           int centre, const GapEvent& event) {
  const double tolerance = Tolerance(states, centre);
  std::vector<int> returns;
  for (int s = 0; s < static_cast<int>(rows.segments().size()); ++s) {
    const bool is_own = rows.segments()[s].log == event.contact.log;
    bool was_near = false, is_return = false;
    for (int k = rows.thin_begin(s); k < rows.thin_begin(s + 1); ++k) {
      const double distance = Distance(states, k, centre);
      const bool in_window =
          is_own && event.contact.window.Contains(rows.thin_time(s, k));
      const bool is_near = distance <= tolerance;
      if (!is_near) {
        is_return = false;
      } else if (in_window) {
        if (is_return) returns.pop_back();
        is_return = false;
      } else if (!was_near) {
        returns.push_back(k);
        is_return = true;
      } else if (is_return &&
                 distance < Distance(states, returns.back(), centre)) {
        returns.back() = k;
      }
      was_near = is_near;
    }
  }
  return returns;
}

// Mean of what is left about a sample, within its segment.
double MeanAbout(const GapRows& rows, const VectorXd& left, int sample,
                 int reach) {
  const int s = rows.SegmentOf(sample);
  const int begin = std::max(rows.thin_begin(s), sample - reach);
  const int end = std::min(rows.thin_begin(s + 1), sample + reach + 1);
  return left.segment(begin, end - begin).mean();
}

// `states`: StatesOf(rows).
Returning TorqueOfReturns(const GapRows& rows, const MatrixXd& states,
                          const MatrixXd& left, const GapEvent& event) {
  const Contact& contact = ToldContact(event);
  const int centre = SampleAt(rows, contact.log, contact.time);
  if (centre < 0) return {};
  const double core = (contact.window.end - contact.window.begin) / 4;
  const int reach = static_cast<int>(core / rows.step(rows.SegmentOf(centre)));
  const VectorXd torque = left.col(contact.joint);
  const double own = MeanAbout(rows, torque, centre, reach);
  double sum = 0;
  int count = 0;
  for (const int sample : ReturnsTo(rows, states, centre, event)) {
    const double there = MeanAbout(rows, torque, sample, reach);
    if (!std::isfinite(there)) continue;
    sum += there;
    ++count;
  }
  if (!std::isfinite(own)) return {};
  return {own, count > 0 ? sum / count : 0, count};
}

}  // namespace

Returning ReturningTorque(const GapRows& rows, const MatrixXd& left,
                          const GapEvent& event) {
  return TorqueOfReturns(rows, StatesOf(rows), left, event);
}

bool Returns(const std::vector<Returning>& torques) {
  constexpr double kHalf = .5;
  double own = 0, left = 0;
  for (const Returning& torque : torques) {
    own += torque.own * torque.own;
    left += std::pow(torque.own - torque.returned, 2);
  }
  return left < kHalf * kHalf * own;
}

std::vector<Returning> ReturningTorques(
    const GapRegression& regression, const std::vector<GapCandidate>& effects,
    const std::vector<GapEvent>& events) {
  const JointRows torque = regression.TorqueOf(effects);
  const MatrixXd left =
      regression.data()->ResidualWith(regression.BaselineGiven(torque), torque);
  const MatrixXd states = StatesOf(regression.rows());
  std::vector<Returning> torques;
  for (const GapEvent& event : events) {
    if (event.at_rest) {
      torques.emplace_back();
      continue;
    }
    Returning one = TorqueOfReturns(regression.rows(), states, left, event);
    const int joint = ToldContact(event).joint;
    one.own /= regression.noise().joints[joint].stddev();
    one.returned /= regression.noise().joints[joint].stddev();
    torques.push_back(one);
  }
  return torques;
}

std::vector<GapEvent> WithoutReturning(const GapRegression& regression,
                                       const std::vector<GapCandidate>& effects,
                                       const std::vector<GapEvent>& events) {
  if (events.empty()) return events;
  const std::vector<Returning> torques =
      ReturningTorques(regression, effects, events);
  if (!Returns(torques)) return events;
  std::vector<GapEvent> kept;
  for (size_t k = 0; k < events.size(); ++k) {
    if (!Returns({torques[k]})) kept.push_back(events[k]);
  }
  return kept;
}

}  // namespace armcal
