#include "calib/poses/diagnosis/remainder.h"

#include <algorithm>
#include <cmath>

#include "calib/poses/misfit.h"
#include "calib/poses/repeated_poses.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Of a pose, beside 1 of one that fits well.
constexpr double kGivenUp = .1;

// Squares of coordinates in the instrument's standard deviations.
void SetInstrument(const PoseStudy& study, const PoseModel& model,
                   PoseMisfit* misfit) {
  const MatrixXd& u95 = study.measured.u95;
  if (u95.size() == 0) return;
  const int width = study.equations.width();
  const int point = study.measured.lengths.size() > 0 ? 1 : 3;
  const int coordinates = study.measured.poses.size() > 0 ? 3 : width;
  InstrumentErrors errors;
  for (int k = 0; k < study.equations.poses(); ++k) {
    for (int c = 0; c < coordinates; ++c) {
      errors.Add(model.estimate.linear.r[k * width + c],
                 u95(k, std::min<Eigen::Index>(c / point, u95.cols() - 1)));
    }
  }
  errors.Tell(
      (model.estimate.parameters + model.terms.size()) * coordinates / width,
      misfit);
}

void SetOrder(const PoseStudy& study, const PoseModel& model,
              PoseMisfit* misfit) {
  const MatrixXd r =
      WeightedRows(model.estimate, model.estimate.linear.r)
          .reshaped(study.equations.width(), study.equations.poses());
  if (r.squaredNorm() == 0) return;
  const MatrixXd by_pose = MeansByPose(r, RepeatedPoses(study.measured.q));
  misfit->order_correlation = OrderCorrelation(by_pose);
  misfit->order_stddev = 1 / std::sqrt(static_cast<double>(by_pose.cols() - 1));
}

bool IsMoreThanNoise(const PoseMisfit& misfit) {
  return misfit.instrument_ratio > kMostOfInstrument || IsAlikeInOrder(misfit);
}

}  // namespace

const char* PoseVerdictName(PoseVerdict verdict) {
  switch (verdict) {
    case PoseVerdict::kNoiseFloor:
      return "noise_floor";
    case PoseVerdict::kExplained:
      return "explained";
    case PoseVerdict::kPartlyExplained:
      return "partly_explained";
    case PoseVerdict::kUnknown:
      return "unknown";
    case PoseVerdict::kNotTestable:
      break;
  }
  return "not_testable";
}

void JudgeRemainder(const PoseStudy& study, PoseDiagnosis* diagnosis) {
  const PoseModel& model = diagnosis->model;
  SetInstrument(study, model, &diagnosis->misfit);
  SetOrder(study, model, &diagnosis->misfit);
  const VectorXd& r = model.estimate.linear.r;
  const int width = study.equations.width();
  const int point = study.measured.lengths.size() > 0 ? 1 : 3;
  const int coordinates = study.measured.poses.size() > 0 ? 3 : width;
  double squares = 0;
  for (int k = 0; k < study.equations.poses(); ++k) {
    squares += r.segment(k * width, coordinates).squaredNorm();
    for (int c = 0; c < coordinates; c += point) {
      diagnosis->distances.push_back(r.segment(k * width + c, point).norm());
    }
    if (model.estimate.errors.weights[k] < kGivenUp) {
      diagnosis->outliers.push_back(k);
    }
  }
  diagnosis->coordinate_rms =
      std::sqrt(squares / (study.equations.poses() * coordinates));
  diagnosis->unknowns =
      study.equations.num_free() + static_cast<int>(model.terms.size());
  const bool found = !diagnosis->findings.empty();
  const bool left = IsMoreThanNoise(diagnosis->misfit);
  diagnosis->verdict = found && left ? PoseVerdict::kPartlyExplained
                       : found       ? PoseVerdict::kExplained
                       : left        ? PoseVerdict::kUnknown
                                     : PoseVerdict::kNoiseFloor;
}

}  // namespace armcal
