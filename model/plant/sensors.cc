#include "model/plant/sensors.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "model/plant/random_stream.h"

namespace armcal {

namespace {

constexpr int kLongestGap = 5;

// That a gap begins at a sample, for a share of lost samples: with gaps of g
// samples in the mean, g p of 1 - p + g p are lost.
double GapProbability(double share) {
  constexpr double kMeanGap = (1 + kLongestGap) / 2.;
  return share / (kMeanGap - (kMeanGap - 1) * share);
}

Eigen::VectorXd OrZero(const Eigen::VectorXd& values, int n) {
  if (values.size() == 0) return Eigen::VectorXd::Zero(n);
  CHECK_EQ(values.size(), n);
  return values;
}

Eigen::VectorXd Normals(int n, std::mt19937_64* random) {
  std::normal_distribution<double> normal;
  Eigen::VectorXd values(n);
  for (int j = 0; j < n; ++j) values[j] = normal(*random);
  return values;
}

}  // namespace

Encoders::Encoders(const SensorOptions& options, int num_joints)
    : resolution_(OrZero(options.encoder_resolution, num_joints)),
      noise_(OrZero(options.encoder_noise, num_joints)),
      random_(
          RandomStream(options.seed, options.run, RandomPurpose::kEncoder)) {}

Eigen::VectorXd Encoders::Measure(const Eigen::VectorXd& position) {
  const int n = static_cast<int>(noise_.size());
  Eigen::VectorXd measured =
      position + noise_.cwiseProduct(Normals(n, &random_));
  for (int j = 0; j < n; ++j) {
    if (resolution_[j] == 0) continue;
    // + 0: logs have no minus zero.
    measured[j] =
        std::round(measured[j] / resolution_[j]) * resolution_[j] + 0.0;
  }
  return measured;
}

TorqueNoise::TorqueNoise(const SensorOptions& options, int num_joints)
    : white_(OrZero(options.torque_noise, num_joints)),
      coloured_(OrZero(options.coloured_noise, num_joints)),
      correlation_(options.noise_correlation),
      random_(RandomStream(options.seed, options.run, RandomPurpose::kTorque)),
      random_coloured_(
          RandomStream(options.seed, options.run, RandomPurpose::kColoured)) {
  state_ = coloured_.cwiseProduct(Normals(num_joints, &random_coloured_));
}

Eigen::VectorXd TorqueNoise::Next(double dt) {
  const int n = static_cast<int>(white_.size());
  const double decay = std::exp(-dt / correlation_);
  state_ = decay * state_ +
           std::sqrt(1 - decay * decay) *
               coloured_.cwiseProduct(Normals(n, &random_coloured_));
  return state_ + white_.cwiseProduct(Normals(n, &random_));
}

SamplingClock::SamplingClock(const SensorOptions& options, int periods,
                             double control_rate)
    : periods_(periods),
      jitter_periods_(options.jitter * control_rate),
      lost_share_(options.lost_share),
      random_(RandomStream(options.seed, options.run, RandomPurpose::kJitter)),
      random_loss_(
          RandomStream(options.seed, options.run, RandomPurpose::kLoss)) {
  Schedule();
}

void SamplingClock::Schedule() {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0, 1);
  const long last = next_tick_;
  do {
    ++sample_;
    if (lost_ > 0) {
      --lost_;
    } else if (uniform(random_loss_) < GapProbability(lost_share_)) {
      lost_ = static_cast<int>(uniform(random_loss_) * kLongestGap);
    } else {
      break;
    }
  } while (true);
  const double late =
      jitter_periods_ == 0 ? 0 : std::round(jitter_periods_ * normal(random_));
  next_tick_ = std::max(last + (sample_ > 0 ? 1 : 0),
                        sample_ * periods_ + static_cast<long>(late));
}

bool SamplingClock::Samples(long tick) {
  if (tick != next_tick_) return false;
  Schedule();
  return true;
}

}  // namespace armcal
