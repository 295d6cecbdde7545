#include "tests/blind/effect_size.h"

#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "model/inverse_dynamics.h"
#include "model/low_pass.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kBandwidthHz = 10;
constexpr double kRateHz = 25;
constexpr double kTimingSpread = 5e-4;  // s

// Low-passed samples at kRateHz; a second at both ends belongs to the filter.
MatrixXd Thin(const MatrixXd& x, double rate) {
  const int stride = static_cast<int>(std::lround(rate / kRateHz));
  const MatrixXd smooth = ZeroPhaseLowPass(x, rate, kBandwidthHz);
  const int skip = static_cast<int>(rate);
  MatrixXd thin((x.rows() - 1 - 2 * skip) / stride + 1, x.cols());
  for (int k = 0; k < thin.rows(); ++k) {
    thin.row(k) = smooth.row(skip + k * stride);
  }
  return thin;
}

// What a noiseless log says of the motion, samples in rows.
struct Motion {
  MatrixXd q, qd, qdd;
  double rate;
};

// Rates by the log's own stamps, which an effect may have made wrong.
Motion MotionOf(const Log& log) {
  const VectorXd dt = Differentiate(log.t, 1);
  const auto rate = [&dt](const MatrixXd& x) {
    return MatrixXd(Differentiate(x, 1).array().colwise() / dt.array());
  };
  Motion motion;
  motion.rate = SensorOptions().log_rate_hz;
  motion.q = log.q;
  motion.qd = rate(motion.q);
  motion.qdd = rate(motion.qd);
  return motion;
}

// Every fifth sample: enough for columns, whose torques are many.
Motion Coarse(const Motion& motion) {
  constexpr int kStride = 5;
  const int rows = static_cast<int>(motion.q.rows() - 1) / kStride + 1;
  const auto thin = [rows](const MatrixXd& x) {
    MatrixXd y(rows, x.cols());
    for (int k = 0; k < rows; ++k) y.row(k) = x.row(k * kStride);
    return y;
  };
  return {thin(motion.q), thin(motion.qd), thin(motion.qdd),
          motion.rate / kStride};
}

// Coulomb friction as the plant has it, per unit of its size.
double Coulomb(double v, double width) { return v / std::hypot(v, width); }

VectorXd Widths(const BlindCase& blind) {
  VectorXd widths(blind.robot.num_joints());
  for (int j = 0; j < widths.size(); ++j) {
    const bool turns = IsRotational(blind.robot.links[j].joint.type);
    widths[j] = (turns ? 1 : .3) * blind.zero_velocity;
  }
  return widths;
}

MatrixXd ModelTorque(const Robot& robot, const VectorXd& widths,
                     const Motion& motion) {
  MatrixXd tau(motion.q.rows(), motion.q.cols());
  for (int k = 0; k < tau.rows(); ++k) {
    const VectorXd qd = motion.qd.row(k), qdd = motion.qdd.row(k);
    tau.row(k) = InverseDynamics(robot, motion.q.row(k), qd, qdd);
    for (int j = 0; j < tau.cols(); ++j) {
      const Joint& joint = robot.links[j].joint;
      tau(k, j) += joint.armature * qdd[j] + joint.viscous * qd[j] +
                   joint.coulomb * Coulomb(qd[j], widths[j]) + joint.offset;
    }
  }
  return tau;
}

// A parameter that the model has: its torque per unit, and how far it may be
// from where it is.
struct Column {
  std::function<void(Robot*)> add;  // one unit
  double spread;
};

std::vector<Column> ModelColumns(const Robot& robot, double trust) {
  std::vector<Column> columns;
  for (int i = 0; i < robot.num_joints(); ++i) {
    const InertialParameters& inertial = robot.links[i].inertial;
    const double mass = inertial.mass;
    const double size = std::sqrt(inertial.inertia.trace() / 2 / mass);
    for (int k = 0; k < 10; ++k) {
      const double unit = k == 0 ? mass : mass * (k < 4 ? size : size * size);
      columns.push_back({[i, k](Robot* r) {
                           Vector10d v = Vector10d::Zero();
                           v[k] = 1;
                           r->links[i].inertial +=
                               InertialParameters::FromVector(v);
                         },
                         trust * unit});
    }
    const Joint& joint = robot.links[i].joint;
    const auto add = [&](double Joint::*term, double spread) {
      columns.push_back(
          {[i, term](Robot* r) { r->links[i].joint.*term += 1; }, spread});
    };
    add(&Joint::armature, trust * joint.armature);
    add(&Joint::viscous, trust * joint.viscous);
    add(&Joint::coulomb, trust * joint.coulomb);
    add(&Joint::offset, trust * joint.coulomb);
  }
  return columns;
}

// Torques (filtered, joints one below the other) of one prior spread of
// everything that the model may vary: parameters, the widths of zero velocity
// (by a factor of e) and the time of all torques.
MatrixXd Absorbing(const BlindCase& blind, const Motion& fine) {
  const Motion motion = Coarse(fine);
  const VectorXd widths = Widths(blind);
  const MatrixXd base = ModelTorque(blind.robot, widths, motion);
  std::vector<MatrixXd> torques;
  for (const Column& column : ModelColumns(blind.robot, blind.trust)) {
    Robot changed = blind.robot;
    column.add(&changed);
    torques.push_back(column.spread *
                      (ModelTorque(changed, widths, motion) - base));
  }
  for (int j = 0; j < widths.size(); ++j) {
    VectorXd wider = widths;
    wider[j] *= std::exp(1);
    torques.push_back(ModelTorque(blind.robot, wider, motion) - base);
  }
  torques.push_back(kTimingSpread * Differentiate(base, 1 / motion.rate));
  MatrixXd columns;
  for (size_t k = 0; k < torques.size(); ++k) {
    const MatrixXd thin = Thin(torques[k], motion.rate);
    if (k == 0) columns.resize(thin.size(), torques.size());
    columns.col(k) = Eigen::Map<const VectorXd>(thin.data(), thin.size());
  }
  return columns;
}

// Standard deviation of each joint's noise after the filter.
VectorXd NoiseSpread(const BlindCase& blind, double rate) {
  const int n = blind.robot.num_joints();
  TorqueNoise noise(blind.sensors, n);
  MatrixXd samples(static_cast<int>(100 * rate), n);
  for (int k = 0; k < samples.rows(); ++k) {
    samples.row(k) = noise.Next(1 / rate);
  }
  const MatrixXd thin = Thin(samples, rate);
  return (thin.colwise().squaredNorm() / thin.rows()).cwiseSqrt();
}

struct Run {
  MatrixXd residual;  // filtered, samples x joints, N m or N
  Motion motion;
};

Run Simulate(const BlindCase& blind, BlindLog log,
             const std::vector<ChosenEffect>& effects) {
  const ScenarioRun run = RunScenario(QuietScenario(blind, log, effects));
  const Motion motion = MotionOf(run.run.log);
  const MatrixXd model = ModelTorque(run.robot, Widths(blind), motion);
  return {Thin(run.run.log.tau - model, motion.rate), motion};
}

// Divides each joint's block of rows by its noise.
void Whiten(const VectorXd& spread, MatrixXd* columns) {
  const long rows = columns->rows() / spread.size();
  for (int j = 0; j < spread.size(); ++j) {
    columns->middleRows(j * rows, rows) /= spread[j];
  }
}

// What of `d` is left when `columns`, each with a standard normal prior and
// `known` about them from elsewhere, are fitted to it.
struct Left {
  VectorXd residual;
  double squared;  // with the prior's cost
};
Left FitAway(const MatrixXd& columns, const MatrixXd& known,
             const VectorXd& d) {
  MatrixXd information = columns.transpose() * columns;
  information.diagonal().array() += 1;
  if (known.size() > 0) information += known;
  const VectorXd gradient = columns.transpose() * d;
  const VectorXd x = information.ldlt().solve(gradient);
  return {d - columns * x, d.squaredNorm() - gradient.dot(x)};
}

EffectSize SizeOf(const MatrixXd& difference, const VectorXd& spread,
                  const MatrixXd& columns, const MatrixXd& known) {
  MatrixXd d =
      Eigen::Map<const MatrixXd>(difference.data(), difference.size(), 1);
  Whiten(spread, &d);
  const Left left = FitAway(columns, known, d);
  const long n = spread.size(), rows = difference.rows();
  EffectSize size;
  size.raw = d.norm() / std::sqrt(rows);
  size.enr = std::sqrt(std::max(0.0, left.squared) / rows);
  size.joint_enr.resize(n);
  for (int j = 0; j < n; ++j) {
    size.joint_enr[j] = left.residual.segment(j * rows, rows).norm();
  }
  if (size.joint_enr.norm() > 0) {
    size.joint_enr *= size.enr / size.joint_enr.norm();
  }
  return size;
}

}  // namespace

std::vector<EffectSize> EffectSizes(const BlindCase& blind) {
  std::vector<EffectSize> sizes;
  if (blind.effects.empty()) return sizes;
  const Run all = Simulate(blind, BlindLog::kTraining, blind.effects);
  const VectorXd spread = NoiseSpread(blind, all.motion.rate);
  MatrixXd columns = Absorbing(blind, all.motion);
  Whiten(spread, &columns);
  MatrixXd known;
  if (blind.has_reference) {
    const Run before = Simulate(blind, BlindLog::kReference, {});
    MatrixXd reference = Absorbing(blind, before.motion);
    Whiten(spread, &reference);
    known = reference.transpose() * reference;
  }
  for (size_t k = 0; k < blind.effects.size(); ++k) {
    std::vector<ChosenEffect> others = blind.effects;
    others.erase(others.begin() + k);
    const Run without = Simulate(blind, BlindLog::kTraining, others);
    sizes.push_back(
        SizeOf(all.residual - without.residual, spread, columns, known));
  }
  return sizes;
}

}  // namespace armcal
