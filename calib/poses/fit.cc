#include "calib/poses/fit.h"

#include <ceres/manifold.h>
#include <ceres/normal_prior.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "calib/numerics/median.h"
#include "calib/poses/repeated_poses.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"
#include "model/text/option_name.h"
#include "problems/dense_solver.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Without some to spare the noise would be a guess.
constexpr int kSpareEquations = 10;

// Errors of these poses, one below the other, in units of the noise.
VectorXd InNoise(const PoseMeasurements& measured, const PoseNoise& noise,
                 const std::vector<int>& rows, const MatrixXd& position,
                 const MatrixXd& rotation) {
  const Eigen::Index width = position.cols() + rotation.cols();
  VectorXd r(static_cast<Eigen::Index>(rows.size()) * width);
  for (size_t k = 0; k < rows.size(); ++k) {
    auto own = r.segment(static_cast<Eigen::Index>(k) * width, width);
    if (rotation.size() == 0) {
      own = position.row(rows[k]).transpose() / noise.position;
      continue;
    }
    own << position.row(rows[k]).transpose(), rotation.row(rows[k]).transpose();
    own = PoseWhitening(measured, noise, rows[k]) * own;
  }
  return r;
}

// Of the instrument alone, the poses' median; 0 where that is not known.
PoseNoise InstrumentNoise(const PoseMeasurements& measured) {
  if (measured.covariance.empty()) return {0, 0};
  std::vector<double> position, rotation;
  for (const Matrix6d& C : measured.covariance) {
    position.push_back(std::sqrt(C.topLeftCorner<3, 3>().trace() / 3));
    rotation.push_back(std::sqrt(C.bottomRightCorner<3, 3>().trace() / 3));
  }
  return {Median(position), Median(rotation)};
}

// Of unknowns that are one parameter block.
void AddOtherPrior(const VectorXd& stddev, PoseUnknowns* unknowns,
                   ceres::Problem* problem) {
  if (!(stddev.array() > 0).any()) return;
  const VectorXd weight =
      (stddev.array() > 0)
          .select(stddev.cwiseInverse(), VectorXd::Zero(stddev.size()));
  problem->AddResidualBlock(
      new ceres::NormalPrior(weight.asDiagonal(),
                             VectorXd::Zero(stddev.size())),
      nullptr, unknowns->other.data());
}

// The share of `all` with which, beside the instrument's own errors, `spread`
// of whitened residuals is 1; not less than a thousandth.
PoseNoise BesideInstrument(
    const PoseNoise& all,
    const std::function<double(const PoseNoise& noise)>& spread) {
  constexpr double kLeast = 1e-3;
  constexpr int kHalvings = 20;
  const auto part = [&all](double logarithm) {
    const double share = std::exp(logarithm);
    return PoseNoise{share * all.position, share * all.rotation};
  };
  double low = std::log(kLeast), high = 0;
  if (spread(part(low)) <= 1) return part(low);
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = (low + high) / 2;
    (spread(part(middle)) > 1 ? low : high) = middle;
  }
  return part(high);
}

}  // namespace

void RequireOneTool(const Robot& robot) {
  if (!robot.branches()) return;
  const auto tips = TipsOf(robot.parents, robot.num_joints());
  std::vector<std::string> names;
  for (const int tip : tips) names.push_back(robot.links[tip].name);
  throw InputError(robot.name, OptionName("tip"), JoinNames(names),
                   "expected one tip: poses are of one tool");
}

PoseFit::PoseFit(const Robot& robot, const PoseMeasurements& measured,
                 const PoseCalibrationOptions& options)
    : measured_(measured),
      options_(options),
      geometry_(std::make_shared<ArmGeometry>(robot)),
      nominal_(geometry_->Values()) {
  RequireOneTool(robot);
}

PoseNoise PoseFit::TypicalNoise() const {
  const PoseNoise own = InstrumentNoise(measured_);
  return {std::hypot(noise_.position, own.position),
          std::hypot(noise_.rotation, own.rotation)};
}

std::vector<int> PoseFit::AllRows() const {
  std::vector<int> rows(measured_.size());
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

double GeometryPrior(const ArmGeometry& geometry, int k, double length,
                     double angle) {
  if (ArmGeometry::IsBase(k) || geometry.IsTool(k)) return 0;
  return geometry.Units()[k] == "m" ? length : angle;
}

double PoseFit::PriorOf(int k) const {
  return GeometryPrior(*geometry_, k, options_.prior_length,
                       options_.prior_angle);
}

// The derivatives by all unknowns, free or not, from Ceres' sparse rows: its
// blocks of other unknowns come in the order of their numbers.
MatrixXd PoseFit::Jacobian(const std::vector<int>& rows, const PoseUnknowns& at,
                           VectorXd* residuals) const {
  PoseUnknowns unknowns = at;
  ceres::Problem problem;
  AddPoseResiduals(geometry_, measured_, rows, noise_, RobustLoss::kSquared,
                   &unknowns, &problem);
  ceres::Problem::EvaluateOptions evaluate;
  evaluate.parameter_blocks.push_back(unknowns.geometry.data());
  const bool is_one =
      measured_.lengths.size() > 0 || measured_.poses.size() > 0;
  const int step = is_one ? static_cast<int>(unknowns.other.size()) : 3;
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

MatrixXd PoseFit::WithOtherPriors(const MatrixXd& jacobian) const {
  const VectorXd priors = PoseUnknowns::OtherPriors(measured_);
  MatrixXd J = MatrixXd::Zero(jacobian.rows() + priors.size(), jacobian.cols());
  J.topRows(jacobian.rows()) = jacobian;
  const Eigen::Index first = jacobian.cols() - priors.size();
  for (Eigen::Index k = 0; k < priors.size(); ++k) {
    if (priors[k] > 0) J(jacobian.rows() + k, first + k) = 1 / priors[k];
  }
  return J;
}

VectorXd PoseFit::Residuals(const std::vector<int>& rows,
                            const PoseUnknowns& at) const {
  return InNoise(measured_, noise_, rows,
                 PositionErrors(*geometry_, measured_, at),
                 RotationErrors(*geometry_, measured_, at));
}

// Minimises the residuals' loss and the priors of geometry and instrument over
// what is free.
bool PoseFit::Solve(const std::vector<bool>& free, const std::vector<int>& rows,
                    RobustLoss loss, PoseUnknowns* unknowns,
                    double tolerance) const {
  ceres::Problem problem;
  AddPoseResiduals(geometry_, measured_, rows, noise_, loss, unknowns,
                   &problem);
  MatrixXd weight = MatrixXd::Zero(geometry_->size(), geometry_->size());
  std::vector<int> constant;
  for (int k = 0; k < geometry_->size(); ++k) {
    if (!free[k]) constant.push_back(k);
    if (PriorOf(k) > 0) weight(k, k) = 1 / PriorOf(k);
  }
  problem.AddResidualBlock(new ceres::NormalPrior(weight, nominal_), nullptr,
                           unknowns->geometry.data());
  AddOtherPrior(PoseUnknowns::OtherPriors(measured_), unknowns, &problem);
  if (!constant.empty()) {
    problem.SetManifold(unknowns->geometry.data(),
                        new ceres::SubsetManifold(geometry_->size(), constant));
  }
  const ceres::Solver::Summary summary = SolveDense(tolerance, &problem);
  return summary.IsSolutionUsable() && unknowns->geometry.allFinite() &&
         unknowns->other.allFinite();
}

std::vector<double> PoseFit::Distances(const std::vector<int>& rows,
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
void PoseFit::EstimateNoise(const std::vector<bool>& free,
                            const PoseUnknowns& at) {
  const MatrixXd position = PositionErrors(*geometry_, measured_, at);
  const MatrixXd rotation = RotationErrors(*geometry_, measured_, at);
  const double N = static_cast<double>(position.size() + rotation.size());
  const double left = std::max(1.0, N - NumUnknowns(free));
  const auto spread = [&](const MatrixXd& errors) {
    std::vector<double> sizes;
    for (const double e : errors.reshaped()) sizes.push_back(std::abs(e));
    return std::max(1e-7, 1.4826 * Median(sizes) * std::sqrt(N / left));
  };
  noise_.position = spread(position);
  if (rotation.size() > 0) noise_.rotation = spread(rotation);
  if (!measured_.covariance.empty()) {
    noise_ = BesideInstrument(noise_, [&](const PoseNoise& noise) {
      return spread(InNoise(measured_, noise, AllRows(), position, rotation));
    });
  }
}

int PoseFit::EquationsPerPose() const {
  if (measured_.poses.size() > 0) return 6;
  return Width() * std::max(1, static_cast<int>(measured_.targets.size()));
}

// Poses that repeat an arm position add nothing to the geometry.
std::string PoseFit::WhyTooFew(const std::vector<bool>& free) const {
  const int poses = CountPoses(RepeatedPoses(measured_.q));
  const int equations = EquationsPerPose() * poses;
  const int unknowns = NumUnknowns(free);
  if (equations >= unknowns + kSpareEquations) return "";
  return std::to_string(poses) +
         (poses == 1 ? " arm position gives "
                     : " different arm positions give ") +
         std::to_string(equations) + " equations for " +
         std::to_string(unknowns) + " unknowns, at least " +
         std::to_string(unknowns + kSpareEquations) +
         " are needed; measure more positions";
}

bool PoseFit::SolveWithNoise(const std::vector<bool>& free,
                             const std::vector<int>& rows,
                             PoseUnknowns* unknowns) {
  std::vector<RobustLoss> losses = {options_.loss};
  if (options_.loss != RobustLoss::kSquared) {
    losses.insert(losses.begin(), RobustLoss::kHuber);
  }
  for (const RobustLoss loss : losses) {
    for (int round = 0; round < 4; ++round) {
      if (!Solve(free, rows, loss, unknowns)) return false;
      EstimateNoise(free, *unknowns);
    }
  }
  return Solve(free, rows, options_.loss, unknowns);
}

}  // namespace armcal
