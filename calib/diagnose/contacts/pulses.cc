#include "calib/diagnose/contacts/pulses.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "calib/diagnose/data/thresholds.h"
#include "calib/numerics/posterior.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMemory = Autoregression::kOrder;
constexpr double kLeastSeen = .5;  // of a pulse's g'g
// Of the noise in a sample's variance: one of a hundred times its standard
// deviation is not seen. Of a pulse that is masked but for its tails these
// would else be all that is fitted, ever again.
constexpr double kLeastOfNoise = 1e-4;

// X C^(1/2) for the columns that act on one joint, so that X C X' is its
// product with its transpose: the covariance of what the model's uncertain
// values make of the torque, thinned samples x columns, never formed.
MatrixXd TimesHalf(const BaselineColumns& columns, const MatrixXd& covariance) {
  return columns.values *
         SquareRoot(covariance(columns.which, columns.which)).transpose();
}

// Samples of a series that are larger than those next to them, where none of
// the three is in a window.
std::vector<double> PeaksBeside(const GapRows& rows,
                                const std::vector<bool>& in_window,
                                const VectorXd& series) {
  std::vector<double> peaks;
  for (size_t i = 0; i < rows.segments().size(); ++i) {
    const int s = static_cast<int>(i);
    for (int k = rows.thin_begin(s) + 1; k + 1 < rows.thin_begin(s + 1); ++k) {
      if (in_window[k - 1] || in_window[k] || in_window[k + 1]) continue;
      if (series[k] > series[k - 1] && series[k] >= series[k + 1]) {
        peaks.push_back(series[k]);
      }
    }
  }
  return peaks;
}

// The chances of the largest of a series in each window, by the peaks beside
// all of them; 1 where it is not seen there.
std::vector<double> ChancesIn(const GapRows& rows, const VectorXd& series,
                              const std::vector<bool>& in_window,
                              const std::vector<std::vector<int>>& windows) {
  std::vector<double> sizes = PeaksBeside(rows, in_window, series);
  std::vector<size_t> places;  // of each window among the sizes
  for (const std::vector<int>& window : windows) {
    double largest = 0;
    for (const int k : window) largest = std::max(largest, series[k]);
    places.push_back(sizes.size());
    if (largest > 0) sizes.push_back(largest);
  }
  const std::vector<double> peaks = ChancesAmongPeaks(sizes);
  std::vector<double> chances(windows.size(), 1);
  for (size_t i = 0; i < windows.size(); ++i) {
    const size_t next = i + 1 < windows.size() ? places[i + 1] : sizes.size();
    if (next > places[i]) chances[i] = peaks[places[i]];
  }
  return chances;
}

}  // namespace

// A matched filter is hardly worse for a pulse that is up to 1.4 times wider or
// narrower: its response falls by the factor sqrt(2 r / (1 + r^2)) for widths
// that differ by r, .97. The longer ones, of pushes of one to two seconds, are
// a bank of their own. What is wider than these is a hold, which a model's own
// slow errors look like.
std::vector<std::vector<double>> PulseScan::Banks() {
  const double shortest = Limits().shortest_push;
  return {{shortest, 2 * shortest}, {4 * shortest}};
}

PulseScan::PulseScan(const GapRows& rows, const Model& model,
                     const MatrixXd& residual, const MatrixXd& extra_stddev)
    : rows_(rows), joints_(rows.num_joints()) {
  for (int j = 0; j < rows.num_joints(); ++j) {
    Joint& joint = joints_[j];
    const MatrixXd half =
        rows.WithoutDrift(j, TimesHalf(model.columns[j], model.covariance));
    joint.noise = model.noise[j];
    joint.residual = joint.weight = VectorXd::Zero(rows.num_thin());
    joint.half = MatrixXd::Zero(rows.num_thin(), half.cols());
    for (size_t i = 0; i < rows.segments().size(); ++i) {
      Whiten(static_cast<int>(i), residual.col(j), half, extra_stddev.col(j),
             &joint);
    }
  }
}

PulseResponses PulseScan::Responses(const std::vector<double>& widths) const {
  PulseResponses responses;
  responses.widths = responses.torques = responses.deviations =
      MatrixXd::Zero(rows_.num_thin(), rows_.num_joints());
  for (int j = 0; j < rows_.num_joints(); ++j) {
    for (const double width : widths) Scan(j, width, &responses);
  }
  return responses;
}

// Residual and X C^(1/2) of one segment, filtered by the noise's autoregression
// so that its samples are independent, times weights sqrt(v / (v + extra^2))
// for what else may be wrong with a sample. The weight of an infinite extra
// deviation is 0. A sample is seen once as many before it as the autoregression
// remembers have been: its filtered value would else hold samples that do not
// count.
void PulseScan::Whiten(int segment, const VectorXd& residual,
                       const MatrixXd& half, const VectorXd& extra_stddev,
                       Joint* joint) const {
  const int begin = rows_.thin_begin(segment) + kMemory;
  const int end = rows_.thin_begin(segment + 1);
  if (end <= begin) return;
  const double variance = std::pow(joint->noise.stddev(), 2);
  int seen = 0;  // uninterrupted
  for (int k = begin - kMemory; k < end; ++k) {
    seen = rows_.IsInPart(segment, k) ? seen + 1 : 0;
    const double share =
        variance / (variance + extra_stddev[k] * extra_stddev[k]);
    if (seen > kMemory && share > kLeastOfNoise) {
      joint->weight[k] = std::sqrt(share);
    }
  }
  const auto with_past = [begin, end](const MatrixXd& all) {
    return all.middleRows(begin - kMemory, end - begin + kMemory);
  };
  const auto weight = joint->weight.segment(begin, end - begin).asDiagonal();
  joint->residual.segment(begin, end - begin) =
      weight * joint->noise.Whiten(with_past(residual));
  joint->half.middleRows(begin, end - begin) =
      weight * joint->noise.Whiten(with_past(half));
}

void PulseScan::Scan(int joint, double width, PulseResponses* responses) const {
  for (size_t i = 0; i < rows_.segments().size(); ++i) {
    const int s = static_cast<int>(i);
    const Course course = CourseOf(joint, rows_.step(s), width);
    for (int k = rows_.thin_begin(s); k < rows_.thin_begin(s + 1); ++k) {
      const Pulse pulse = Fit(joint, s, k, course);
      double& largest = responses->deviations(k, joint);
      if (std::abs(pulse.deviations) <= std::abs(largest)) continue;
      largest = pulse.deviations;
      responses->torques(k, joint) = pulse.torque;
      responses->widths(k, joint) = width;
    }
  }
}

// The pulse exp(-(t / width)^2), event_reach widths to both sides, and what
// whitening makes of it: the filter needs kMemory samples before, and leaves a
// tail as long after. It is the same at every sample, so that it is computed
// once per joint and width.
PulseScan::Course PulseScan::CourseOf(int joint, double step,
                                      double width) const {
  Course course;
  course.reach =
      static_cast<int>(std::ceil(Limits().event_reach * width / step));
  // What whitening needs of the time before, and leaves of the time after.
  VectorXd pulse = VectorXd::Zero(2 * course.reach + 1 + 2 * kMemory);
  for (int k = -course.reach; k <= course.reach; ++k) {
    pulse[kMemory + course.reach + k] =
        std::exp(-std::pow(k * step / width, 2));
  }
  course.white = joints_[joint].noise.Whiten(pulse);
  return course;
}

// The matched filter (Kay 1998, 4.3) of one pulse, by generalised least
// squares. With g the whitened course and r the whitened residual, recorded
// less model, the torque that acts against the drives is
//   f = -g' r / g' g,  var f = (1 + |(X C^(1/2))' g|^2 / g' g) / g' g,
// the first term that of the noise and the second that of the model's uncertain
// values along g. A pulse of which less than kLeastSeen of g' g is seen has no
// deviation: from its tails alone any height could be told.
Pulse PulseScan::Fit(int joint, int segment, int sample,
                     const Course& course) const {
  const Joint& own = joints_[joint];
  const int first = sample - course.reach;
  const int begin = std::max(rows_.thin_begin(segment), first);
  const int end = std::min(rows_.thin_begin(segment + 1),
                           first + static_cast<int>(course.white.size()));
  const auto white = course.white.segment(begin - first, end - begin);
  const auto weight = own.weight.segment(begin, end - begin);
  const VectorXd g = white.cwiseProduct(weight);
  const double squared = g.squaredNorm();
  const double seen = (weight.array() > 0).select(white, 0).squaredNorm();
  Pulse pulse;
  pulse.sample = sample;
  pulse.stddev = std::numeric_limits<double>::infinity();
  if (seen < kLeastSeen * course.white.squaredNorm()) return pulse;
  const double errors =
      (own.half.middleRows(begin, end - begin).transpose() * g).squaredNorm();
  pulse.torque = -g.dot(own.residual.segment(begin, end - begin)) / squared;
  pulse.stddev = std::sqrt((1 + errors / squared) / squared);
  pulse.deviations = pulse.torque / pulse.stddev;
  pulse.chi2 = pulse.torque * pulse.torque * squared;
  return pulse;
}

Pulse PulseScan::At(int joint, int sample, double width) const {
  const int segment = rows_.SegmentOf(sample);
  Pulse pulse =
      Fit(joint, segment, sample, CourseOf(joint, rows_.step(segment), width));
  pulse.width = width;
  return pulse;
}

// By what it explains of chi squared. Scan's widths tell that there is one; its
// height at a wrong width is wrong.
Pulse PulseScan::Fitted(int joint, const std::vector<int>& samples,
                        double longest) const {
  constexpr double kStep = 1.19;  // a fourth root of 2: .4 % of a height
  Pulse best;
  for (const int k : samples) {
    for (double width = Limits().shortest_push; width <= longest;
         width *= kStep) {
      const Pulse pulse = At(joint, k, width);
      if (pulse.chi2 > best.chi2) best = pulse;
    }
  }
  return best;
}

// Each peak of the reference is a maximum of a process of a narrow band: chi^2
// of one degree, whose tail is nearly exponential as TailOf has it (peaks over
// a threshold, their median, which more of them tell than maxima of blocks do).
// A joint may have larger ones than others, and a joint that shows few in the
// reference is no quieter than all are. Any of the joints' peaks in the log
// could be the largest.
std::vector<UsualMaximum> UsualPeaks(const GapRows& rows,
                                     const PulseResponses& responses,
                                     const GapRows& reference,
                                     const PulseResponses& before) {
  const auto peaks = [](const GapRows& of, const PulseResponses& in, int j) {
    return PeaksBeside(of, std::vector<bool>(of.num_thin(), false),
                       in.deviations.col(j).cwiseAbs2());
  };
  std::vector<double> all;
  std::vector<UsualMaximum> usual(rows.num_joints());
  double further = 0;
  for (int j = 0; j < rows.num_joints(); ++j) {
    const std::vector<double> own = peaks(reference, before, j);
    usual[j].tails.push_back(TailOf(own));
    all.insert(all.end(), own.begin(), own.end());
    further += static_cast<double>(peaks(rows, responses, j).size());
  }
  const MaximaTail of_all = TailOf(all);
  for (UsualMaximum& of_joint : usual) {
    of_joint.tails.push_back(of_all);
    of_joint.further = further;
  }
  return usual;
}

// A pulse is asked against the peaks of the same matched filter on the same
// joint where there is none. Heights of the peaks of a Gaussian process of one
// narrow band have Rayleigh's law (Rice 1945), so that their squares are
// exponential with a mean of twice the variance, whatever that is. It has to
// stand out by its torque and by what that is worth in standard deviations:
// what a model has wrong may be as large everywhere or as its own errors are.
// Where it knows these worse than it says, the peaks of the latter say so; its
// word counts as one peak more. Any of the n joints could have shown the pulse
// (Bonferroni).
OwnPulses PulsesBeside(const GapRows& rows, const PulseResponses& responses,
                       const std::vector<std::vector<int>>& windows) {
  const int n = rows.num_joints();
  std::vector<bool> in_window(rows.num_thin(), false);
  for (const std::vector<int>& window : windows) {
    for (const int k : window) in_window[k] = true;
  }
  OwnPulses own{MatrixXd::Ones(static_cast<Eigen::Index>(windows.size()), n),
                VectorXd(n)};
  for (int j = 0; j < n; ++j) {
    const VectorXd worth = responses.deviations.col(j).cwiseAbs2();
    const std::vector<double> peaks = PeaksBeside(rows, in_window, worth);
    const double sum = std::accumulate(peaks.begin(), peaks.end(), 2.);
    own.scale[j] = std::max(
        1., std::sqrt(sum / (2. * static_cast<double>(peaks.size() + 1))));
    const std::vector<double> by_worth =
        ChancesIn(rows, worth, in_window, windows);
    const std::vector<double> by_torque = ChancesIn(
        rows, responses.torques.col(j).cwiseAbs2(), in_window, windows);
    for (size_t i = 0; i < windows.size(); ++i) {
      own.chances(static_cast<Eigen::Index>(i), j) =
          std::min(1., n * std::max(by_worth[i], by_torque[i]));
    }
  }
  return own;
}

}  // namespace armcal
