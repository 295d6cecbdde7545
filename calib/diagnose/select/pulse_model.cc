#include "calib/diagnose/select/pulse_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/diagnose/contacts/excess.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The noise that a pulse is held against: an autoregression fitted to what
// the model leaves of the reference, which nothing touched, in all
// uninterrupted stretches that count, joints at rest included. Samples whose
// variance is more than twice the noise's are masked or next to a reversal of
// friction, and end a stretch.
Autoregression NoiseOfPulses(const GapRows& rows, int joint,
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

}  // namespace

// The model's values x given the effects, and their covariance C: what the
// fit knows of its own columns, and the prior of the discrepancy's, which was
// not fitted here. PulseScan adds X C X' to the variance of every pulse, so
// that what the model may have wrong is no push.
PulseModel::PulseModel(const GapRegression& regression, const JointRows& torque)
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
    noise_.push_back(NoiseOfPulses(reference.rows(), j, left.col(j)));
  }
}

PulseScan PulseModel::Scan(const GapData& data, const JointRows& torque,
                           const VectorXd& growth) const {
  PulseScan::Model model{data.columns(), covariance_, noise_};
  for (int j = 0; j < growth.size(); ++j) {
    model.noise[j].sigma *= std::sqrt(growth[j]);
  }
  return PulseScan(data.rows(), model, data.ResidualWith(x_, torque),
                   ExtraStddev(data.rows(), model.noise));
}

// As a Coulomb friction of its own or by a law that the robot is known to
// have.
bool PulseModel::HasDryFriction(int joint) const {
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
MatrixXd PulseModel::ExtraStddev(
    const GapRows& rows, const std::vector<Autoregression>& noise) const {
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

}  // namespace armcal
