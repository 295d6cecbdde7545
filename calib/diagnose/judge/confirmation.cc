#include "calib/diagnose/judge/confirmation.h"

#include <algorithm>

#include "calib/diagnose/data/thresholds.h"

namespace armcal {

double Confirmation::Share() const {
  return std::clamp(explained / (expected + Limits().confirmation), -1., 1.);
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

}  // namespace armcal
