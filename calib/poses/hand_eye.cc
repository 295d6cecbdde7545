#include "calib/poses/hand_eye.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>

#include "model/robot/rotations.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Of the smallest but one singular value over the largest: with less a second
// pair of rotations fits as well.
constexpr double kSecondPairOfRotations = 1e-3;

// vec(R_BW R_WT) = (R_WT' x 1) vec(R_BW), vec(R_BE R_ET) = (1 x R_BE)
// vec(R_ET), columns stacked.
MatrixXd RotationEquations(const std::vector<Isometry3d>& X_BE,
                           const std::vector<Isometry3d>& X_WT) {
  MatrixXd A = MatrixXd::Zero(static_cast<Eigen::Index>(9 * X_BE.size()), 18);
  for (size_t k = 0; k < X_BE.size(); ++k) {
    auto rows = A.middleRows(static_cast<Eigen::Index>(9 * k), 9);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        rows.block<3, 3>(3 * i, 3 * j) =
            X_WT[k].linear()(j, i) * Matrix3d::Identity();
      }
      rows.block<3, 3>(3 * i, 9 + 3 * i) = -X_BE[k].linear();
    }
  }
  return A;
}

// p_WT = p_WB + R_WB (p_BE + R_BE p_ET).
void SolveTranslations(const std::vector<Isometry3d>& X_BE,
                       const std::vector<Isometry3d>& X_WT, HandEye* frames) {
  const auto rows = static_cast<Eigen::Index>(3 * X_BE.size());
  MatrixXd A(rows, 6);
  VectorXd b(rows);
  for (size_t k = 0; k < X_BE.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(3 * k);
    const Matrix3d& R_WB = frames->X_WB.linear();
    A.block<3, 3>(at, 0).setIdentity();
    A.block<3, 3>(at, 3) = R_WB * X_BE[k].linear();
    b.segment<3>(at) = X_WT[k].translation() - R_WB * X_BE[k].translation();
  }
  const VectorXd x = A.colPivHouseholderQr().solve(b);
  frames->X_WB.translation() = x.head<3>();
  frames->X_ET.translation() = x.tail<3>();
}

}  // namespace

std::optional<HandEye> SolveHandEye(const std::vector<Isometry3d>& X_BE,
                                    const std::vector<Isometry3d>& X_WT) {
  if (X_BE.size() < 3) return std::nullopt;
  const Eigen::JacobiSVD<MatrixXd> svd(RotationEquations(X_BE, X_WT),
                                       Eigen::ComputeThinV);
  const VectorXd& s = svd.singularValues();
  if (!(s[16] > kSecondPairOfRotations * s[0])) return std::nullopt;
  VectorXd x = svd.matrixV().col(17);
  // Of either sign.
  if (Eigen::Map<const Matrix3d>(x.data()).determinant() < 0) x = -x;
  HandEye frames{Isometry3d::Identity(), Isometry3d::Identity()};
  frames.X_WB.linear() =
      NearestRotation(Eigen::Map<const Matrix3d>(x.data())).transpose();
  frames.X_ET.linear() =
      NearestRotation(Eigen::Map<const Matrix3d>(x.data() + 9));
  SolveTranslations(X_BE, X_WT, &frames);
  return frames;
}

std::optional<HandEye> SolveHandEye(const ArmGeometry& geometry,
                                    VectorXd values, const MatrixXd& q,
                                    const std::vector<Isometry3d>& X_WT) {
  values.head<6>().setZero();
  values.tail<6>().setZero();
  std::vector<Isometry3d> X_BE;
  for (Eigen::Index k = 0; k < q.rows(); ++k) {
    X_BE.push_back(geometry.ToolPose(q.row(k), values.data(), nullptr));
  }
  return SolveHandEye(X_BE, X_WT);
}

}  // namespace armcal
