#include "calib/diagnose/joint_gap.h"

#include <algorithm>
#include <cmath>

#include "calib/diagnose/data/motion_range.h"
#include "calib/diagnose/judge/evidence.h"
#include "calib/diagnose/judge/verdict.h"

namespace armcal {

JointGap JointGapOf(const Robot& robot, const GapFit& fit,
                    const GapFigures& torque, int j) {
  const Joint& joint = robot.links[j].joint;
  JointGap gap;
  gap.name = joint.name;
  gap.unit = EffortUnit(joint.type);
  gap.floor_rms = fit.noise().joints[j].stddev();
  gap.torque_rms = fit.scale().torque[j];
  gap.organised = OrganisedBy(JointCourseOf(fit, j));
  const double after = torque.joints.rows() > j ? torque.joints(j, 2) : NAN;
  gap.unexplained =
      UnexplainedOf({Excess(fit, j, true), fit.rows().num_rows(j),
                     fit.noise().source, !gap.organised.by.empty(), after});
  return gap;
}

void SetBeyondReference(const GapFit& fit, std::vector<JointGap>* joints) {
  const GapData* reference = fit.regression().reference();
  if (!reference || fit.noise().source == NoiseFloor::kPositions) return;
  const Eigen::ArrayXXd growth =
      MotionRange(reference->rows()).OwnGrowth(fit.rows());
  for (size_t j = 0; j < joints->size(); ++j) {
    const auto column = static_cast<int>(j);
    double squares = 0;
    const std::vector<int> samples = fit.rows().SampleOfRow(column);
    for (const int k : samples) squares += std::pow(growth(k, column), 2);
    if (samples.empty()) continue;
    (*joints)[j].beyond_reference =
        std::sqrt(squares / static_cast<double>(samples.size()));
  }
}

void SetRms(const Eigen::MatrixXd& rms, std::vector<JointGap>* joints) {
  for (size_t j = 0; j < joints->size(); ++j) {
    const auto row = rms.row(static_cast<Eigen::Index>(j));
    JointGap& gap = (*joints)[j];
    gap.nominal_rms = row[0];
    gap.refit_rms = row[1];
    gap.after_rms = row[2];
    if (std::isnan(row[3])) continue;
    gap.floor_rms = row[3];
    gap.torque_rms = row[4];
  }
}

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
