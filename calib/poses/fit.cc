#include "calib/poses/fit.h"

#include <ceres/manifold.h>
#include <ceres/normal_prior.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "calib/numerics/median.h"
#include "model/signals/column_basis.h"
#include "problems/dense_solver.h"
#include "problems/plane_residual.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSamePose = 1e-4;  // rad or m
// Without some to spare the noise would be a guess.
constexpr int kSpareEquations = 10;
constexpr double kLeastColumn = 1e-5;  // of a column that would count

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

// Columns of a Jacobian by the `geometry` first ones that are free, beside all
// others.
class SeenColumns {
 public:
  SeenColumns(MatrixXd J, int geometry)
      : J_(std::move(J)), basis_(static_cast<int>(J_.rows())) {
    scale_ = J_.leftCols(6).norm() / std::sqrt(6.0);
    for (Eigen::Index c = geometry; c < J_.cols(); ++c) {
      basis_.Add(J_.col(c), scale_, 1e-7);
    }
  }
  bool Add(int k) { return basis_.Add(J_.col(k), scale_, kLeastColumn); }
  bool IsNone(int k) const { return J_.col(k).norm() < kLeastColumn * scale_; }

 private:
  MatrixXd J_;
  ColumnBasis basis_;
  double scale_;
};

}  // namespace

PoseFit::PoseFit(const Robot& robot, const PoseMeasurements& measured,
                 const PoseCalibrationOptions& options)
    : measured_(measured),
      options_(options),
      geometry_(std::make_shared<ArmGeometry>(robot)),
      names_(geometry_->Names()),
      nominal_(geometry_->Values()) {}

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

// As if the tip were where the point is, or on the plane. Then what no touch
// can tell, a turn of the whole arm or other lengths of all of it, is the same
// as other points to the last digit; beside the errors of a start it only is
// about that.
MatrixXd PoseFit::TouchingJacobian(const std::vector<int>& rows,
                                   const PoseUnknowns& at) const {
  const int g = geometry_->size();
  MatrixXd J = MatrixXd::Zero(static_cast<Eigen::Index>(Width() * rows.size()),
                              g + at.other.size());
  std::vector<ParameterTwist> twists;
  const std::vector<TouchedPlane> planes =
      measured_.planes ? TouchedPlanes(*geometry_, measured_, nullptr)
                       : std::vector<TouchedPlane>{};
  for (size_t k = 0; k < rows.size(); ++k) {
    auto own = J.middleRows(static_cast<Eigen::Index>(Width() * k), Width());
    const int point = 3 * measured_.touched[rows[k]];
    const Eigen::Vector3d tip =
        geometry_
            ->ToolPose(measured_.q.row(rows[k]), at.geometry.data(), &twists)
            .translation();
    if (measured_.planes) {
      const TouchedPlane& plane = planes[point / 3];
      const double* const abc = at.other.data() + point;
      const Eigen::Vector3d n = plane.Normal(abc);
      const Eigen::Vector3d on = tip - plane.Distance(abc, tip) * n;
      for (int c = 0; c < g; ++c) own(0, c) = n.dot(twists[c].At(on));
      own.middleCols<3>(g + point) = plane.Derivative(abc, on);
      continue;
    }
    for (int c = 0; c < g; ++c) {
      own.col(c) = twists[c].At(at.other.segment<3>(point));
    }
    own.middleCols<3>(g + point) = -Eigen::Matrix3d::Identity();
  }
  return J / noise_.position;
}

// With a tenth of all lengths a tip would touch as well: the longest of the
// arm's that are wanted says how long a metre is. -1: something else does.
int PoseFit::ScaleLength(const std::vector<bool>& wanted) const {
  if (measured_.touched.empty()) return -1;
  const std::vector<std::string> units = geometry_->Units();
  int longest = -1;
  for (int k = 0; k < geometry_->size(); ++k) {
    if (!wanted[k] || PriorOf(k) == 0 || units[k] != "m") continue;
    if (longest < 0 || std::abs(nominal_[k]) > std::abs(nominal_[longest])) {
      longest = k;
    }
  }
  return longest;
}

// Of parameters that the poses cannot tell apart the first is kept: the
// instrument's, then joint zeros, then the others in the order of the arm.
std::vector<bool> PoseFit::HoldUnseen(const std::vector<bool>& wanted,
                                      const std::vector<int>& rows,
                                      const PoseUnknowns& at,
                                      std::vector<std::string>* held) const {
  const int g = geometry_->size();
  const int scale = ScaleLength(wanted);
  std::vector<SeenColumns> seen = {{WithOtherPriors(Jacobian(rows, at)), g}};
  if (!measured_.touched.empty()) {
    seen.emplace_back(TouchingJacobian(rows, at), g);
  }
  std::vector<int> order(g);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [this](int a, int b) {
    const auto rank = [this](int k) {
      if (ArmGeometry::IsBase(k) || geometry_->IsTool(k)) return 0;
      return names_[k].rfind(".theta") != std::string::npos ? 1 : 2;
    };
    return rank(a) < rank(b);
  });
  std::vector<bool> free(g, false);
  for (const int k : order) {
    if (!wanted[k]) continue;
    if (k == scale) {
      if (held == nullptr) continue;
      held->push_back(
          names_[k] +
          " only with the file's other lengths: touches tell no scale");
      continue;
    }
    // All of them, also where another has not taken it.
    int tells = 0;
    for (SeenColumns& columns : seen) tells += columns.Add(k);
    free[k] = tells == static_cast<int>(seen.size());
    if (free[k] || held == nullptr) continue;
    held->push_back(names_[k] +
                    (seen[0].IsNone(k)
                         ? " is not seen by these poses"
                         : " cannot be told from the parameters before it"));
  }
  return free;
}

bool PoseFit::Solve(const std::vector<bool>& free, const std::vector<int>& rows,
                    RobustLoss loss, PoseUnknowns* unknowns) const {
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
  const ceres::Solver::Summary summary = SolveDense(1e-12, &problem);
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
  if (measured_.lengths.size() > 0) return 1;
  if (measured_.poses.size() > 0) return 6;
  if (!measured_.touched.empty()) return Width();
  return 3 * static_cast<int>(measured_.targets.size());
}

// Poses that repeat an arm position add nothing to the geometry.
std::string PoseFit::WhyTooFew(const std::vector<bool>& free) const {
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
  const int poses = static_cast<int>(different.size());
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
