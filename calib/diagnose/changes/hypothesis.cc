#include "calib/diagnose/changes/hypothesis.h"

namespace armcal {

const char* ChangeFormName(ChangeForm form) {
  switch (form) {
    case ChangeForm::kStep:
      return "step";
    case ChangeForm::kDrift:
      return "drift";
    case ChangeForm::kOnce:
      return "once";
  }
  return "";
}

Eigen::VectorXd CourseOf(ChangeForm form, int log,
                         const Eigen::VectorXd& times) {
  Eigen::VectorXd course = Eigen::VectorXd::Zero(times.size());
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
