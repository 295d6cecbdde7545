#include "tests/blind/effect_size.h"

#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>

#include "model/inverse_dynamics.h"
#include "model/low_pass.h"
#include "tests/blind/residual_noise.h"

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
  motion.q =
      ZeroPhaseLowPass(log.q, motion.rate, kBandwidthHz, Ends::kExtrapolate);
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

struct Run {
  MatrixXd residual;  // filtered, samples x joints, N m or N
  Motion motion;
};

// Nothing where the arm does not follow.
std::optional<Run> Simulate(const BlindCase& blind, const Scenario& scenario) {
  const ScenarioRun run = RunScenario(scenario);
  if (!Follows(run.run)) return std::nullopt;
  const Motion motion = MotionOf(run.run.log);
  const MatrixXd model = ModelTorque(run.robot, Widths(blind), motion);
  return Run{Thin(run.run.log.tau - model, motion.rate), motion};
}

// Of the residual: torque noise, and what encoders put into it by way of the
// controller and the model.
std::vector<ResidualNoise> NoiseOf(const MatrixXd& noisy,
                                   const MatrixXd& quiet) {
  std::vector<ResidualNoise> noise;
  for (int j = 0; j < noisy.cols(); ++j) {
    noise.push_back(ResidualNoise::Fit(noisy.col(j) - quiet.col(j)));
  }
  return noise;
}

// Each joint's block of rows in units of its innovations.
MatrixXd Whitened(const std::vector<ResidualNoise>& noise,
                  const MatrixXd& columns) {
  const long n = noise.size(), rows = columns.rows() / n;
  const long left = rows - ResidualNoise::kOrder;
  MatrixXd white(left * n, columns.cols());
  for (int j = 0; j < n; ++j) {
    white.middleRows(j * left, left) =
        noise[j].Whiten(columns.middleRows(j * rows, rows));
  }
  return white;
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

EffectSize SizeOf(const VectorXd& d, long n, const MatrixXd& columns,
                  const MatrixXd& known) {
  CHECK_EQ(d.size(), columns.rows());
  const Left left = FitAway(columns, known, d);
  const long rows = d.size() / n;
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

MatrixXd Stacked(const MatrixXd& x) {
  return Eigen::Map<const MatrixXd>(x.data(), x.size(), 1);
}

// What a log of the robot before its effects tells of its parameters, as
// information; empty where there is none.
MatrixXd KnownBefore(const BlindCase& blind,
                     const std::vector<ResidualNoise>& noise) {
  if (!blind.has_reference) return {};
  const auto before =
      Simulate(blind, QuietScenario(blind, BlindLog::kReference, {}));
  CHECK(before) << "an arm without effects follows";
  const MatrixXd columns = Whitened(noise, Absorbing(blind, before->motion));
  return columns.transpose() * columns;
}

// With noise, but sampled as without: their difference is taken by sample.
Scenario NoisyScenario(const BlindCase& blind) {
  Scenario scenario = BlindScenario(blind, BlindLog::kTraining, blind.effects);
  scenario.loop.sensors.jitter = 0;
  scenario.loop.sensors.lost_share = 0;
  return scenario;
}

}  // namespace

std::optional<std::vector<EffectSize>> EffectSizes(const BlindCase& blind) {
  std::vector<EffectSize> sizes;
  if (blind.effects.empty()) return sizes;
  const auto all =
      Simulate(blind, QuietScenario(blind, BlindLog::kTraining, blind.effects));
  const auto noisy = Simulate(blind, NoisyScenario(blind));
  if (!all || !noisy) return std::nullopt;
  const auto noise = NoiseOf(noisy->residual, all->residual);
  const MatrixXd columns = Whitened(noise, Absorbing(blind, all->motion));
  const MatrixXd known = KnownBefore(blind, noise);
  for (size_t k = 0; k < blind.effects.size(); ++k) {
    std::vector<ChosenEffect> others = blind.effects;
    others.erase(others.begin() + k);
    const auto without =
        Simulate(blind, QuietScenario(blind, BlindLog::kTraining, others));
    if (!without) return std::nullopt;
    const VectorXd d =
        Whitened(noise, Stacked(all->residual - without->residual));
    sizes.push_back(SizeOf(d, noise.size(), columns, known));
  }
  return sizes;
}

}  // namespace armcal
