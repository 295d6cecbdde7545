#include "model/dynamics/joint_warmth.h"

#include <glog/logging.h>

#include <cmath>

namespace armcal {

Eigen::MatrixXd JointWarmth(const FrictionPower& power, double dt,
                            const std::vector<JointThermal>& thermal) {
  const int n = static_cast<int>(power.viscous.cols());
  const Eigen::Index size = power.viscous.rows();
  CHECK_EQ(thermal.size(), static_cast<size_t>(n));
  Eigen::MatrixXd warmth = Eigen::MatrixXd::Zero(n, size);
  for (int j = 0; j < n; ++j) {
    const double R = thermal[j].resistance;
    const double x = dt / (R * thermal[j].capacity);
    const double decay = std::exp(-x);
    // Of a power that rises from 0 to 1 W within dt, after dt, K/W.
    const double rising = R * (1 - (1 - decay) / x);
    const double falling = R * (1 - decay) - rising;
    for (Eigen::Index k = 1; k < size; ++k) {
      const double T = warmth(j, k - 1);
      const double viscous = std::exp(-thermal[j].viscous_fall * T);
      const double coulomb = std::exp(-thermal[j].coulomb_fall * T);
      const auto heat = [&](Eigen::Index at) {
        return viscous * power.viscous(at, j) + coulomb * power.coulomb(at, j);
      };
      warmth(j, k) = decay * T + falling * heat(k - 1) + rising * heat(k);
    }
  }
  return warmth;
}

// Least squares of warmth = resistance (power through a first-order lag) +
// constant. For a given time constant it is one ratio, so that only the
// constant is searched, over 40 of them.
JointThermal FitThermal(const Eigen::VectorXd& power,
                        const Eigen::VectorXd& warmth, double dt) {
  constexpr int kTried = 40;
  const double duration = dt * static_cast<double>(power.size());
  const auto centred = [](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return x.array() - x.mean();
  };
  const Eigen::VectorXd recorded = centred(warmth);
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(power.size());
  JointThermal fitted;
  double least = recorded.squaredNorm();
  for (int k = 0; k < kTried; ++k) {
    // From a hundredth of the record's length to ten times it.
    const double constant =
        .01 * duration * std::pow(1000, k / (kTried - 1.));  // s
    const Eigen::VectorXd unit =
        centred(JointWarmth({power, nothing}, dt, {{constant, 1}}).row(0));
    const double resistance = unit.dot(recorded) / unit.squaredNorm();
    if (!(resistance > 0)) continue;
    const double left = (recorded - resistance * unit).squaredNorm();
    if (left >= least) continue;
    least = left;
    fitted = {constant / resistance, resistance};
  }
  return fitted;
}

}  // namespace armcal
