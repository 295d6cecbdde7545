#include "model/log_files/motion_frequency.h"

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

constexpr double kLeastStep = .02;      // s
constexpr double kStill = 1e-6;         // rad^2 or m^2, of a variance: 1 mrad
constexpr size_t kMostExcursions = 64;  // of a joint, the fastest
// Times the step past an excursion that the steps to it and from it are, and
// times the rms velocity without all of them: a sine's greatest velocity is 1.4
// times its rms, that of a sum of sines 3 to 4 times.
constexpr double kFartherThanPast = 5;
constexpr double kFasterThanRms = 8;

}  // namespace

void MotionFrequency::Add(double t, const Eigen::MatrixXd& positions, int row) {
  if (count_ > 0 && t - last_t_ < kLeastStep) return;
  const Eigen::RowVectorXd q = positions.row(row);
  if (count_ == 0) {
    first_ = last_ = q;
    sum_ = square_ = rate_ = Eigen::ArrayXd::Zero(q.size());
    excursions_.resize(q.size());
  } else {
    rate_ += (q - last_).transpose().array().square() / (t - last_t_);
    time_ += t - last_t_;
    if (count_ > 1) FindExcursions(q, t);
    step_ = t - last_t_;
  }
  const Eigen::ArrayXd x = (q - first_).transpose().array();
  sum_ += x;
  square_ += x.square();
  ++count_;
  before_ = last_;
  last_ = q;
  last_t_ = t;
}

// Three rows are known: before_, last_ and q, of time t.
void MotionFrequency::FindExcursions(const Eigen::RowVectorXd& q, double t) {
  const double step = t - last_t_;
  for (Eigen::Index j = 0; j < q.size(); ++j) {
    const double to = last_[j] - before_[j], from = q[j] - last_[j];
    std::vector<Excursion>& all = excursions_[j];
    const double past = std::abs(to + from);
    const double x = last_[j] - first_[j];
    if (std::min(std::abs(to), std::abs(from)) > kFartherThanPast * past) {
      all.push_back({std::min(std::abs(to) / step_, std::abs(from) / step),
                     to * to / step_ + from * from / step, x, x * x});
    } else if (count_ == 2 &&
               std::abs(to) > kFartherThanPast * std::abs(from)) {
      all.push_back({std::abs(to) / step_, to * to / step_, 0, 0});
    }
    if (all.size() <= kMostExcursions) continue;
    all.erase(std::min_element(all.begin(), all.end(),
                               [](const Excursion& a, const Excursion& b) {
                                 return a.speed < b.speed;
                               }));
  }
}

double MotionFrequency::Hz() const {
  double frequency = 0;
  for (int j = 0; j < sum_.size() && time_ > 0; ++j) {
    double rate_without = rate_[j];
    for (const Excursion& e : excursions_[j]) rate_without -= e.rate;
    const double usual = std::sqrt(std::max(0., rate_without) / time_);
    double rate = rate_[j], sum = sum_[j], square = square_[j];
    auto count = static_cast<double>(count_);
    for (const Excursion& e : excursions_[j]) {
      if (!(e.speed > kFasterThanRms * usual)) continue;
      rate -= e.rate;
      sum -= e.x;
      square -= e.square;
      --count;
    }
    const double mean = sum / count;
    const double variance = square / count - mean * mean;
    if (variance < kStill) continue;
    frequency = std::max(
        frequency, std::sqrt(rate / time_ / variance) / (2 * 3.14159265358979));
  }
  return frequency;
}

}  // namespace armcal
