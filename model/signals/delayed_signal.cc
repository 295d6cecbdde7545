#include "model/signals/delayed_signal.h"

#include <algorithm>

namespace armcal {

Eigen::MatrixXd Delayed(const Eigen::MatrixXd& signal, double delay) {
  Eigen::MatrixXd delayed(signal.rows(), signal.cols());
  const Eigen::Index last = signal.rows() - 1;
  for (Eigen::Index k = 0; k <= last; ++k) {
    const double at = std::clamp<double>(k - delay, 0, last);
    const auto before = static_cast<Eigen::Index>(at);
    const Eigen::Index after = std::min(before + 1, last);
    const double share = at - before;
    delayed.row(k) =
        (1 - share) * signal.row(before) + share * signal.row(after);
  }
  return delayed;
}

}  // namespace armcal
