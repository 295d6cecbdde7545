#include "calib/poses/shared_errors.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "calib/poses/repeated_poses.h"
#include "calib/poses/variance_components.h"

namespace armcal {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Triplets = std::vector<Eigen::Triplet<double>>;

// Per turn, of what a joint errs by: higher ones change between poses, and are
// theirs.
constexpr int kJointHarmonics = 2;

// A target's, a pose's or a wire's coordinates among the residuals.
struct PoseReading {
  Eigen::Index first;  // of them
  int pose;
  Vector3d lever;  // from the middle of the pose's targets, instrument's frame
};

std::vector<PoseReading> ReadingsOf(const PoseFit& fit,
                                    const std::vector<int>& rows) {
  const PoseMeasurements& measured = fit.measured();
  const std::vector<int> poses = RepeatedPoses(measured.q(rows, Eigen::all));
  const size_t targets = std::max<size_t>(1, measured.targets.size());
  std::vector<PoseReading> readings;
  for (size_t k = 0; k < rows.size(); ++k) {
    Vector3d middle = Vector3d::Zero();
    for (const MatrixXd& target : measured.targets) {
      middle += target.row(rows[k]).transpose() / static_cast<double>(targets);
    }
    for (size_t t = 0; t < targets; ++t) {
      Vector3d lever = Vector3d::Zero();
      if (targets > 1) {
        lever = measured.targets[t].row(rows[k]).transpose() - middle;
      }
      const auto first = static_cast<Eigen::Index>(readings.size());
      readings.push_back({first * fit.Coordinates(), poses[k], lever});
    }
  }
  return readings;
}

bool AnyPoseIsReadTwice(const std::vector<PoseReading>& readings) {
  return CountPoses([&] {
           std::vector<int> poses;
           for (const PoseReading& reading : readings) {
             poses.push_back(reading.pose);
           }
           return poses;
         }()) < static_cast<int>(readings.size());
}

Matrix3d Cross(const Vector3d& v) {
  Matrix3d cross;
  cross << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return cross;
}

// Errors of each coordinate by itself.
Triplets Own(Eigen::Index residuals) {
  Triplets own;
  for (int row = 0; row < residuals; ++row) own.emplace_back(row, row, 1);
  return own;
}

// Those of a pose, by which all its readings are displaced alike and, of
// several targets, turned.
void AddPoseErrors(const std::vector<PoseReading>& readings, int width,
                   const MatrixXd& Q, std::vector<VarianceComponent>* all) {
  Triplets moved, turned;
  int poses = 0;
  for (const PoseReading& reading : readings) {
    poses = std::max(poses, reading.pose + 1);
    const Matrix3d lever = -Cross(reading.lever);
    for (int c = 0; c < width; ++c) {
      const auto row = static_cast<int>(reading.first) + c;
      moved.emplace_back(row, width * reading.pose + c, 1);
      for (int a = 0; a < 3 && reading.lever.norm() > 0; ++a) {
        turned.emplace_back(row, 3 * reading.pose + a, lever(c, a));
      }
    }
  }
  all->emplace_back(moved, width * poses, Q);
  if (!turned.empty()) all->emplace_back(turned, 3 * poses, Q);
}

// Those of joints that turn, by which neighbouring poses are displaced alike:
// each stands where it says plus a_1 cos q + a_2 sin q + a_3 cos 2q + a_4 sin
// 2q, as eccentric wheels and scales, oval bearings and weight have it
// (calib/poses/effects).
Triplets JointErrors(const ArmGeometry& geometry, const MatrixXd& q,
                     const MatrixXd& by_all) {
  Triplets entries;
  const Eigen::Index per_row = by_all.rows() / q.rows();
  for (int joint = 0; joint < geometry.num_joints(); ++joint) {
    const int zero = geometry.ZeroOf(joint);
    if (zero < 0) continue;
    for (Eigen::Index k = 0; k < by_all.rows(); ++k) {
      const double angle = q(k / per_row, joint), by_joint = by_all(k, zero);
      if (by_joint == 0) continue;
      const auto row = static_cast<int>(k);
      for (int n = 1; n <= kJointHarmonics; ++n) {
        const int column = 2 * (kJointHarmonics * joint + n - 1);
        entries.emplace_back(row, column, std::cos(n * angle) * by_joint);
        entries.emplace_back(row, column + 1, std::sin(n * angle) * by_joint);
      }
    }
  }
  return entries;
}

// Those of the arm's own parameters that nobody asked for: they stay as in the
// file, which may be wrong, each by as much as it would be allowed to be
// (GeometryPrior).
Triplets FileErrors(const PoseFit& fit, const MatrixXd& by_all) {
  const std::vector<bool> wanted = fit.Wanted(fit.refine());
  Triplets entries;
  for (int p = 0; p < fit.geometry().size(); ++p) {
    if (wanted[p]) continue;
    for (Eigen::Index k = 0; k < by_all.rows(); ++k) {
      const double error = fit.PriorOf(p) * by_all(k, p);
      if (error != 0) entries.emplace_back(static_cast<int>(k), p, error);
    }
  }
  return entries;
}

}  // namespace

// Priors of the instrument are no errors of poses; they have variance 1 each.
MatrixXd PoseScoreCovariance(const PoseFit& fit, const std::vector<int>& rows,
                             const MatrixXd& by_all, const VectorXd& residuals,
                             const MatrixXd& basis) {
  const MatrixXd Q = basis.topRows(residuals.size());
  std::vector<VarianceComponent> components;
  components.emplace_back(Own(Q.rows()), Q.rows(), Q);
  const std::vector<PoseReading> readings = ReadingsOf(fit, rows);
  if (AnyPoseIsReadTwice(readings)) {
    AddPoseErrors(readings, fit.Coordinates(), Q, &components);
  }
  const Triplets joints =
      JointErrors(fit.geometry(), fit.measured().q(rows, Eigen::all), by_all);
  if (!joints.empty()) {
    components.emplace_back(
        joints, 2 * kJointHarmonics * fit.geometry().num_joints(), Q);
  }
  const Triplets file = FileErrors(fit, by_all);
  if (!file.empty()) components.emplace_back(file, fit.geometry().size(), Q);
  const LossScores scores = fit.Scores(residuals);
  const VectorXd variances = VariancesOf(components, scores.psi);
  const Eigen::Index p = basis.cols();
  MatrixXd sum = MatrixXd::Zero(p, p);
  for (size_t k = 0; k < components.size(); ++k) {
    sum += variances[static_cast<Eigen::Index>(k)] * components[k].S;
  }
  return sum / (scores.slope * scores.slope) + MatrixXd::Identity(p, p) -
         components[0].S;
}

}  // namespace armcal
