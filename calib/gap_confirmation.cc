#include "calib/gap_confirmation.h"

#include <algorithm>
#include <cmath>

namespace armcal {

using Eigen::VectorXd;

double Confirmation::Share() const {
  constexpr double kTooSmall = 20;  // chi^2
  return std::clamp(explained / (expected + kTooSmall), -1., 1.);
}

Confirmation Confirm(const JointRows& without, const JointRows& with) {
  Confirmation confirmation;
  for (size_t j = 0; j < with.size(); ++j) {
    if (with[j].size() == 0) continue;
    confirmation.expected += (without[j] - with[j]).squaredNorm();
    confirmation.explained += without[j].squaredNorm() - with[j].squaredNorm();
  }
  return confirmation;
}

double Unsteadiness(const JointRows& without, const JointRows& with) {
  constexpr int kParts = 4;
  double weight[kParts] = {}, product[kParts] = {};
  for (size_t j = 0; j < with.size(); ++j) {
    const Eigen::Index size = with[j].size();
    for (int part = 0; part < kParts; ++part) {
      const Eigen::Index begin = size * part / kParts;
      const Eigen::Index count = size * (part + 1) / kParts - begin;
      const VectorXd effect =
          without[j].segment(begin, count) - with[j].segment(begin, count);
      weight[part] += effect.squaredNorm();
      product[part] += effect.dot(without[j].segment(begin, count));
    }
  }
  double all = 0, sum = 0;
  for (int part = 0; part < kParts; ++part) {
    all += weight[part];
    sum += product[part];
  }
  if (!(all > 0) || !(sum > 0)) return 0;
  const double mean = sum / all;
  double chi_squared = 0;
  for (int part = 0; part < kParts; ++part) {
    if (!(weight[part] > 0)) continue;
    const double off = product[part] / weight[part] - mean;
    chi_squared += off * off * weight[part];
  }
  return std::sqrt(std::max(0., chi_squared - (kParts - 1)) / all) / mean;
}

}  // namespace armcal
