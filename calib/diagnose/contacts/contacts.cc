#include "calib/diagnose/contacts/contacts.h"

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

// Stretches of time that pass `threshold`, found with hysteresis: from a sample
// above it on to both sides for as long as half of it is passed, so that one
// push whose excess flickers is one stretch. They are widened by the time over
// which the excess was averaged, and joined where they then touch.
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

// The force at the tool that gives the joints these torques, tau = J' f with J
// the levers (3 x n), by weighted least squares with the prior f ~ N(0, usual^2
// I):
//   f = (J W J' + I / usual^2)^-1 J W tau,  W = diag(1 / stddev^2).
// It is told where the arm has more joints than the three components, where
// what it leaves passes a chi squared test at 99 % with n - 3 degrees of
// freedom, and where it is no larger than usual: a push elsewhere on the arm is
// not taken for one at the tool.
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

// What acted on the joints at the peak of a span. On a joint that slides
// friction is what the model has of it, and the torque is known to the noise. A
// joint at rest may hold anything between -coulomb and coulomb: within the
// `room` that is left there it is uniform, whose variance is room^2 / 3.
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

// The samples of a time in one segment, or the one that is nearest to it. A
// window that was told in another set of segments need not have a sample at its
// centre here.
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

// Each stretch whose excess passes the threshold is one contact, if it is where
// `search` looks. At rest a push has to act on an arm that rests in the same
// posture just before or after, held by its friction: the model's torque is
// known best there, and the window then lasts until it rests again. In motion
// two joints have to feel it at once, or one alone where the arm has one only:
// a single joint has friction of its own that comes and goes.
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

// The force where one is told, with its magnitude's standard deviation by the
// delta method, |f| having the gradient f / |f|; else the torque on the joint
// that felt it most. Times are known to the window over which the excess was
// averaged.
std::vector<EffectEstimate> ContactEstimates(const Robot& robot,
                                             const Contact& contact,
                                             std::vector<double>* stddev) {
  const int j = contact.joint;
  std::vector<EffectEstimate> estimates = {
      {"torque", EffortUnit(robot.links[j].joint.type), contact.torque[j]},
      {"time", "s", contact.time},
      {"width", "s",
       contact.width > 0 ? contact.width
                         : (contact.window.end - contact.window.begin) / 2}};
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
