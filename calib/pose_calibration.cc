#include "calib/pose_calibration.h"

#include <ceres/manifold.h>
#include <ceres/normal_prior.h>
#include <ceres/solver.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "calib/pose_start.h"
#include "model/column_basis.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Refine = PoseCalibrationOptions::Refine;

constexpr double kOutlier = 4;      // noise deviations
constexpr double kSamePose = 1e-4;  // rad or m
// Without some to spare the noise would be a guess.
constexpr int kSpareEquations = 10;

bool StartsWith(const std::string& text, const std::string& prefix) {
  return text.compare(0, prefix.size(), prefix) == 0;
}

double Median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::nth_element(values.begin(), values.begin() + values.size() / 2,
                   values.end());
  return values[values.size() / 2];
}

class PoseCalibrator {
 public:
  PoseCalibrator(const Robot& robot, const PoseMeasurements& measured,
                 const PoseCalibrationOptions& options)
      : robot_(robot),
        measured_(measured),
        options_(options),
        geometry_(std::make_shared<ArmGeometry>(robot)),
        names_(geometry_->Names()),
        units_(geometry_->Units()),
        nominal_(geometry_->Values()) {}

  PoseCalibration Run();

 private:
  bool OfInstrument(int k) const { return StartsWith(names_[k], "base."); }
  bool OfTool(int k) const { return StartsWith(names_[k], "tool."); }
  // Coordinates of a position error.
  int Width() const { return measured_.lengths.size() > 0 ? 1 : 3; }
  double PriorOf(int k) const {
    if (OfInstrument(k) || OfTool(k)) return 0;
    return units_[k] == "m" ? options_.prior_length : options_.prior_angle;
  }
  std::vector<bool> Wanted(Refine refine) const;
  std::vector<bool> HoldUnseen(const std::vector<bool>& wanted,
                               const std::vector<int>& rows,
                               const PoseUnknowns& at,
                               std::vector<std::string>* held) const;
  // Of all unknowns, in noise units and without the loss.
  MatrixXd Jacobian(const std::vector<int>& rows, const PoseUnknowns& at,
                    VectorXd* residuals = nullptr) const;
  bool Solve(const std::vector<bool>& free, const std::vector<int>& rows,
             PoseUnknowns* unknowns) const;
  static int NumUnknowns(const std::vector<bool>& free,
                         const PoseUnknowns& at) {
    return static_cast<int>(std::count(free.begin(), free.end(), true) +
                            at.other.size());
  }
  // Distances of every target (or pose, or wire) of `rows`, m.
  std::vector<double> Distances(const std::vector<int>& rows,
                                const PoseUnknowns& at) const;
  void EstimateNoise(const std::vector<bool>& free, const PoseUnknowns& at);
  std::string WhyTooFew(const std::vector<bool>& free,
                        const PoseUnknowns& at) const;
  bool SolveWithNoise(const std::vector<bool>& free,
                      const std::vector<int>& rows, PoseUnknowns* unknowns);
  void CrossValidate(const std::vector<bool>& free, const PoseUnknowns& start,
                     PoseCalibration* result) const;
  void Report(const std::vector<bool>& free, const PoseUnknowns& at,
              PoseCalibration* result) const;

  const Robot& robot_;
  const PoseMeasurements& measured_;
  const PoseCalibrationOptions& options_;
  std::shared_ptr<const ArmGeometry> geometry_;
  std::vector<std::string> names_, units_;
  VectorXd nominal_;
  PoseNoise noise_;
};

std::vector<bool> PoseCalibrator::Wanted(Refine refine) const {
  std::vector<bool> wanted(names_.size(), false);
  const bool wire = measured_.lengths.size() > 0;
  const bool targets = !measured_.targets.empty();
  for (int k = 0; k < geometry_->size(); ++k) {
    const std::string field = names_[k].substr(names_[k].rfind('.'));
    if (OfInstrument(k)) {
      wanted[k] = !wire;  // a wire's anchor stands for it
    } else if (OfTool(k)) {
      wanted[k] =
          wire ? field == ".x" || field == ".y" || field == ".z" : !targets;
    } else {
      wanted[k] = refine == Refine::kAll ||
                  (refine == Refine::kOffsets && field == ".theta");
    }
  }
  return wanted;
}

MatrixXd PoseCalibrator::Jacobian(const std::vector<int>& rows,
                                  const PoseUnknowns& at,
                                  VectorXd* residuals) const {
  PoseUnknowns unknowns = at;
  ceres::Problem problem;
  AddPoseResiduals(geometry_, measured_, rows, noise_, RobustLoss::kSquared,
                   &unknowns, &problem);
  ceres::Problem::EvaluateOptions evaluate;
  evaluate.parameter_blocks.push_back(unknowns.geometry.data());
  const int step = measured_.lengths.size() > 0 ? 4 : 3;
  for (int k = 0; k < unknowns.other.size(); k += step) {
    evaluate.parameter_blocks.push_back(unknowns.other.data() + k);
  }
  ceres::CRSMatrix crs;
  std::vector<double> r;
  problem.Evaluate(evaluate, nullptr, &r, nullptr, &crs);
  if (residuals) *residuals = Eigen::Map<VectorXd>(r.data(), r.size());
  MatrixXd J = MatrixXd::Zero(crs.num_rows, crs.num_cols);
  for (int r = 0; r < crs.num_rows; ++r) {
    for (int k = crs.rows[r]; k < crs.rows[r + 1]; ++k) {
      J(r, crs.cols[k]) = crs.values[k];
    }
  }
  return J;
}

// Of parameters that the poses cannot tell apart the first is kept: the
// instrument's, then joint zeros, then the others in the order of the arm.
std::vector<bool> PoseCalibrator::HoldUnseen(
    const std::vector<bool>& wanted, const std::vector<int>& rows,
    const PoseUnknowns& at, std::vector<std::string>* held) const {
  const MatrixXd J = Jacobian(rows, at);
  const int g = geometry_->size();
  ColumnBasis basis(static_cast<int>(J.rows()));
  const double rows_scale = J.leftCols(6).norm() / std::sqrt(6.0);
  for (Eigen::Index c = g; c < J.cols(); ++c) {
    basis.Add(J.col(c), rows_scale, 1e-7);
  }
  std::vector<int> order(g);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [this](int a, int b) {
    const auto rank = [this](int k) {
      if (OfInstrument(k) || OfTool(k)) return 0;
      return names_[k].rfind(".theta") != std::string::npos ? 1 : 2;
    };
    return rank(a) < rank(b);
  });
  std::vector<bool> free(g, false);
  for (const int k : order) {
    if (!wanted[k]) continue;
    free[k] = basis.Add(J.col(k), rows_scale, 1e-5);
    if (free[k] || held == nullptr) continue;
    held->push_back(names_[k] +
                    (J.col(k).norm() < 1e-5 * rows_scale
                         ? " is not seen by these poses"
                         : " cannot be told from the parameters before it"));
  }
  return free;
}

bool PoseCalibrator::Solve(const std::vector<bool>& free,
                           const std::vector<int>& rows,
                           PoseUnknowns* unknowns) const {
  ceres::Problem problem;
  AddPoseResiduals(geometry_, measured_, rows, noise_, options_.loss, unknowns,
                   &problem);
  MatrixXd weight = MatrixXd::Zero(geometry_->size(), geometry_->size());
  std::vector<int> constant;
  for (int k = 0; k < geometry_->size(); ++k) {
    if (!free[k]) constant.push_back(k);
    if (PriorOf(k) > 0) weight(k, k) = 1 / PriorOf(k);
  }
  problem.AddResidualBlock(new ceres::NormalPrior(weight, nominal_), nullptr,
                           unknowns->geometry.data());
  if (!constant.empty()) {
    problem.SetManifold(unknowns->geometry.data(),
                        new ceres::SubsetManifold(geometry_->size(), constant));
  }
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.max_num_iterations = 200;
  solver.function_tolerance = 1e-12;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  return summary.IsSolutionUsable() && unknowns->geometry.allFinite() &&
         unknowns->other.allFinite();
}

std::vector<double> PoseCalibrator::Distances(const std::vector<int>& rows,
                                              const PoseUnknowns& at) const {
  const MatrixXd errors = PositionErrors(*geometry_, measured_, at);
  std::vector<double> distances;
  for (const int k : rows) {
    for (Eigen::Index c = 0; c < errors.cols(); c += Width()) {
      distances.push_back(errors.row(k).segment(c, Width()).norm());
    }
  }
  return distances;
}

// Robust: 1.4826 times the median of absolute coordinates, corrected for what
// the unknowns have taken out of them.
void PoseCalibrator::EstimateNoise(const std::vector<bool>& free,
                                   const PoseUnknowns& at) {
  const MatrixXd position = PositionErrors(*geometry_, measured_, at);
  const MatrixXd rotation = RotationErrors(*geometry_, measured_, at);
  const double N = static_cast<double>(position.size() + rotation.size());
  const double left = std::max(1.0, N - NumUnknowns(free, at));
  const auto spread = [&](const MatrixXd& errors) {
    std::vector<double> sizes;
    for (const double e : errors.reshaped()) sizes.push_back(std::abs(e));
    return std::max(1e-7, 1.4826 * Median(sizes) * std::sqrt(N / left));
  };
  noise_.position = spread(position);
  if (rotation.size() > 0) noise_.rotation = spread(rotation);
}

// Poses that repeat an arm position add nothing to the geometry.
std::string PoseCalibrator::WhyTooFew(const std::vector<bool>& free,
                                      const PoseUnknowns& at) const {
  std::vector<int> different;
  for (int k = 0; k < measured_.size(); ++k) {
    const bool seen =
        std::any_of(different.begin(), different.end(), [&](int j) {
          return (measured_.q.row(j) - measured_.q.row(k))
                     .cwiseAbs()
                     .maxCoeff() < kSamePose;
        });
    if (!seen) different.push_back(k);
  }
  const int per_pose = measured_.lengths.size() > 0 ? 1
                       : measured_.poses.size() > 0
                           ? 6
                           : 3 * static_cast<int>(measured_.targets.size());
  const int poses = static_cast<int>(different.size());
  const int equations = per_pose * poses;
  const int unknowns = NumUnknowns(free, at);
  if (equations >= unknowns + kSpareEquations) return "";
  return std::to_string(poses) +
         (poses == 1 ? " arm position gives "
                     : " different arm positions give ") +
         std::to_string(equations) + " equations for " +
         std::to_string(unknowns) + " unknowns, at least " +
         std::to_string(unknowns + kSpareEquations) +
         " are needed; measure more positions";
}

bool PoseCalibrator::SolveWithNoise(const std::vector<bool>& free,
                                    const std::vector<int>& rows,
                                    PoseUnknowns* unknowns) {
  for (int round = 0; round < 4; ++round) {
    if (!Solve(free, rows, unknowns)) return false;
    EstimateNoise(free, *unknowns);
  }
  return Solve(free, rows, unknowns);
}

void PoseCalibrator::CrossValidate(const std::vector<bool>& free,
                                   const PoseUnknowns& start,
                                   PoseCalibration* result) const {
  if (options_.folds < 2) return;
  std::vector<double> all;
  for (int fold = 0; fold < options_.folds; ++fold) {
    std::vector<int> kept, left_out;
    for (int k = 0; k < measured_.size(); ++k) {
      (k % options_.folds == fold ? left_out : kept).push_back(k);
    }
    PoseUnknowns unknowns = start;
    if (!Solve(free, kept, &unknowns)) continue;
    for (const double d : Distances(left_out, unknowns)) all.push_back(d);
  }
  double sum = 0;
  for (const double d : all) sum += d * d;
  if (all.empty()) return;
  result->held_out_rms = std::sqrt(sum / static_cast<double>(all.size()));
  result->held_out_median = Median(all);
}

void PoseCalibrator::Report(const std::vector<bool>& free,
                            const PoseUnknowns& at,
                            PoseCalibration* result) const {
  std::vector<int> rows(measured_.size());
  std::iota(rows.begin(), rows.end(), 0);
  VectorXd residuals;
  const MatrixXd J = Jacobian(rows, at, &residuals);
  std::vector<int> columns;
  for (int k = 0; k < geometry_->size(); ++k) {
    if (free[k]) columns.push_back(k);
  }
  const int num_free = static_cast<int>(columns.size());
  for (Eigen::Index c = geometry_->size(); c < J.cols(); ++c) {
    columns.push_back(static_cast<int>(c));
  }
  MatrixXd A(J.rows(), columns.size());
  for (size_t k = 0; k < columns.size(); ++k) A.col(k) = J.col(columns[k]);
  const VectorXd scale = A.colwise().norm().cwiseMax(1e-300);
  const Eigen::JacobiSVD<MatrixXd> svd(A * scale.cwiseInverse().asDiagonal(),
                                       Eigen::ComputeThinV);
  const VectorXd s = svd.singularValues();
  const double factor =
      VarianceFactor(residuals, measured_.poses.size() > 0 ? 6 : Width(),
                     options_.loss, static_cast<int>(columns.size()));
  for (int k = 0; k < num_free; ++k) {
    double variance = 0, unseen = 0;
    for (Eigen::Index d = 0; d < s.size(); ++d) {
      const double v = svd.matrixV()(k, d);
      if (s[d] > 1e-9 * s[0]) {
        variance += v * v / (s[d] * s[d]);
      } else {
        unseen += v * v;
      }
    }
    const int p = columns[k];
    const bool seen = unseen < 1e-6;
    result->parameters.push_back(
        {names_[p], units_[p], nominal_[p], at.geometry[p],
         seen ? std::sqrt(factor * variance) / scale[k]
              : std::numeric_limits<double>::infinity(),
         PriorOf(p), seen});
  }
}

PoseCalibration PoseCalibrator::Run() {
  PoseCalibration result;
  result.robot = robot_;
  std::vector<int> rows(measured_.size());
  std::iota(rows.begin(), rows.end(), 0);
  PoseUnknowns unknowns = StartPoses(*geometry_, measured_);
  EstimateNoise(std::vector<bool>(names_.size(), false), unknowns);
  const std::vector<bool> frame =
      HoldUnseen(Wanted(Refine::kNothing), rows, unknowns, nullptr);
  result.reason = WhyTooFew(frame, unknowns);
  if (!result.reason.empty()) return result;
  if (!SolveWithNoise(frame, rows, &unknowns)) {
    result.reason = "the instrument's frame cannot be found";
    return result;
  }
  const auto rms = [](const std::vector<double>& d) {
    double sum = 0;
    for (const double x : d) sum += x * x;
    return std::sqrt(sum / static_cast<double>(d.size()));
  };
  result.before_rms = rms(Distances(rows, unknowns));
  const std::vector<bool> free =
      HoldUnseen(Wanted(options_.refine), rows, unknowns, &result.held);
  result.reason = WhyTooFew(free, unknowns);
  if (!result.reason.empty()) return result;
  if (!SolveWithNoise(free, rows, &unknowns)) {
    result.reason = "the geometry cannot be solved for";
    return result;
  }
  result.solved = true;
  result.reason = "solved";
  result.noise = noise_;
  const std::vector<double> distances = Distances(rows, unknowns);
  result.rms = rms(distances);
  result.median = Median(distances);
  result.max = *std::max_element(distances.begin(), distances.end());
  const MatrixXd errors = PositionErrors(*geometry_, measured_, unknowns);
  std::vector<int> inliers;
  for (const int k : rows) {
    const bool out =
        errors.row(k).cwiseAbs().maxCoeff() > kOutlier * noise_.position;
    (out ? result.outliers : inliers).push_back(k);
  }
  if (!inliers.empty()) result.inlier_rms = rms(Distances(inliers, unknowns));
  CrossValidate(free, unknowns, &result);
  Report(free, unknowns, &result);
  ArmGeometry refined = *geometry_;
  refined.SetValues(unknowns.geometry);
  result.robot = refined.ApplyTo(robot_);
  return result;
}

}  // namespace

PoseCalibration CalibratePoses(const Robot& robot,
                               const PoseMeasurements& measured,
                               const PoseCalibrationOptions& options) {
  return PoseCalibrator(robot, measured, options).Run();
}

}  // namespace armcal
