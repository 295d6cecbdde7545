#include "calib/diagnose/changes/hypothesis.h"

#include <array>

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Of each joint beside its mean over the logs, mean of the joints that move.
VectorXd MeanLogarithm(const MatrixXd& sizes) {
  constexpr double kLeast = 1e-3;  // of the joint's most
  VectorXd sum = VectorXd::Zero(sizes.rows());
  int moving = 0;
  for (const auto joint : sizes.colwise()) {
    const double most = joint.maxCoeff();
    if (!(most > 0)) continue;
    const VectorXd log = joint.array().max(kLeast * most).log();
    sum.array() += log.array() - log.mean();
    ++moving;
  }
  return moving > 0 ? VectorXd(sum / moving) : sum;
}

}  // namespace

const char* ChangeFormName(ChangeForm form) {
  switch (form) {
    case ChangeForm::kStep:
      return "step";
    case ChangeForm::kDrift:
      return "drift";
    case ChangeForm::kOnce:
      return "once";
    case ChangeForm::kMotion:
      return "motion";
  }
  return "";
}

const char* MotionMeasureName(int measure) {
  constexpr std::array<const char*, kMotionMeasures> kNames = {
      "speed", "travel", "acceleration"};
  return kNames[measure];
}

MatrixXd MotionMeasures(const MatrixXd& speed, const MatrixXd& travel) {
  MatrixXd measures(speed.rows(), kMotionMeasures);
  measures.col(0) = MeanLogarithm(speed);
  measures.col(1) = MeanLogarithm(travel);
  measures.col(2) = 2 * measures.col(0) - measures.col(1);
  return measures;
}

VectorXd ChangeHypothesis::Course(ChangeForm form, int log,
                                  const VectorXd& times) const {
  return form == ChangeForm::kMotion ? VectorXd(motion.col(log))
                                     : CourseOf(form, log, times);
}

VectorXd CourseOf(ChangeForm form, int log, const VectorXd& times) {
  VectorXd course = VectorXd::Zero(times.size());
  const Eigen::Index last = times.size() - 1;
  for (Eigen::Index l = log; l <= last; ++l) {
    course[l] = form == ChangeForm::kDrift
                    ? (times[l] - times[log]) / (times[last] - times[log])
                : form == ChangeForm::kStep || l == log ? 1
                                                        : 0;
  }
  return course;
}

}  // namespace armcal
