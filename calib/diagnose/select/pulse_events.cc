#include "calib/diagnose/select/pulse_events.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "calib/diagnose/data/motion_range.h"
#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/select/maxima_tail.h"
#include "calib/diagnose/select/pulses.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// What the model alone leaves. What models lack as a rule (Discrepancy) is not
// fitted, since it is flexible enough to follow a push in a short log: it is as
// large as its prior says.
class ModelOfPulses {
 public:
  // The model's values x given the effects, and their covariance C: what the
  // fit knows of its own columns, and the prior of the discrepancy's, which was
  // not fitted here. PulseScan adds X C X' to the variance of every pulse, so
  // that what the model may have wrong is no push.
  ModelOfPulses(const GapRegression& regression, const JointRows& torque)
      : x_(regression.ModelGiven(torque)),
        robot_(regression.baseline().With(x_)),
        range_(regression.reference()->rows()),
        covariance_(MatrixXd::Identity(x_.size(), x_.size())) {
    const int fitted = regression.baseline().num_model_columns();
    covariance_.topLeftCorner(fitted, fitted) =
        regression.screen().BaselineCovariance().topLeftCorner(fitted, fitted);
    const GapData& reference = *regression.reference();
    const MatrixXd left = reference.ResidualWith(x_);
    for (int j = 0; j < left.cols(); ++j) {
      noise_.push_back(NoiseOf(reference.rows(), j, left.col(j)));
    }
  }

  const Robot& robot() const { return robot_; }
  // `growth`: how much larger the variance of what it leaves is, per joint.
  PulseScan Scan(const GapData& data, const JointRows& torque,
                 const VectorXd& growth) const {
    PulseScan::Model model{data.columns(), covariance_, noise_};
    for (int j = 0; j < growth.size(); ++j) {
      model.noise[j].sigma *= std::sqrt(growth[j]);
    }
    return PulseScan(data.rows(), model, data.ResidualWith(x_, torque),
                     ExtraStddev(data.rows(), model.noise));
  }

 private:
  // The noise that a pulse is held against: an autoregression fitted to what
  // the model leaves of the reference, which nothing touched, in all
  // uninterrupted stretches that count, joints at rest included. Samples whose
  // variance is more than twice the noise's are masked or next to a reversal of
  // friction, and end a stretch.
  static Autoregression NoiseOf(const GapRows& rows, int joint,
                                const VectorXd& left) {
    std::vector<VectorXd> stretches;
    const double most = 2 * std::pow(rows.noise(joint).stddev(), 2);
    for (size_t i = 0; i < rows.segments().size(); ++i) {
      const int s = static_cast<int>(i);
      int begin = rows.thin_begin(s);
      for (int k = begin; k <= rows.thin_begin(s + 1); ++k) {
        if (k < rows.thin_begin(s + 1) && rows.IsInPart(s, k) &&
            rows.variance(joint, k) < most) {
          continue;
        }
        if (k > begin) stretches.push_back(left.segment(begin, k - begin));
        begin = k + 1;
      }
    }
    return FitYuleWalker(stretches);
  }

  // The standard deviation of what else may be wrong with samples, a row each.
  // Three causes are added. The rows have an extra variance of their own around
  // reversals of friction (GapData). Where the motion is beyond what the
  // reference has, errors of inertias and of drag grow by MotionRange's factor
  // f, and what the model leaves has the variance f^2 of that in the reference.
  // A joint that does not slide holds any torque up to its Coulomb friction,
  // and the torque of joints without a motor is told in no unit: these samples
  // say nothing, and have an infinite one.
  MatrixXd ExtraStddev(const GapRows& rows,
                       const std::vector<Autoregression>& noise) const {
    constexpr double kUnknown = std::numeric_limits<double>::infinity();
    const Eigen::ArrayXd growth = range_.Growth(rows);
    const VectorXd usual = UsualTorque(rows.segments());
    MatrixXd extra_stddev(rows.num_thin(), rows.num_joints());
    for (int j = 0; j < rows.num_joints(); ++j) {
      const double own = std::pow(rows.noise(j).stddev(), 2);
      const double left = std::pow(noise[j].stddev(), 2);
      const bool sticks = robot_.links[j].joint.coulomb > 0;
      for (int k = 0; k < rows.num_thin(); ++k) {
        const bool holds = sticks && rows.IsHeld(rows.SegmentOf(k), j, k);
        extra_stddev(k, j) =
            holds || usual[j] == 0
                ? kUnknown
                : std::sqrt(std::max(0., rows.variance(j, k) - own) +
                            left * (growth[k] * growth[k] - 1));
      }
    }
    return extra_stddev;
  }

  VectorXd x_;
  Robot robot_;
  MotionRange range_;
  MatrixXd covariance_;
  std::vector<Autoregression> noise_;
};

// The largest squared deviations in as much time as the shortest push takes,
// each: chi^2 of one degree, whose tail is nearly exponential as TailOf has it.
// Nothing is looked for where nothing is seen.
std::vector<double> Looks(const GapRows& rows, const PulseScan& scan) {
  std::vector<double> looks =
      BlockMaxima(rows, 2 * Limits().event_reach * Limits().shortest_push,
                  scan.Largest().cwiseAbs2());
  looks.erase(std::remove(looks.begin(), looks.end(), 0.), looks.end());
  return looks;
}

// Of motion that no fit has seen (ReferenceNoise).
VectorXd GrowthOf(const GapNoise& noise, int n) {
  VectorXd growth = VectorXd::Ones(n);
  for (size_t j = 0; j < noise.extra_variance.size(); ++j)
    growth[j] += noise.extra_variance[j];
  return growth;
}

// How probable it is that noise alone gets as far at any time, on any joint,
// for any width that is looked for. What a Gaussian pulse of this width makes
// of white noise has the autocorrelation exp(-(dt / width)^2 / 2), and
// upcrosses d at the rate exp(-d^2 / 2) / (2 pi width) (Rice 1945); of both
// signs twice that. For large d the expected number of crossings is the
// probability of one, which is a bound in any case (Boole).
double ChanceOfNoise(const GapRows& rows, double deviations) {
  double crossings = 0;
  for (const double width : PulseScan::Widths()) {
    crossings += rows.num_joints() * rows.time() / (M_PI * width);
  }
  return crossings * std::exp(-deviations * deviations / 2);
}

// The pulse at a sample that stands out most on `joint`, told on all joints:
// the same course is fitted to each, since a push is felt by several.
// delta_chi2 is the sum of the squared deviations, chi squared of as many
// degrees as there are joints, and `one_joint` the share of the strongest. Of
// joints that are not seen there the torque is 0 within their Coulomb friction.
GapEvent EventOf(const GapRows& rows, const Robot& robot, const PulseScan& scan,
                 int sample, int joint) {
  const double width = scan.widths()(sample, joint);
  const int n = rows.num_joints(), segment = rows.SegmentOf(sample);
  GapEvent event;
  Contact& contact = event.contact;
  contact.log = rows.segments()[segment].log;
  contact.time = rows.thin_time(segment, sample);
  contact.window = {contact.time - Limits().event_reach * width,
                    contact.time + Limits().event_reach * width};
  contact.joint = joint;
  contact.deviations = std::abs(scan.deviations()(sample, joint));
  contact.torque.resize(n);
  contact.stddev.resize(n);
  for (int j = 0; j < n; ++j) {
    const Pulse pulse = scan.At(j, sample, width);
    contact.torque[j] = pulse.torque;
    contact.stddev[j] = std::isfinite(pulse.stddev)
                            ? pulse.stddev
                            : std::max(0., robot.links[j].joint.coulomb);
    event.delta_chi2 += pulse.deviations * pulse.deviations;
  }
  event.score = event.delta_chi2;
  event.one_joint = std::pow(contact.deviations, 2) / event.delta_chi2;
  event.pulse = event.beyond_friction = true;
  return event;
}

// Thinned samples of a contact's window.
std::vector<int> SamplesOf(const GapRows& rows, const Contact& contact) {
  std::vector<int> samples;
  for (int k = 0; k < rows.num_thin(); ++k) {
    const int segment = rows.SegmentOf(k);
    if (rows.segments()[segment].log == contact.log &&
        contact.window.Contains(rows.thin_time(segment, k))) {
      samples.push_back(k);
    }
  }
  return samples;
}

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
bool OnlyBrake(const GapRows& rows, const std::vector<GapEvent>& events) {
  constexpr int kLeastCases = 5;  // 3 %
  for (int j = 0; j < rows.num_joints(); ++j) {
    int with = 0, against = 0;
    for (const GapEvent& event : events) {
      if (event.contact.joint != j) continue;
      const double power =
          event.contact.torque[j] * VelocityAt(rows, event.contact, j);
      (power < 0 ? against : with) += 1;
    }
    if (against >= kLeastCases && with == 0) return true;
  }
  return false;
}

// Pulses in logs, and what of them a reference has by itself.
class PulseSearch {
 public:
  PulseSearch(const GapRegression& regression,
              const std::vector<GapCandidate>& effects)
      : rows_(regression.rows()),
        torque_(regression.TorqueOf(effects)),
        model_(regression, torque_),
        scan_(model_.Scan(*regression.data(), torque_,
                          GrowthOf(regression.noise(), rows_.num_joints()))) {
    const int n = rows_.num_joints();
    const GapData& reference = *regression.reference();
    usual_ = {
        static_cast<double>(Looks(rows_, scan_).size()),
        {TailOf(Looks(reference.rows(), model_.Scan(reference, JointRows(n),
                                                    VectorXd::Ones(n))))}};
  }
  // Of one as large anywhere in the log, without a contact.
  double Chance(double deviations) const {
    return std::max(usual_.Chance(deviations * deviations),
                    ChanceOfNoise(rows_, deviations));
  }
  // Each of them, from the largest on, until noise or the reference's own
  // pulses give one as large with a probability of false_contacts. The window
  // of one that was found is not looked at again: its flanks are no pushes of
  // their own.
  std::vector<GapEvent> Find() const {
    MatrixXd deviations = scan_.deviations().cwiseAbs();
    std::vector<GapEvent> events;
    int sample, joint;
    while (true) {
      const double chance = Chance(deviations.maxCoeff(&sample, &joint));
      if (!(chance < Limits().false_contacts)) return events;
      events.push_back(EventOf(rows_, model_.robot(), scan_, sample, joint));
      events.back().chance = chance;
      for (const int k : SamplesOf(rows_, events.back().contact)) {
        deviations.row(k).setZero();
      }
    }
  }
  // The largest within a window, and its chance: 1 where none is seen.
  GapEvent LargestIn(const Contact& contact) const {
    const VectorXd all = scan_.Largest();
    double largest = 0;
    int sample = -1, joint;
    for (const int k : SamplesOf(rows_, contact)) {
      if (all[k] > largest) largest = all[k], sample = k;
    }
    if (sample < 0) return {};
    scan_.deviations().row(sample).cwiseAbs().maxCoeff(&joint);
    GapEvent event = EventOf(rows_, model_.robot(), scan_, sample, joint);
    event.chance = Chance(largest);
    return event;
  }

 private:
  const GapRows& rows_;
  JointRows torque_;
  ModelOfPulses model_;
  PulseScan scan_;
  UsualMaximum usual_;
};

// A fit that does not see these events, and all the rest.
GapRegression MaskedBy(const std::vector<GapEvent>& events,
                       const GapRegression& regression) {
  GapRegression masked(regression, regression.rows().part());
  masked.data()->Unmask();
  MaskEvents(events, masked.data());
  masked.Refit();
  return masked;
}

}  // namespace

// Pulses that stand out in more of the time than contacts may take are what the
// model lacks, and forces that only ever brake a joint are friction that comes
// and goes. Either spoils all of them: one that is real cannot be told among
// them.
std::vector<GapEvent> FindPulses(const GapRegression& regression,
                                 const std::vector<GapCandidate>& effects) {
  if (!regression.reference()) return {};
  const GapRows& rows = regression.rows();
  std::vector<GapEvent> events = PulseSearch(regression, effects).Find();
  double time = 0;
  for (GapEvent& event : events) {
    event.chance_of_logs = regression.has_several_references();
    time += (event.contact.window.end - event.contact.window.begin) /
            Limits().event_reach;
  }
  if (time > Limits().most_of_time * rows.time() || OnlyBrake(rows, events)) {
    events.clear();
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
  const PulseSearch search(unmasked, effects);
  kept.clear();
  for (const GapEvent& event : events) {
    if (event.pulse &&
        !(search.LargestIn(event.contact).chance < Limits().false_contacts)) {
      continue;
    }
    kept.push_back(event);
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
  const PulseSearch search(unmasked, effects);
  for (GapEvent& event : *events) {
    if (event.beyond_friction) continue;
    const GapEvent pulse = search.LargestIn(event.contact);
    if (!(pulse.chance < Limits().false_contacts)) continue;
    event.beyond_friction = true;
    event.chance = pulse.chance;
    event.as_pulse = pulse.contact;
    event.chance_of_logs = regression.has_several_references();
  }
}

}  // namespace armcal
