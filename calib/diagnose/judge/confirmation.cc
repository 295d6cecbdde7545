#include "calib/diagnose/judge/confirmation.h"

#include <algorithm>

#include "calib/diagnose/data/thresholds.h"

namespace armcal {

// Where the share s of what is predicted is there, `explained` is N((2 s - 1)
// E, 4 E) with E = expected: chi squared falls by s^2 E - (1 - s)^2 E, and the
// noise along the effect has the variance 4 E. Of u = 2 s - 1, with N(0, 1)
// before, the posterior mean is explained / (E + 4).
double Confirmation::Share() const {
  return std::clamp(explained / (expected + Limits().confirmation), -1., 1.);
}

Confirmation SumOf(const std::vector<Confirmation>& parts) {
  Confirmation sum;
  for (const Confirmation& part : parts) {
    sum.expected += part.expected;
    sum.explained += part.explained;
  }
  return sum;
}

double LeastShare(const std::vector<Confirmation>& parts) {
  if (parts.empty()) return 0;
  return std::min_element(parts.begin(), parts.end(),
                          [](const Confirmation& a, const Confirmation& b) {
                            return a.Share() < b.Share();
                          })
      ->Share();
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
