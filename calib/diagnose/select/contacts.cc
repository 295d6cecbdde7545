#include "calib/diagnose/select/contacts.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "calib/diagnose/data/thresholds.h"
#include "model/dynamics/rigid_arm.h"

namespace armcal {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDeviations = 3;  // of the usual force, at most

// Thinned samples [begin, end) of a segment.
struct Span {
  int segment;
  int begin, end;
};

Span Widened(const GapRows& rows, Span span, double time) {
  const int by = static_cast<int>(std::lround(time / rows.step(span.segment)));
  span.begin = std::max(rows.thin_begin(span.segment), span.begin - by);
  span.end = std::min(rows.thin_begin(span.segment + 1), span.end + by);
  return span;
}

// Runs above the threshold, as long as half of it is passed, and by the time
// that means are over on either side; those that then touch are one.
std::vector<Span> SpansAbove(const GapRows& rows, const VectorXd& largest,
                             double threshold) {
  std::vector<Span> spans;
  for (size_t i = 0; i < rows.segments().size(); ++i) {
    const int s = static_cast<int>(i);
    const int first = rows.thin_begin(s), last = rows.thin_begin(s + 1);
    for (int k = first; k < last; ++k) {
      if (!(largest[k] > threshold)) continue;
      Span span{s, k, k + 1};
      const auto is_high = [&](int i) { return largest[i] > threshold / 2; };
      while (span.begin > first && is_high(span.begin - 1)) --span.begin;
      while (span.end < last && is_high(span.end)) ++span.end;
      k = span.end;
      span = Widened(rows, span, Limits().shortest_push);
      if (!spans.empty() && spans.back().segment == s &&
          span.begin <= spans.back().end) {
        spans.back().end = span.end;
      } else {
        spans.push_back(span);
      }
    }
  }
  return spans;
}

class RestingArm {
 public:
  RestingArm(const GapRows& rows, const FrictionExcess& excess)
      : rows_(rows), largest_(excess.Largest()) {
    const int n = rows.num_joints();
    q_.resize(rows.num_thin(), n);
    rests_.resize(rows.num_thin());
    for (size_t i = 0; i < rows.segments().size(); ++i) {
      const int s = static_cast<int>(i), begin = rows.thin_begin(s);
      const GapSegment& segment = rows.segments()[i];
      const MatrixXd q = rows.Pick(s, segment.motion.q);
      const MatrixXd still =
          rows.Pick(s, segment.still.cast<double>().matrix());
      q_.middleRows(begin, q.rows()) = q;
      for (int k = 0; k < q.rows(); ++k) {
        rests_[begin + k] = still.row(k).minCoeff() > 0;
      }
    }
  }

  const MatrixXd& q() const { return q_; }
  bool Rests(int k) const { return rests_[k]; }
  // A push that moves a resting arm lasts until it rests, or goes elsewhere.
  Span UntilRest(Span span, int peak) const {
    const int first = rows_.thin_begin(span.segment);
    const int last = rows_.thin_begin(span.segment + 1);
    const auto sways = [&](int k) { return !rests_[k] && IsSame(k, peak); };
    while (span.begin > first && sways(span.begin - 1)) --span.begin;
    while (span.end < last && sways(span.end)) ++span.end;
    return span;
  }
  // Whether the arm rested within its friction shortly before or after, where
  // it is at the peak.
  bool IsNear(const Span& span, int peak) const {
    const Span around = Widened(rows_, span, Limits().near_rest);
    const auto same = [&](int k) {
      return rests_[k] && largest_[k] < 0 && IsSame(k, peak);
    };
    for (int k = around.begin; k < around.end; ++k) {
      if ((k < span.begin || k >= span.end) && same(k)) return true;
    }
    return false;
  }

 private:
  bool IsSame(int k, int other) const {
    return (q_.row(k) - q_.row(other)).cwiseAbs().maxCoeff() <
           Limits().same_posture;
  }

  const GapRows& rows_;
  VectorXd largest_;
  MatrixXd q_;
  std::vector<bool> rests_;
};

int PeakIn(const Span& span, const VectorXd& largest) {
  int peak;
  largest.segment(span.begin, span.end - span.begin).maxCoeff(&peak);
  return span.begin + peak;
}

bool IsFeltByTwo(const Span& span, const MatrixXd& deviations,
                 double threshold) {
  const auto felt =
      deviations.middleRows(span.begin, span.end - span.begin).array() >
      threshold;
  return (felt.rowwise().count() > 1).any();
}

// 99 % of chi^2 (Wilson and Hilferty 1931).
double LargestChiSquare(int degrees) {
  constexpr double kNormal = 2.326;
  const double v = 2. / (9 * degrees);
  return degrees * std::pow(1 - v + kNormal * std::sqrt(v), 3);
}

// Levers of the joints about the tool's origin, 3 x n, m.
MatrixXd Levers(const Robot& robot, const VectorXd& q) {
  const int n = robot.num_joints();
  ArmTerms terms;
  RigidArm(robot).Evaluate(q, VectorXd::Zero(n),
                           {{n - 1, robot.X_LT.translation()}}, &terms);
  return terms.points[0].jacobian.bottomRows<3>();
}

// Where no joint has a lever about the force's line, any force would do: one
// whose levers are all shorter than usual is improbable.
double UsualForce(const MatrixXd& lever, const VectorXd& torque) {
  return torque.cwiseAbs().maxCoeff() /
         (Limits().usual_lever *
          std::max(1e-9, lever.colwise().norm().maxCoeff()));
}

std::optional<Contact::Force> ForceBehind(const MatrixXd& lever,
                                          const Contact& contact) {
  const int n = static_cast<int>(lever.cols());
  const VectorXd weight = contact.stddev.cwiseAbs2().cwiseInverse();
  const double usual = UsualForce(lever, contact.torque);
  if (n <= 3 || !(usual > 0)) return {};
  const Matrix3d information = lever * weight.asDiagonal() * lever.transpose() +
                               Matrix3d::Identity() / (usual * usual);
  Contact::Force force;
  force.covariance = information.inverse();
  force.value = force.covariance * lever * weight.cwiseProduct(contact.torque);
  const VectorXd left = contact.torque - lever.transpose() * force.value;
  const bool fits = left.cwiseAbs2().dot(weight) <= LargestChiSquare(n - 3);
  if (!fits || force.value.norm() > usual) return {};
  return force;
}

Contact Describe(const Robot& robot, const GapRows& rows,
                 const FrictionExcess& excess, const RestingArm& arm,
                 const Span& span) {
  Contact contact;
  const int peak = PeakIn(span, excess.Largest());
  contact.log = rows.segments()[span.segment].log;
  contact.window = {rows.thin_time(span.segment, span.begin),
                    rows.thin_time(span.segment, span.end - 1)};
  contact.time = rows.thin_time(span.segment, peak);
  contact.deviations = excess.deviations.row(peak).maxCoeff(&contact.joint);
  contact.torque = (excess.friction - excess.torque).row(peak);
  contact.stddev.resize(rows.num_joints());
  for (int j = 0; j < rows.num_joints(); ++j) {
    const double room =
        std::max(0., excess.coulomb[j] - std::abs(excess.friction(peak, j)));
    contact.stddev[j] =
        std::sqrt(std::pow(rows.noise(j).stddev(), 2) + room * room / 3);
  }
  const MatrixXd lever = Levers(robot, arm.q().row(peak));
  contact.force = ForceBehind(lever, contact);
  contact.largest_force = kDeviations * UsualForce(lever, contact.torque);
  return contact;
}

// The samples of a time in one segment, or the one that is nearest to it.
Span SpanOf(const GapRows& rows, int log, const TimeRange& window) {
  const double centre = (window.begin + window.end) / 2;
  Span nearest{0, 0, 0};
  double least = INFINITY;
  for (size_t i = 0; i < rows.segments().size(); ++i) {
    const int s = static_cast<int>(i);
    if (rows.segments()[i].log != log) continue;
    for (int k = rows.thin_begin(s); k < rows.thin_begin(s + 1); ++k) {
      const double away = std::abs(rows.thin_time(s, k) - centre);
      if (away < least) nearest = {s, k, k + 1}, least = away;
    }
  }
  const auto has = [&](int k) {
    return window.Contains(rows.thin_time(nearest.segment, k));
  };
  const int first = rows.thin_begin(nearest.segment);
  const int last = rows.thin_begin(nearest.segment + 1);
  while (nearest.begin > first && has(nearest.begin - 1)) --nearest.begin;
  while (nearest.end < last && has(nearest.end)) ++nearest.end;
  return nearest;
}

}  // namespace

std::vector<Contact> FindContacts(const Robot& robot, const GapRows& rows,
                                  const FrictionExcess& excess,
                                  double threshold, ContactSearch search) {
  const VectorXd largest = excess.Largest();
  const RestingArm arm(rows, excess);
  std::vector<Contact> contacts;
  for (Span span : SpansAbove(rows, largest, threshold)) {
    const int peak = PeakIn(span, largest);
    if (search == ContactSearch::kAtRest) {
      span = arm.UntilRest(span, peak);
      if (!arm.IsNear(span, peak)) continue;
    } else if (arm.Rests(peak) ||
               (search == ContactSearch::kOfTwoJoints &&
                !IsFeltByTwo(span, excess.deviations, threshold))) {
      continue;
    }
    contacts.push_back(Describe(robot, rows, excess, arm, span));
  }
  return contacts;
}

Contact DescribeContact(const Robot& robot, const GapRows& rows,
                        const FrictionExcess& excess, int log,
                        const TimeRange& window) {
  return Describe(robot, rows, excess, RestingArm(rows, excess),
                  SpanOf(rows, log, window));
}

ContactStrength StrengthOf(const GapRows& rows, const FrictionExcess& excess,
                           const Contact& contact) {
  const Span span = SpanOf(rows, contact.log, contact.window);
  const MatrixXd beyond =
      excess.deviations.middleRows(span.begin, span.end - span.begin)
          .cwiseMax(0);
  const VectorXd joints = beyond.colwise().squaredNorm();
  return {joints.sum(), joints.maxCoeff()};
}

std::vector<EffectEstimate> ContactEstimates(const Robot& robot,
                                             const Contact& contact,
                                             std::vector<double>* stddev) {
  const int j = contact.joint;
  std::vector<EffectEstimate> estimates = {
      {"torque", EffortUnit(robot.links[j].joint.type), contact.torque[j]},
      {"time", "s", contact.time},
      {"width", "s", (contact.window.end - contact.window.begin) / 2}};
  *stddev = {contact.stddev[j], Limits().shortest_push, Limits().shortest_push};
  if (!contact.force) return estimates;
  const Eigen::Vector3d& f = contact.force->value;
  const Matrix3d& C = contact.force->covariance;
  estimates[0] = {"force", "N", f.norm()};
  (*stddev)[0] = std::sqrt(f.dot(C * f)) / f.norm();
  const char* names[] = {"force_x", "force_y", "force_z"};
  for (int k = 0; k < 3; ++k) {
    estimates.push_back({names[k], "N", f[k]});
    stddev->push_back(std::sqrt(C(k, k)));
  }
  return estimates;
}

}  // namespace armcal
