#include "calib/diagnose/judge/confirmation.h"

#include <algorithm>

#include "calib/diagnose/data/thresholds.h"

namespace armcal {

double Confirmation::Share() const {
  return std::clamp(explained / (expected + Limits().confirmation), -1., 1.);
}

Confirmation Confirm(const PredictedChi2& chi2, const JointRows& without,
                     const JointRows& with) {
  JointRows change;
  for (size_t j = 0; j < with.size(); ++j) {
    change.push_back(without[j] - with[j]);
  }
  return {chi2.Of(change), chi2.Of(without) - chi2.Of(with)};
}

}  // namespace armcal
