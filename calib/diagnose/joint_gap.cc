#include "calib/diagnose/joint_gap.h"

#include <algorithm>

#include "calib/diagnose/judge/evidence.h"

namespace armcal {

Unexplained SumUnexplained(const GapFit& fit,
                           const std::vector<JointGap>& joints) {
  Unexplained all;
  double left = 0, most = 0, refit = 0;
  for (size_t j = 0; j < joints.size(); ++j) {
    const double here = joints[j].unexplained;
    left += here;
    refit += Excess(fit, static_cast<int>(j), false);
    if (here <= most) continue;
    most = here;
    all.joint = joints[j].name;
    all.organised_by = joints[j].organised.by;
  }
  all.share = left / std::max(1., std::max(left, refit));
  return all;
}

}  // namespace armcal
