#include "calib/diagnose/select/pulse_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/select/pulse_model.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Of motion that no fit has seen (ReferenceNoise).
VectorXd GrowthOf(const GapNoise& noise, int n) {
  VectorXd growth = VectorXd::Ones(n);
  for (size_t j = 0; j < noise.extra_variance.size(); ++j)
    growth[j] += noise.extra_variance[j];
  return growth;
}

// How probable it is that noise alone gets as far at any time, on any joint,
// for any of these widths. What a Gaussian pulse of this width makes
// of white noise has the autocorrelation exp(-(dt / width)^2 / 2), and
// upcrosses d at the rate exp(-d^2 / 2) / (2 pi width) (Rice 1945); of both
// signs twice that. For large d the expected number of crossings is the
// probability of one, which is a bound in any case (Boole).
double ChanceOfNoise(const GapRows& rows, const std::vector<double>& widths,
                     double square) {
  double crossings = 0;
  for (const double width : widths) {
    crossings += rows.num_joints() * rows.time() / (M_PI * width);
  }
  return crossings * std::exp(-square / 2);
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

}  // namespace

PulseSearch::PulseSearch(const GapRegression& regression,
                         const std::vector<GapCandidate>& effects,
                         const GapData& data)
    : rows_(data.rows()) {
  const int n = rows_.num_joints();
  const JointRows torque = regression.TorqueOf(effects);
  const PulseModel model(regression, torque);
  robot_ = model.robot();
  scan_.emplace(model.Scan(data, torque, GrowthOf(regression.noise(), n)));
  const GapData& reference = *regression.reference();
  const PulseScan before =
      model.Scan(reference, JointRows(n), VectorXd::Ones(n));
  for (const std::vector<double>& widths : PulseScan::Banks()) {
    Bank& bank = banks_.emplace_back();
    bank.widths = widths;
    bank.responses = scan_->Responses(widths);
    bank.squares = bank.responses.deviations.cwiseAbs2();
    bank.usual = UsualPeaks(rows_, bank.responses, reference.rows(),
                            before.Responses(widths));
  }
}

// Each as the pulses of its own bank have it.
OwnPulses PulseSearch::BesideEvents(const std::vector<GapEvent>& events) const {
  Windows windows;
  for (const GapEvent& event : events) {
    windows.push_back(SamplesOf(rows_, event.contact));
  }
  OwnPulses own = PulsesBeside(rows_, banks_.front().responses, windows);
  for (size_t b = 1; b < banks_.size(); ++b) {
    const OwnPulses longer = PulsesBeside(rows_, banks_[b].responses, windows);
    for (size_t k = 0; k < events.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      if (events[k].bank == static_cast<int>(b)) {
        own.chances.row(row) = longer.chances.row(row);
      }
    }
  }
  return own;
}

GapEvent PulseSearch::EventAt(const Bank& bank, int sample, int joint) const {
  GapEvent event = EventOf(rows_, robot_, *scan_, sample, joint,
                           bank.responses.widths(sample, joint));
  event.bank = static_cast<int>(&bank - banks_.data());
  return event;
}

// What is fitted is this push and no flank of another: near its peak, of its
// sign, and better by more than two more parameters are by chance.
std::optional<GapEvent> PulseSearch::BetterFit(const Contact& found,
                                               double reach,
                                               double longest) const {
  constexpr double kTwoMore = 5.99;  // chi squared of two degrees, 95 %
  const auto samples_about = [&](double distance) {
    Contact peak = found;
    peak.window = {found.time - distance, found.time + distance};
    return SamplesOf(rows_, peak);
  };
  const std::vector<int> own = samples_about(1e-9);
  if (own.empty()) return {};
  const Pulse best = scan_->Fitted(found.joint, samples_about(reach), longest);
  const Pulse before = scan_->At(found.joint, own[0], found.width);
  if (best.chi2 < before.chi2 + kTwoMore) return {};
  if (!(best.torque * found.torque[found.joint] > 0)) return {};
  return EventOf(rows_, robot_, *scan_, best.sample, found.joint, best.width);
}

// A long pulse is looked for at one width only, and hides what is in its
// window: that of the width that fits it, if it is shorter.
GapEvent PulseSearch::AsLongAsItIs(const GapEvent& event) const {
  const double width = event.contact.width;
  if (event.bank == 0) return event;
  std::optional<GapEvent> fitted = BetterFit(event.contact, width, width);
  if (!fitted) return event;
  fitted->chance = event.chance;
  fitted->bank = event.bank;
  return *fitted;
}

Contact PulseSearch::Fitted(const Contact& found) const {
  const double longest = (found.window.end - found.window.begin) / 2;
  const std::optional<GapEvent> fitted =
      BetterFit(found, longest / Limits().event_reach, longest);
  if (!fitted) return found;
  // In white noise a height has 3/2 of the variance where its width is fitted
  // as well.
  Contact contact = fitted->contact;
  contact.stddev[found.joint] *= std::sqrt(1.5);
  return contact;
}

// Noise tells it by its own standard deviation or by the log's other peaks; one
// of two tests that are asked is by chance in twice as many logs. Any of the
// banks could have shown it (Bonferroni).
double PulseSearch::Chance(const Bank& bank, int joint, double square,
                           double in_log) const {
  const double banks = static_cast<double>(banks_.size());
  return banks *
         std::max(
             bank.usual[joint].Chance(square),
             2 * std::min(ChanceOfNoise(rows_, bank.widths, square), in_log));
}

// The least probable pulse of all joints, where these windows have been found;
// of chance 1 where none is seen. What the reference has by itself is asked
// first: where that is likely enough, the log's own peaks are not.
GapEvent PulseSearch::LeastProbable(const Bank& bank,
                                    const Windows& found) const {
  MatrixXd squares = bank.squares;
  for (const std::vector<int>& window : found) {
    for (const int k : window) squares.row(k).setZero();
  }
  GapEvent least;
  for (int j = 0; j < rows_.num_joints(); ++j) {
    int sample;
    const double square = squares.col(j).maxCoeff(&sample);
    if (square == 0 || Chance(bank, j, square, 0) >=
                           std::min(least.chance, Limits().false_contacts)) {
      continue;
    }
    GapEvent event = EventAt(bank, sample, j);
    Windows windows = found;
    std::vector<int>& own = windows.emplace_back();
    for (const int k : SamplesOf(rows_, event.contact)) {
      if (squares(k, j) > 0) own.push_back(k);
    }
    const OwnPulses beside = PulsesBeside(rows_, bank.responses, windows);
    event.chance =
        Chance(bank, j, square, beside.chances(beside.chances.rows() - 1, j));
    if (event.chance < least.chance) least = event;
  }
  return least;
}

// Each of them, until noise or the reference's own pulses give one as large
// with a probability of false_contacts. Of the banks that tell one, that whose
// course fits better is taken first, which stands out by more deviations
// (orthogonal matching pursuit). The window of one that was found is not looked
// at again: its flanks are no pushes of their own.
std::vector<GapEvent> PulseSearch::Find() const {
  std::vector<GapEvent> events;
  Windows windows;
  while (true) {
    GapEvent event;
    for (const Bank& bank : banks_) {
      const GapEvent of_bank = LeastProbable(bank, windows);
      if (of_bank.chance < Limits().false_contacts &&
          of_bank.contact.deviations > event.contact.deviations) {
        event = of_bank;
      }
    }
    if (!(event.chance < Limits().false_contacts)) return events;
    windows.push_back(SamplesOf(rows_, event.contact));
    events.push_back(AsLongAsItIs(event));
    windows.push_back(SamplesOf(rows_, events.back().contact));
  }
}

GapEvent PulseSearch::LargestOf(const Bank& bank,
                                const std::vector<int>& window,
                                double in_log) const {
  GapEvent largest;
  double square = 0;
  int sample = -1, joint = 0;
  for (const int k : window) {
    for (int j = 0; j < rows_.num_joints(); ++j) {
      if (bank.squares(k, j) <= square) continue;
      square = bank.squares(k, j);
      sample = k;
      joint = j;
    }
  }
  if (sample < 0) return largest;
  largest = EventAt(bank, sample, joint);
  largest.chance = Chance(bank, joint, square, in_log);
  return largest;
}

std::vector<GapEvent> PulseSearch::LargestIn(
    const std::vector<GapEvent>& events) const {
  Windows windows;
  for (const GapEvent& event : events) {
    windows.push_back(SamplesOf(rows_, event.contact));
  }
  std::vector<GapEvent> largest(events.size());
  for (const Bank& bank : banks_) {
    const VectorXd in_log = PulsesBeside(rows_, bank.responses, windows)
                                .chances.rowwise()
                                .minCoeff();
    for (size_t i = 0; i < events.size(); ++i) {
      const GapEvent of_bank =
          LargestOf(bank, windows[i], in_log[static_cast<Eigen::Index>(i)]);
      if (of_bank.chance < largest[i].chance) largest[i] = of_bank;
    }
  }
  return largest;
}

}  // namespace armcal
