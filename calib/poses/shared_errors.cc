#include "calib/poses/shared_errors.h"

#include <Eigen/QR>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

#include "calib/poses/repeated_poses.h"

namespace armcal {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;
using Triplets = std::vector<Eigen::Triplet<double>>;

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

// Of independent errors e = sum_k Z_k a_k, with as many amounts a_k as columns,
// all of one variance.
struct Component {
  Sparse Z;
  MatrixXd G;  // Z'Q
  MatrixXd S;  // G'G
};

// Scaled to a mean square of 1 a residual, as the identity is.
Component MakeComponent(const Triplets& entries, Eigen::Index columns,
                        const MatrixXd& Q) {
  Component component;
  component.Z.resize(Q.rows(), columns);
  component.Z.setFromTriplets(entries.begin(), entries.end());
  const double square = component.Z.squaredNorm();
  component.Z *= std::sqrt(static_cast<double>(Q.rows()) / square);
  component.G = component.Z.transpose() * Q;
  component.S = component.G.transpose() * component.G;
  return component;
}

// Errors of each coordinate by itself; of a pose, by which all its readings are
// displaced alike; and, of several targets, by which it is turned.
std::vector<Component> ComponentsOf(const std::vector<PoseReading>& readings,
                                    int width, const MatrixXd& Q) {
  Triplets own, moved, turned;
  int poses = 0;
  for (const PoseReading& reading : readings) {
    poses = std::max(poses, reading.pose + 1);
    const Matrix3d lever = -Cross(reading.lever);
    for (int c = 0; c < width; ++c) {
      const auto row = static_cast<int>(reading.first) + c;
      own.emplace_back(row, row, 1);
      moved.emplace_back(row, width * reading.pose + c, 1);
      for (int a = 0; a < 3 && reading.lever.norm() > 0; ++a) {
        turned.emplace_back(row, 3 * reading.pose + a, lever(c, a));
      }
    }
  }
  std::vector<Component> all = {MakeComponent(own, Q.rows(), Q),
                                MakeComponent(moved, width * poses, Q)};
  if (!turned.empty()) all.push_back(MakeComponent(turned, 3 * poses, Q));
  return all;
}

// |Z_j' M Z_k|^2 of M = I - Q Q', without M, which is as large as the square of
// all residuals.
double Shared(const Component& j, const Component& k) {
  const Sparse product = j.Z.transpose() * k.Z;
  double cross = 0;
  for (int c = 0; c < product.outerSize(); ++c) {
    for (Sparse::InnerIterator at(product, c); at; ++at) {
      cross += at.value() * j.G.row(at.row()).dot(k.G.row(at.col()));
    }
  }
  return product.squaredNorm() - 2 * cross + j.S.cwiseProduct(k.S).sum();
}

// Variances of components, of psi = M e: by E |Z_j' psi|^2 = sum_k variance_k
// |Z_j' M Z_k|^2, which is unbiased whatever the estimate has taken out of the
// errors (MINQUE; Rao 1971, J. Multivariate Analysis 1; Searle, Casella and
// McCulloch 1992, ch. 11). One below 0 is none, and the others are solved for
// again.
VectorXd VariancesOf(const std::vector<Component>& components,
                     const VectorXd& psi) {
  const auto size = static_cast<Eigen::Index>(components.size());
  MatrixXd shared(size, size);
  VectorXd moments(size);
  for (Eigen::Index j = 0; j < size; ++j) {
    moments[j] = (components[j].Z.transpose() * psi).squaredNorm();
    for (Eigen::Index k = 0; k < size; ++k) {
      shared(j, k) = Shared(components[j], components[k]);
    }
  }
  std::vector<Eigen::Index> there;
  for (Eigen::Index k = 0; k < size; ++k) there.push_back(k);
  VectorXd variances = VectorXd::Zero(size);
  while (!there.empty()) {
    const VectorXd solved =
        shared(there, there).colPivHouseholderQr().solve(moments(there));
    Eigen::Index least = 0;
    if (!(solved.minCoeff(&least) < 0)) {
      for (size_t k = 0; k < there.size(); ++k) {
        variances[there[k]] = solved[static_cast<Eigen::Index>(k)];
      }
      break;
    }
    there.erase(there.begin() + least);
  }
  return variances;
}

}  // namespace

// Priors of the instrument are no errors of poses; they have variance 1 each.
MatrixXd ScoreCovariance(const PoseFit& fit, const std::vector<int>& rows,
                         const VectorXd& residuals, const MatrixXd& basis,
                         int num_unknowns) {
  const Eigen::Index p = basis.cols();
  const std::vector<PoseReading> readings = ReadingsOf(fit, rows);
  if (!AnyPoseIsReadTwice(readings)) {
    return fit.VarianceFactor(residuals, num_unknowns) *
           MatrixXd::Identity(p, p);
  }
  const LossScores scores = fit.Scores(residuals);
  const std::vector<Component> components = ComponentsOf(
      readings, fit.Coordinates(), basis.topRows(residuals.size()));
  const VectorXd variances = VariancesOf(components, scores.psi);
  MatrixXd sum = MatrixXd::Zero(p, p);
  for (size_t k = 0; k < components.size(); ++k) {
    sum += variances[static_cast<Eigen::Index>(k)] * components[k].S;
  }
  return sum / (scores.slope * scores.slope) + MatrixXd::Identity(p, p) -
         components[0].S;
}

}  // namespace armcal
