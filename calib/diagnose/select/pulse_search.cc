#include "calib/diagnose/select/pulse_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/diagnose/data/motion_range.h"
#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/select/excess.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

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
                 int sample, int joint, double width) {
  const int n = rows.num_joints(), segment = rows.SegmentOf(sample);
  GapEvent event;
  Contact& contact = event.contact;
  contact.log = rows.segments()[segment].log;
  contact.time = rows.thin_time(segment, sample);
  contact.width = width;
  contact.window = {contact.time - Limits().event_reach * width,
                    contact.time + Limits().event_reach * width};
  contact.joint = joint;
  contact.torque.resize(n);
  contact.stddev.resize(n);
  for (int j = 0; j < n; ++j) {
    const Pulse pulse = scan.At(j, sample, width);
    if (j == joint) contact.deviations = std::abs(pulse.deviations);
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
        known_(regression.baseline().known()),
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

  // As a Coulomb friction of its own or by a law that the robot is known to
  // have.
  bool HasDryFriction(int joint) const {
    const auto& laws = known_.parameters();
    return robot_.links[joint].joint.coulomb > 0 ||
           std::any_of(laws.begin(), laws.end(),
                       [joint](const KnownEffects::Parameter& law) {
                         return law.joint == joint && law.dry != 0;
                       });
  }

  // The standard deviation of what else may be wrong with samples, a row each.
  // Three causes are added. The rows have an extra variance of their own around
  // reversals of friction (GapData). Where the motion is beyond what the
  // reference has, errors of inertias and of drag grow by MotionRange's factor
  // f, and what the model leaves has the variance f^2 of that in the reference.
  // A joint that does not slide holds any torque up to its Coulomb friction,
  // the torque of joints without a motor is told in no unit, and what a joint
  // needs the way that the reference never moved it is not known: these samples
  // say nothing, and have an infinite one.
  MatrixXd ExtraStddev(const GapRows& rows,
                       const std::vector<Autoregression>& noise) const {
    constexpr double kUnknown = std::numeric_limits<double>::infinity();
    const Eigen::ArrayXd growth = range_.Growth(rows);
    const auto knows = range_.Knows(rows);
    const VectorXd usual = UsualTorque(rows.segments());
    MatrixXd extra_stddev(rows.num_thin(), rows.num_joints());
    for (int j = 0; j < rows.num_joints(); ++j) {
      const double own = std::pow(rows.noise(j).stddev(), 2);
      const double left = std::pow(noise[j].stddev(), 2);
      const bool sticks = HasDryFriction(j);
      for (int k = 0; k < rows.num_thin(); ++k) {
        const bool holds = sticks && rows.IsHeld(rows.SegmentOf(k), j, k);
        extra_stddev(k, j) =
            holds || usual[j] == 0 || !knows(k, j)
                ? kUnknown
                : std::sqrt(std::max(0., rows.variance(j, k) - own) +
                            left * (growth[k] * growth[k] - 1));
      }
    }
    return extra_stddev;
  }

  VectorXd x_;
  Robot robot_;
  const KnownEffects& known_;
  MotionRange range_;
  MatrixXd covariance_;
  std::vector<Autoregression> noise_;
};

}  // namespace

PulseSearch::PulseSearch(const GapRegression& regression,
                         const std::vector<GapCandidate>& effects,
                         const GapData& data)
    : rows_(data.rows()) {
  const int n = rows_.num_joints();
  const JointRows torque = regression.TorqueOf(effects);
  const ModelOfPulses model(regression, torque);
  robot_ = model.robot();
  scan_.emplace(model.Scan(data, torque, GrowthOf(regression.noise(), n)));
  squares_ = scan_->deviations().cwiseAbs2();
  const GapData& reference = *regression.reference();
  usual_ = {static_cast<double>(Looks(rows_, *scan_).size()),
            {TailOf(Looks(reference.rows(), model.Scan(reference, JointRows(n),
                                                       VectorXd::Ones(n))))}};
}

OwnPulses PulseSearch::BesideEvents(const std::vector<GapEvent>& events) const {
  std::vector<std::vector<int>> windows;
  for (const GapEvent& event : events) {
    windows.push_back(SamplesOf(rows_, event.contact));
  }
  return PulsesBeside(rows_, *scan_, windows);
}

GapEvent PulseSearch::EventAt(int sample, int joint) const {
  return EventOf(rows_, robot_, *scan_, sample, joint,
                 scan_->widths()(sample, joint));
}

Contact PulseSearch::Fitted(const Contact& found) const {
  constexpr double kTwoMore = 5.99;  // chi squared of two degrees, 95 %
  const auto samples_about = [&](double reach) {
    Contact peak = found;
    peak.window = {found.time - reach, found.time + reach};
    return SamplesOf(rows_, peak);
  };
  const std::vector<int> own = samples_about(1e-9);
  if (own.empty()) return found;
  // What is fitted is this push and no flank of another: near its peak, and
  // better by more than two more parameters are by chance.
  const double longest = (found.window.end - found.window.begin) / 2;
  const Pulse best = scan_->Fitted(
      found.joint, samples_about(longest / Limits().event_reach), longest);
  if (best.chi2 < scan_->At(found.joint, own[0], found.width).chi2 + kTwoMore ||
      !(best.torque * found.torque[found.joint] > 0)) {
    return found;
  }
  Contact fitted =
      EventOf(rows_, robot_, *scan_, best.sample, found.joint, best.width)
          .contact;
  // In white noise a height has 3/2 of the variance where its width is fitted
  // as well.
  fitted.stddev[found.joint] *= std::sqrt(1.5);
  return fitted;
}

// Noise tells it by its own standard deviation or by the log's other peaks; one
// of two tests that are asked is by chance in twice as many logs.
double PulseSearch::Chance(double deviations, double in_log) const {
  return std::max(usual_.Chance(deviations * deviations),
                  2 * std::min(ChanceOfNoise(rows_, deviations), in_log));
}

// The least probable pulse of all joints, where these windows have been found;
// of chance 1 where none is seen. What the reference has by itself is asked
// first: where that is likely enough, the log's own peaks are not.
GapEvent PulseSearch::LeastProbable(
    const std::vector<std::vector<int>>& found) const {
  MatrixXd squares = squares_;
  for (const std::vector<int>& window : found) {
    for (const int k : window) squares.row(k).setZero();
  }
  GapEvent least;
  for (int j = 0; j < rows_.num_joints(); ++j) {
    int sample;
    const double square = squares.col(j).maxCoeff(&sample);
    if (square == 0 || usual_.Chance(square) >=
                           std::min(least.chance, Limits().false_contacts)) {
      continue;
    }
    GapEvent event = EventAt(sample, j);
    std::vector<std::vector<int>> windows = found;
    std::vector<int>& own = windows.emplace_back();
    for (const int k : SamplesOf(rows_, event.contact)) {
      if (squares(k, j) > 0) own.push_back(k);
    }
    const OwnPulses beside = PulsesBeside(rows_, *scan_, windows);
    event.chance =
        Chance(std::sqrt(square), beside.chances(beside.chances.rows() - 1, j));
    if (event.chance < least.chance) least = event;
  }
  return least;
}

// Each of them, from the least probable on, until noise or the reference's own
// pulses give one as large with a probability of false_contacts. The window of
// one that was found is not looked at again: its flanks are no pushes of their
// own.
std::vector<GapEvent> PulseSearch::Find() const {
  std::vector<GapEvent> events;
  std::vector<std::vector<int>> windows;
  while (true) {
    const GapEvent event = LeastProbable(windows);
    if (!(event.chance < Limits().false_contacts)) return events;
    windows.push_back(SamplesOf(rows_, event.contact));
    events.push_back(event);
  }
}

std::vector<GapEvent> PulseSearch::LargestIn(
    const std::vector<GapEvent>& events) const {
  const VectorXd in_log = BesideEvents(events).chances.rowwise().minCoeff();
  const VectorXd all = scan_->Largest();
  std::vector<GapEvent> largest;
  for (size_t i = 0; i < events.size(); ++i) {
    GapEvent& event = largest.emplace_back();
    int sample = -1, joint;
    for (const int k : SamplesOf(rows_, events[i].contact)) {
      if (all[k] > (sample < 0 ? 0 : all[sample])) sample = k;
    }
    if (sample < 0) continue;
    squares_.row(sample).maxCoeff(&joint);
    event = EventAt(sample, joint);
    event.chance = Chance(all[sample], in_log[static_cast<Eigen::Index>(i)]);
  }
  return largest;
}

}  // namespace armcal
