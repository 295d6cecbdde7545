#include "problems/poses/pose_problem.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "problems/poses/plane_residual.h"
#include "problems/poses/pose_residual.h"
#include "problems/poses/target_residual.h"
#include "problems/poses/tilt_residual.h"
#include "problems/poses/touch_residual.h"
#include "problems/poses/wire_residual.h"

namespace armcal {

using Eigen::Isometry3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Kind = PoseMeasurements::Kind;

Isometry3d MeasuredPose(const PoseMeasurements& measured, int row) {
  const Eigen::RowVectorXd m = measured.poses.row(row);
  Isometry3d X = Isometry3d::Identity();
  X.translation() = m.head<3>();
  X.linear() = Eigen::Quaterniond(m[3], m[4], m[5], m[6]).normalized().matrix();
  return X;
}

MatrixXd InstrumentMoves(const PoseMeasurements& measured, int pose) {
  if (measured.instrument.size() == 0) return MatrixXd(6, 0);
  return measured.instrument.moves[pose];
}

// W = L^-1 of the covariance L L', so that W e has covariance 1 (generalised
// least squares; Bjorck 1996, ch. 4). The instrument's own covariance and what
// the arm adds are independent and add up.
Matrix6d PoseWhitening(const PoseMeasurements& measured, const PoseNoise& noise,
                       int pose) {
  Eigen::Matrix<double, 6, 1> deviations;
  deviations << Vector3d::Constant(noise.position),
      Vector3d::Constant(noise.rotation);
  if (measured.covariance.empty()) {
    return deviations.cwiseInverse().asDiagonal();
  }
  Matrix6d covariance = measured.covariance[pose];
  covariance.diagonal() += deviations.cwiseAbs2();
  return covariance.llt().matrixL().solve(Matrix6d::Identity());
}

// Blocks of d coordinates share a loss by their length, psi(r) = rho'(s) r with
// s = |r|^2, of which trace dpsi/dr = d rho' + 2 rho'' s.
LossScores ScoresOf(const Eigen::VectorXd& residuals, int block,
                    RobustLoss loss) {
  const std::unique_ptr<ceres::LossFunction> rho(MakeLoss(loss, block));
  LossScores scores = {Eigen::VectorXd::Zero(residuals.size()), 0};
  for (Eigen::Index k = 0; k + block <= residuals.size(); k += block) {
    const auto r = residuals.segment(k, block);
    const double s = r.squaredNorm();
    double value[3] = {s, 1, 0};  // rho, rho', rho''
    if (rho) rho->Evaluate(s, value);
    scores.psi.segment(k, block) = value[1] * r;
    scores.slope += block * value[1] + 2 * value[2] * s;
  }
  scores.slope /= static_cast<double>(residuals.size());
  return scores;
}

// The sandwich A^-1 B A^-1 of an M-estimate with errors that are alike has A =
// mean psi' J'J and B = mean psi^2 J'J: it is the factor of the header times
// (J'J)^-1. Without a loss it is the usual variance, |r|^2 / (N - p).
double VarianceFactor(const Eigen::VectorXd& residuals, int block,
                      RobustLoss loss, int num_unknowns) {
  const LossScores scores = ScoresOf(residuals, block, loss);
  const double N = static_cast<double>(residuals.size());
  return scores.psi.squaredNorm() / std::max(1.0, N - num_unknowns) /
         (scores.slope * scores.slope);
}

int CoordinatesOf(const PoseMeasurements& measured) {
  const Kind kind = measured.kind();
  if (kind == Kind::kWire || kind == Kind::kPlanes) return 1;
  return kind == Kind::kTilts ? 2 : 3;
}

int PoseUnknowns::NumOther(const PoseMeasurements& measured) {
  if (measured.kind() == Kind::kWire) return 4;
  if (measured.kind() == Kind::kPoses) return measured.instrument.size();
  return 3 *
         (static_cast<int>(measured.targets.size()) + measured.num_points());
}

// Names follow the order in which the unknowns are stacked, three per thing.
std::vector<std::string> PoseUnknowns::OtherNames(
    const PoseMeasurements& measured) {
  if (measured.lengths.size() > 0) {
    return {"wire.x", "wire.y", "wire.z", "wire.offset"};
  }
  std::vector<std::string> names;
  if (measured.poses.size() > 0) {
    for (int k = 0; k < NumOther(measured); ++k) {
      names.push_back("instrument" + std::to_string(k + 1));
    }
    return names;
  }
  const std::string what = measured.planes            ? "plane"
                           : measured.touched.empty() ? "target"
                                                      : "point";
  const std::vector<const char*> parts =
      measured.planes ? std::vector<const char*>{".a", ".b", ".c"}
                      : std::vector<const char*>{".x", ".y", ".z"};
  for (int k = 0; k < NumOther(measured) / 3; ++k) {
    for (const char* part : parts) {
      names.push_back(what + std::to_string(k + 1) + part);
    }
  }
  return names;
}

Eigen::VectorXd PoseUnknowns::OtherPriors(const PoseMeasurements& measured) {
  if (measured.poses.size() > 0 && measured.instrument.size() > 0) {
    return measured.instrument.prior;
  }
  return Eigen::VectorXd::Zero(NumOther(measured));
}

// Decides by what the measurement can tell, before any number is looked at.
// Directions that the postures leave open are found later, by rank. What no
// instrument of this kind can tell must not be free at all, or it would be set
// by noise.
std::vector<bool> FreeGeometry(const ArmGeometry& geometry,
                               RefineGeometry refine,
                               const PoseMeasurements* measured) {
  const auto is = [measured](Kind kind) {
    return measured != nullptr && measured->kind() == kind;
  };
  // An anchor or a point that was touched stands for the instrument's frame,
  // and sees the tool's tip alone.
  const bool wire = is(Kind::kWire) || is(Kind::kPoints) || is(Kind::kPlanes);
  const bool targets = is(Kind::kTargets);
  const std::vector<std::string> names = geometry.Names();
  const std::vector<std::string> units = geometry.Units();
  std::vector<bool> free(geometry.size(), false);
  for (int k = 0; k < geometry.size(); ++k) {
    const std::string field = names[k].substr(names[k].rfind('.'));
    // An inclinometer sees directions alone, and none about the vertical.
    const bool about_vertical = ArmGeometry::IsBase(k) && field == ".yaw";
    if (is(Kind::kTilts) && (units[k] == "m" || about_vertical)) continue;
    if (ArmGeometry::IsBase(k)) {
      free[k] = measured != nullptr && !wire;
    } else if (geometry.IsTool(k)) {
      const bool point = field == ".x" || field == ".y" || field == ".z";
      free[k] = measured != nullptr && !targets && (point || !wire);
    } else {
      free[k] = refine == RefineGeometry::kAll ||
                (refine == RefineGeometry::kOffsets && field == ".theta");
    }
  }
  return free;
}

// One residual block for each thing that was measured at a posture. A block is
// what the robust loss judges as one: all coordinates of a point, or position
// and rotation of a pose, since one bump of the tracker spoils them together.
void AddPoseResiduals(const std::shared_ptr<const ArmGeometry>& geometry,
                      const PoseMeasurements& measured,
                      const std::vector<int>& rows, const PoseNoise& noise,
                      RobustLoss loss, PoseUnknowns* unknowns,
                      ceres::Problem* problem) {
  double* const g = unknowns->geometry.data();
  double* const other = unknowns->other.data();
  const std::vector<TouchedPlane> planes =
      measured.planes ? TouchedPlanes(*geometry, measured, nullptr)
                      : std::vector<TouchedPlane>{};
  for (const int k : rows) {
    const Eigen::VectorXd q = measured.q.row(k);
    if (measured.lengths.size() > 0) {
      problem->AddResidualBlock(
          new WireResidual(geometry, q, measured.lengths[k], noise.position),
          MakeLoss(loss, 1), g, other);
    }
    for (size_t t = 0; t < measured.targets.size(); ++t) {
      problem->AddResidualBlock(
          new TargetResidual(geometry, q, measured.targets[t].row(k),
                             noise.position),
          MakeLoss(loss, 3), g, other + 3 * t);
    }
    if (measured.planes) {
      const int plane = measured.touched[k];
      problem->AddResidualBlock(
          new PlaneResidual(geometry, q, planes[plane], noise.position),
          MakeLoss(loss, 1), g, other + 3 * plane);
    } else if (!measured.touched.empty()) {
      problem->AddResidualBlock(new TouchResidual(geometry, q, noise.position),
                                MakeLoss(loss, 3), g,
                                other + 3 * measured.touched[k]);
    }
    if (measured.tilts.size() > 0) {
      problem->AddResidualBlock(
          new TiltResidual(geometry, q, measured.tilts.row(k), noise.position),
          MakeLoss(loss, 2), g);
    }
    if (measured.poses.size() > 0) {
      const MatrixXd moves = InstrumentMoves(measured, k);
      std::vector<double*> blocks = {g};
      if (moves.cols() > 0) blocks.push_back(other);
      problem->AddResidualBlock(
          new PoseResidual(geometry, q, MeasuredPose(measured, k),
                           PoseWhitening(measured, noise, k), moves),
          MakeLoss(loss, 6), blocks);
    }
  }
}

// The errors of AddPoseResiduals before they are whitened, by the same formulas
// of each kind: what people read is in m (rad) and not in standard deviations.
MatrixXd PositionErrors(const ArmGeometry& geometry,
                        const PoseMeasurements& measured,
                        const PoseUnknowns& unknowns) {
  const bool wire = measured.lengths.size() > 0;
  const int targets = static_cast<int>(measured.targets.size());
  MatrixXd errors(measured.size(),
                  CoordinatesOf(measured) * std::max(1, targets));
  const std::vector<TouchedPlane> planes =
      measured.planes ? TouchedPlanes(geometry, measured, nullptr)
                      : std::vector<TouchedPlane>{};
  for (int k = 0; k < measured.size(); ++k) {
    const Isometry3d X =
        geometry.ToolPose(measured.q.row(k), unknowns.geometry.data(), nullptr);
    if (wire) {
      const Vector3d p_WA = unknowns.other.head<3>();
      errors(k, 0) = (X.translation() - p_WA).norm() + unknowns.other[3] -
                     measured.lengths[k];
      continue;
    }
    if (measured.tilts.size() > 0) {
      errors.row(k) = TiltErrors(X.linear(), measured.tilts.row(k)).transpose();
      continue;
    }
    for (int t = 0; t < targets; ++t) {
      const Vector3d p = X * Vector3d(unknowns.other.segment<3>(3 * t));
      errors.row(k).segment<3>(3 * t) =
          p.transpose() - measured.targets[t].row(k);
    }
    if (measured.planes) {
      const int plane = measured.touched[k];
      errors(k, 0) = planes[plane].Distance(unknowns.other.data() + 3 * plane,
                                            X.translation());
    } else if (!measured.touched.empty()) {
      errors.row(k) =
          (X.translation() - unknowns.other.segment<3>(3 * measured.touched[k]))
              .transpose();
    } else if (targets == 0) {
      errors.row(k) =
          (X.translation() - MeasuredPose(measured, k).translation() -
           InstrumentMoves(measured, k).topRows(3) * unknowns.other)
              .transpose();
    }
  }
  return errors;
}

MatrixXd RotationErrors(const ArmGeometry& geometry,
                        const PoseMeasurements& measured,
                        const PoseUnknowns& unknowns) {
  if (measured.poses.size() == 0) return {};
  MatrixXd errors(measured.size(), 3);
  for (int k = 0; k < measured.size(); ++k) {
    const Isometry3d X =
        geometry.ToolPose(measured.q.row(k), unknowns.geometry.data(), nullptr);
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(
        X.linear() * MeasuredPose(measured, k).linear().transpose()));
    errors.row(k) =
        (turn.angle() * turn.axis() -
         InstrumentMoves(measured, k).bottomRows(3) * unknowns.other)
            .transpose();
  }
  return errors;
}

}  // namespace armcal
