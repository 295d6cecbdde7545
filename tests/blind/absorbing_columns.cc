#include "tests/blind/absorbing_columns.h"

#include <cmath>

#include "model/signals/low_pass.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// 50 Hz: enough for columns, whose torques are many.
PlantMotion Coarse(const PlantMotion& motion) {
  constexpr double kRateHz = 50;
  const int stride = static_cast<int>(std::lround(motion.rate / kRateHz));
  const int rows = static_cast<int>(motion.q.rows() - 1) / stride + 1;
  const auto thin = [rows, stride](const MatrixXd& x) {
    MatrixXd y(rows, x.cols());
    for (int k = 0; k < rows; ++k) y.row(k) = x.row(k * stride);
    return y;
  };
  return {thin(motion.q), thin(motion.qd), thin(motion.qdd),
          motion.rate / stride};
}

class Columns {
 public:
  Columns(const BlindCase& blind, const PlantMotion& motion)
      : blind_(blind),
        motion_(Coarse(motion)),
        widths_(ZeroVelocityWidths(blind)),
        base_(ModelTorque(blind.robot, widths_, motion_)) {}

  MatrixXd All() {
    for (int i = 0; i < blind_.robot.num_joints(); ++i) {
      AddLink(i);
      AddJoint(i);
    }
    AddTorque(kTimingSpread * Differentiate(base_, 1 / motion_.rate));
    MatrixXd all(columns_[0].size(), columns_.size());
    for (size_t k = 0; k < columns_.size(); ++k) all.col(k) = columns_[k];
    return all;
  }

 private:
  void AddTorque(const MatrixXd& torque) {
    const MatrixXd thin = ThinTorque(torque, motion_.rate);
    columns_.push_back(Eigen::Map<const VectorXd>(thin.data(), thin.size()));
  }
  void AddRobot(const Robot& changed, double spread) {
    AddTorque(spread * (ModelTorque(changed, widths_, motion_) - base_));
  }
  void AddLink(int i) {
    const InertialParameters& inertial = blind_.robot.links[i].inertial;
    const double mass = inertial.mass;
    const double size = std::sqrt(inertial.inertia.trace() / 2 / mass);
    for (int k = 0; k < 10; ++k) {
      const double unit = k == 0 ? mass : mass * (k < 4 ? size : size * size);
      Robot changed = blind_.robot;
      changed.links[i].inertial +=
          InertialParameters::FromVector(Vector10d::Unit(k));
      AddRobot(changed, blind_.trust * unit);
    }
  }
  // Of joint j alone.
  void AddRow(int j, const VectorXd& torque, double spread) {
    MatrixXd all = MatrixXd::Zero(base_.rows(), base_.cols());
    all.col(j) = spread * torque;
    AddTorque(all);
  }
  void AddJoint(int j) {
    const Joint& joint = blind_.robot.links[j].joint;
    const VectorXd qd = motion_.qd.col(j);
    const auto sign = [&qd](double width) -> VectorXd {
      return qd.array() / (qd.array().square() + width * width).sqrt();
    };
    AddRow(j, motion_.qdd.col(j), blind_.trust * joint.armature);
    AddRow(j, qd, blind_.trust * joint.viscous);
    AddRow(j, sign(widths_[j]), blind_.trust * joint.coulomb);
    AddRow(j, VectorXd::Ones(qd.size()), blind_.trust * joint.coulomb);
    AddRow(j, sign(std::exp(1) * widths_[j]) - sign(widths_[j]), joint.coulomb);
  }

  const BlindCase& blind_;
  PlantMotion motion_;
  VectorXd widths_;
  MatrixXd base_;
  std::vector<VectorXd> columns_;
};

MatrixXd Information(const MatrixXd& columns, const MatrixXd& known) {
  MatrixXd information = columns.transpose() * columns;
  information.diagonal().array() += 1;
  if (known.size() > 0) information += known;
  return information;
}

}  // namespace

MatrixXd AbsorbingColumns(const BlindCase& blind, const PlantMotion& motion) {
  return Columns(blind, motion).All();
}

Absorption::Absorption(const MatrixXd& columns, const MatrixXd& known)
    : columns_(columns), information_(Information(columns, known)) {}

VectorXd Absorption::Coefficients(const VectorXd& d,
                                  const VectorXd& known_gradient) const {
  return information_.solve(columns_.transpose() * d + known_gradient);
}

Absorption::Left Absorption::Of(const VectorXd& d) const {
  const VectorXd gradient = columns_.transpose() * d;
  const VectorXd x = information_.solve(gradient);
  return {d - columns_ * x, d.squaredNorm() - gradient.dot(x)};
}

}  // namespace armcal
