#include "calib/poses/diagnosis/equations.h"

#include <Eigen/Geometry>

namespace armcal {

using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

PoseEquations::PoseEquations(const PoseFit& fit,
                             const PoseMeasurements& measured)
    : fit_(fit),
      width_(fit.EquationsPerPose()),
      measured_(measured),
      movers_(static_cast<int>(measured.q.cols()),
              static_cast<int>(measured.targets.size())),
      file_(fit.geometry().Values()),
      middle_(Vector3d::Zero()) {
  for (const MatrixXd& target : measured.targets) {
    middle_ += target.colwise().mean().transpose() /
               static_cast<double>(measured.targets.size());
  }
  if (measured.poses.size() > 0) {
    middle_ = measured.poses.leftCols(3).colwise().mean().transpose();
  }
}

PoseEquations PoseEquations::Of(const PoseMeasurements& other) const {
  PoseEquations equations(fit_, other);
  equations.free_ = free_;
  equations.rotation_length_ = rotation_length_;
  equations.middle_ = middle_;
  return equations;
}

void PoseEquations::SetFree(const std::vector<bool>& geometry) {
  free_.clear();
  for (size_t k = 0; k < geometry.size(); ++k) {
    if (geometry[k]) free_.push_back(static_cast<int>(k));
  }
  for (int k = 0; k < PoseUnknowns::NumOther(measured_); ++k) {
    free_.push_back(static_cast<int>(geometry.size()) + k);
  }
}

DisplacedPose PoseEquations::Displace(int pose,
                                      const std::vector<PoseTerm>& terms,
                                      const PoseState& at,
                                      bool with_twists) const {
  VectorXd by = VectorXd::Zero(movers_.size());
  for (size_t k = 0; k < terms.size(); ++k) {
    by[Mover(terms[k])] += at.amounts[k] * terms[k].signal[pose];
  }
  return DisplacedPose(fit_.geometry(), movers_, at.unknowns,
                       measured_.q.row(pose).transpose(), by, middle_,
                       with_twists);
}

// Predicted minus measured of one pose, by kind. Rotations are multiplied by a
// length, so that one scale of errors serves them and positions.
void PoseEquations::Residual(int k, const DisplacedPose& d, const PoseState& at,
                             Eigen::Ref<VectorXd> r) const {
  if (measured_.lengths.size() > 0) {
    const Vector3d from = d.points.col(0) - at.unknowns.other.head<3>();
    r[0] = from.norm() + at.unknowns.other[3] + d.length - measured_.lengths[k];
    return;
  }
  if (measured_.poses.size() > 0) {
    const Eigen::RowVectorXd m = measured_.poses.row(k);
    const Eigen::Quaterniond q(m[3], m[4], m[5], m[6]);
    r.head<3>() = d.points.col(0) - m.head<3>().transpose();
    r.tail<3>() = rotation_length_ *
                  RotationVector(d.R * q.normalized().matrix().transpose());
    if (measured_.instrument.size() > 0) {
      r -= InstrumentColumns(k) * at.unknowns.other;
    }
    return;
  }
  for (size_t t = 0; t < measured_.targets.size(); ++t) {
    r.segment<3>(3 * t) =
        d.points.col(t) - measured_.targets[t].row(k).transpose();
  }
}

MatrixXd PoseEquations::InstrumentColumns(int k) const {
  MatrixXd columns = InstrumentMoves(measured_, k);
  columns.bottomRows(3) *= rotation_length_;
  return columns;
}

void PoseEquations::Project(const DisplacedPose& d, const PoseState& at,
                            const Matrix3Xd& velocity, const Vector3d& turning,
                            Eigen::Ref<VectorXd> column) const {
  if (measured_.lengths.size() > 0) {
    const Vector3d from = d.points.col(0) - at.unknowns.other.head<3>();
    column[0] = from.stableNormalized().dot(velocity.col(0));
  } else if (measured_.poses.size() > 0) {
    column.head<3>() = velocity.col(0);
    column.tail<3>() = rotation_length_ * turning;
  } else {
    column = velocity.reshaped();
  }
}

// Derivatives by twists of the geometry and in closed form by what else is
// unknown: a wire's anchor and offset, the instrument's, targets on the tool.
void PoseEquations::GeometryColumns(int pose, const DisplacedPose& d,
                                    const PoseState& at,
                                    Eigen::Ref<MatrixXd> J) const {
  const int g = fit_.geometry().size();
  Matrix3Xd velocity(3, d.points.cols());
  for (size_t c = 0; c < free_.size(); ++c) {
    const int k = free_[c];
    if (k < g) {
      const Vector3d turning = d.ByTwist(d.parameters[k], &velocity);
      Project(d, at, velocity, turning, J.col(c));
    } else if (measured_.lengths.size() > 0) {
      const Vector3d from = d.points.col(0) - at.unknowns.other.head<3>();
      J(0, c) = k - g < 3 ? -from.stableNormalized()[k - g] : 1;
    } else if (measured_.poses.size() > 0) {
      J.col(c) = -InstrumentColumns(pose).col(k - g);
    } else {
      J.col(c).setZero();
      J.col(c).segment<3>((k - g) / 3 * 3) = d.scale * d.R.col((k - g) % 3);
    }
  }
}

void PoseEquations::MoverColumns(const DisplacedPose& d, const PoseState& at,
                                 const std::vector<bool>& wanted,
                                 Eigen::Ref<MatrixXd> J) const {
  Matrix3Xd velocity(3, d.points.cols());
  const int length = movers_.Index(PoseTerm::Acts::kLength, 0);
  for (int k = 0; k < movers_.size(); ++k) {
    if (!wanted[k]) continue;
    const Vector3d turning =
        d.ByMover(movers_, at.unknowns, k, middle_, &velocity);
    Project(d, at, velocity, turning, J.col(k));
    if (k == length && measured_.lengths.size() > 0) J(0, k) = 1;
  }
}

VectorXd PoseEquations::Residuals(const std::vector<PoseTerm>& terms,
                                  const PoseState& at) const {
  VectorXd r(poses() * width());
  for (int k = 0; k < poses(); ++k) {
    Residual(k, Displace(k, terms, at, false), at,
             r.segment(k * width(), width()));
  }
  return r;
}

LinearPoses PoseEquations::Linearise(const std::vector<PoseTerm>& terms,
                                     const PoseState& at,
                                     bool all_movers) const {
  LinearPoses linear;
  const int rows = poses() * width();
  linear.r.resize(rows);
  linear.geometry.resize(rows, num_free());
  linear.movers = MatrixXd::Zero(rows, movers_.size());
  std::vector<bool> wanted(movers_.size(), all_movers);
  for (const PoseTerm& term : terms) wanted[Mover(term)] = true;
  for (int k = 0; k < poses(); ++k) {
    const DisplacedPose d = Displace(k, terms, at, true);
    Residual(k, d, at, linear.r.segment(k * width(), width()));
    GeometryColumns(k, d, at, linear.geometry.middleRows(k * width(), width()));
    MoverColumns(d, at, wanted, linear.movers.middleRows(k * width(), width()));
  }
  return linear;
}

MatrixXd PoseEquations::Columns(const LinearPoses& linear,
                                const std::vector<PoseTerm>& terms) const {
  MatrixXd columns(linear.r.size(), terms.size());
  for (size_t c = 0; c < terms.size(); ++c) {
    const int mover = Mover(terms[c]);
    for (int k = 0; k < poses(); ++k) {
      columns.col(c).segment(k * width(), width()) =
          terms[c].signal[k] *
          linear.movers.col(mover).segment(k * width(), width());
    }
  }
  return columns;
}

VectorXd PoseEquations::Precision() const {
  VectorXd precision = VectorXd::Zero(num_free());
  const VectorXd others = PoseUnknowns::OtherPriors(measured_);
  const int g = fit_.geometry().size();
  for (int c = 0; c < num_free(); ++c) {
    const int k = free_[c];
    const double sigma = k < g ? fit_.PriorOf(k) : others[k - g];
    if (sigma > 0) precision[c] = 1 / (sigma * sigma);
  }
  return precision;
}

VectorXd PoseEquations::FromFile(const PoseState& at) const {
  VectorXd away = VectorXd::Zero(num_free());
  for (int c = 0; c < num_free(); ++c) {
    const int k = free_[c], g = fit_.geometry().size();
    away[c] =
        k < g ? at.unknowns.geometry[k] - file_[k] : at.unknowns.other[k - g];
  }
  return away;
}

PoseState PoseEquations::Moved(const PoseState& at,
                               const VectorXd& step) const {
  PoseState moved = at;
  const int g = fit_.geometry().size();
  for (int c = 0; c < num_free(); ++c) {
    double* value = free_[c] < g ? &moved.unknowns.geometry[free_[c]]
                                 : &moved.unknowns.other[free_[c] - g];
    *value += step[c];
  }
  moved.amounts += step.tail(at.amounts.size());
  return moved;
}

MatrixXd PoseEquations::Standing(const std::vector<PoseTerm>& terms,
                                 const VectorXd& amounts) const {
  MatrixXd q = measured_.q;
  for (size_t k = 0; k < terms.size(); ++k) {
    if (terms[k].acts != PoseTerm::Acts::kJoint) continue;
    q.col(terms[k].index) += amounts[k] * terms[k].signal;
  }
  return q;
}

VectorXd PoseEquations::Zeros(const PoseState& at) const {
  const ArmGeometry& geometry = fit_.geometry();
  VectorXd zeros = VectorXd::Zero(geometry.num_joints());
  for (int i = 0; i < geometry.num_joints(); ++i) {
    const int k = geometry.ZeroOf(i);
    if (k >= 0) zeros[i] = at.unknowns.geometry[k] - file_[k];
  }
  return zeros;
}

}  // namespace armcal
