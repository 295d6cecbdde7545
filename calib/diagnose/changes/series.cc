#include "calib/diagnose/changes/series.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/fleet/factor_calibration.h"
#include "calib/fleet/log_evidence.h"
#include "calib/fleet/log_reduction.h"
#include "calib/linear/factor_solution.h"
#include "calib/numerics/median.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// What an arm in a rich motion needs about a joint's torque for.
VectorXd TorqueUnits(const ModelParameters& parameters,
                     const Reduction& reduction) {
  double motion_hz = 0;
  for (const ReducedLog& log : reduction.logs) {
    motion_hz = std::max(motion_hz, log.motion_hz);
  }
  const ReferenceScale reference =
      MakeReference(parameters, reduction.model.rows, motion_hz,
                    FactorsOf(parameters, reduction));
  const VectorXd share =
      (reference.torque.cwiseInverse().asDiagonal() * reference.columns)
          .colwise()
          .norm();
  return share.unaryExpr([](double s) { return s > 0 ? 1 / s : 1; });
}

// Each joint's noise in each log, drawn to all logs' median.
MatrixXd NoiseOf(const Robot& robot, const Reduction& reduction) {
  const auto logs = static_cast<Eigen::Index>(reduction.logs.size());
  MatrixXd noise = MatrixXd::Zero(logs, robot.num_joints());
  VectorXd freedom = VectorXd::Zero(logs);
  for (Eigen::Index l = 0; l < logs; ++l) {
    const Reduction one{reduction.model, {reduction.logs[l]}};
    const LinearCalibration own = CalibrateFromFactors(robot, one);
    if (!own.solved) continue;
    noise.row(l) = own.noise.transpose();
    freedom[l] = NoiseFreedom(own, Inflations(one)[0]);
  }
  ShrinkNoise(freedom, &noise);
  return noise;
}

// root' root = information, without the directions that a log does not see.
struct Root {
  MatrixXd root;
  MatrixXd inverse;  // root * inverse = 1
};

Root RootOf(const MatrixXd& information) {
  constexpr double kSeen = 1e-10;  // of the largest
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(information);
  const VectorXd& values = eigen.eigenvalues();
  const Eigen::Index unseen =
      (values.array() <= kSeen * values.maxCoeff()).count();
  const Eigen::Index seen = values.size() - unseen;
  const VectorXd size = values.tail(seen).cwiseSqrt();
  const MatrixXd V = eigen.eigenvectors().rightCols(seen);
  return {size.asDiagonal() * V.transpose(),
          V * size.cwiseInverse().asDiagonal()};
}

// Adds what one log says.
void AddLog(const BlockTriangularFactor& factor, const std::vector<bool>& used,
            const VectorXd& noise, double inflation, LogSeries* series) {
  const auto joints = static_cast<int>(used.size());
  const auto& units = series->torque.asDiagonal();
  const UnitEvidence all = EvidenceOf(factor, used, noise, inflation);
  const Root root = RootOf(units * all.information * units);
  const VectorXd right = units * (all.right - all.information * series->pooled);
  series->equations.push_back({root.root, root.inverse.transpose() * right});
  for (int j = 0; j < joints; ++j) {
    std::vector<bool> one(joints, false);
    one[j] = used[j];
    const UnitEvidence own = EvidenceOf(factor, one, noise, inflation);
    series->by_scale[j].push_back(root.inverse.transpose() *
                                  (units * (own.information * series->pooled)));
  }
}

LogMotions MotionsOf(const Reduction& reduction, int joints) {
  const auto logs = static_cast<Eigen::Index>(reduction.logs.size());
  LogMotions motions;
  for (MatrixXd* sizes : {&motions.speed, &motions.travel, &motions.torque}) {
    sizes->setZero(logs, joints);
  }
  for (Eigen::Index l = 0; l < logs; ++l) {
    const ReducedLog& log = reduction.logs[l];
    motions.speed.row(l) = log.mean_square_speed.sqrt().transpose();
    motions.travel.row(l) = log.travel.transpose();
    for (int j = 0; j < joints; ++j) {
      const TriangularFactor& rows = log.factors[j];
      if (rows.rows() == 0) continue;
      motions.torque(l, j) = rows.Triangle().rightCols<1>().norm() /
                             std::sqrt(static_cast<double>(rows.rows()));
    }
  }
  return motions;
}

}  // namespace

int LogSeries::TermIndex(int joint, JointTerm term) const {
  for (int k = 0; k < parameters.size(); ++k) {
    const ModelParameter& p = parameters.parameters()[k];
    if (p.is_joint_term && p.block == joint && p.term == term) return k;
  }
  return -1;
}

MatrixXd LogSeries::Own(double inflation, MatrixXd* stddev) const {
  // A log that knows a parameter no better than to ten times a joint's torque
  // does not see it.
  constexpr double kUnseen = 10;
  MatrixXd own(pooled.size(), size());
  stddev->resize(pooled.size(), size());
  for (int l = 0; l < size(); ++l) {
    const MatrixXd& R = equations[l].root;
    MatrixXd information = R.transpose() * R / inflation;
    information.diagonal().array() += 1 / kUnseen / kUnseen;
    const Eigen::LLT<MatrixXd> factor(information);
    const VectorXd variance =
        factor.solve(MatrixXd::Identity(pooled.size(), pooled.size()))
            .diagonal();
    own.col(l) = pooled + torque.cwiseProduct(factor.solve(
                              R.transpose() * equations[l].right / inflation));
    for (Eigen::Index k = 0; k < pooled.size(); ++k) {
      const double s = std::sqrt(variance[k]);
      (*stddev)(k, l) = s < kUnseen / 2
                            ? torque[k] * s
                            : std::numeric_limits<double>::infinity();
    }
  }
  return own;
}

Reduction ReduceSeries(const Robot& robot, const LogReaderOptions& reading,
                       const LinearCalibrationOptions& options,
                       const std::vector<LogSource>& logs,
                       const TimeRange& crop) {
  Reduction reduction;
  reduction.model =
      ChooseReductionModel(robot, "", options, LogSet(logs, reading, crop));
  for (size_t l = 0; l < logs.size(); ++l) {
    if (options.progress) {
      options.progress("log by log", static_cast<double>(l) /
                                         static_cast<double>(logs.size()));
    }
    const LogSet one({logs[l]}, reading, crop);
    reduction.logs.push_back(ReduceLog(robot, reduction.model, {}, one));
  }
  return reduction;
}

LogSeries MakeSeries(const Robot& robot, const Reduction& reduction,
                     const std::vector<std::string>& logs) {
  const LinearCalibration pooled = CalibrateFromFactors(robot, reduction);
  const int joints = robot.num_joints();
  LogSeries series{pooled.parameters, logs, pooled.x, {}, {}, {}, {}, {}};
  series.by_scale.resize(joints);
  if (!pooled.solved) return series;
  series.torque = TorqueUnits(series.parameters, reduction);
  const MatrixXd noise = NoiseOf(robot, reduction);
  series.noise.resize(joints);
  for (int j = 0; j < joints; ++j) {
    series.noise[j] = Median({noise.col(j).begin(), noise.col(j).end()});
  }
  series.motions = MotionsOf(reduction, joints);
  const VectorXd inflations = Inflations(reduction);
  for (int l = 0; l < series.size(); ++l) {
    AddLog(FactorOf(series.parameters, reduction.logs[l]), pooled.used[l],
           noise.row(l), inflations[l], &series);
  }
  return series;
}

}  // namespace armcal
