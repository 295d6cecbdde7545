#include "calib/verify/log_torques.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "calib/logs/drawn_torques.h"
#include "calib/logs/torque_residual.h"
#include "calib/numerics/append_rows.h"
#include "calib/verify/arm_engine.h"
#include "calib/verify/arm_states.h"
#include "calib/verify/largest_ratio.h"
#include "model/dynamics/batch_torque_replay.h"
#include "model/plant/simbody_arm.h"
#include "problems/identification_rows.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kTorqueSamples = 20'000;

// Torques that are predicted of one robot, samples in rows, joints in columns.
struct LogPrediction {
  MatrixXd simbody;  // NaN where Simbody refuses the robot
  MatrixXd own;
};

std::unique_ptr<SimbodyArm> SimbodyOrNull(const Robot& robot) {
  if (!MakeArmEngine(robot).is_simbody) return nullptr;
  return std::make_unique<SimbodyArm>(robot);
}

// Predicts a robot's torques along logs, twice: Simbody's inverse dynamics of
// its links, with
//   viscous qd + coulomb c + offset + armature qdd
// added joint by joint, and the regressor times its model parameters.
class LogPredictor {
 public:
  LogPredictor(const Robot& robot,
               const std::vector<CoulombTransition>& transitions)
      : robot_(robot),
        transitions_(transitions),
        model_(TraceRobot("", robot, transitions)),
        arm_(SimbodyOrNull(robot)) {}

  // The friction of a log begins anew.
  void StartLog() {
    coulomb_ = std::make_unique<CoulombStates>(CoulombColumns(transitions_));
    regressor_ = std::make_unique<MotionRegressor>(model_.parameters);
  }

  // The chosen rows of a trajectory.
  LogPrediction Predict(const Trajectory& t, const std::vector<int>& rows) {
    const MatrixXd c = coulomb_->FollowTorque(t);
    regressor_->Enter(t);
    const MatrixXd own = PredictTorques(t, model_.x, *regressor_);
    LogPrediction predicted;
    predicted.simbody.resize(rows.size(), t.num_joints());
    predicted.own.resize(rows.size(), t.num_joints());
    for (size_t k = 0; k < rows.size(); ++k) {
      predicted.simbody.row(k) = InSimbody(t, rows[k], c.row(rows[k]));
      predicted.own.row(k) = own.row(rows[k]);
    }
    return predicted;
  }

 private:
  VectorXd InSimbody(const Trajectory& t, int row, const VectorXd& c) {
    if (arm_ == nullptr) return VectorXd::Constant(t.num_joints(), kNaN);
    VectorXd tau =
        arm_->InverseDynamics(t.q.row(row), t.qd.row(row), t.qdd.row(row));
    for (int j = 0; j < tau.size(); ++j) {
      const Joint& joint = robot_.links[j].joint;
      tau[j] += joint.viscous * t.qd(row, j) + joint.coulomb * c[j] +
                joint.offset + joint.armature * t.qdd(row, j);
    }
    return tau;
  }

  const Robot& robot_;
  std::vector<CoulombTransition> transitions_;
  TracedModel model_;
  std::unique_ptr<SimbodyArm> arm_;
  std::unique_ptr<CoulombStates> coulomb_;
  std::unique_ptr<MotionRegressor> regressor_;
};

double ColumnRms(const MatrixXd& x, int joint) {
  return std::sqrt(x.col(joint).squaredNorm() / static_cast<double>(x.rows()));
}

double LargestDifference(const LogPrediction& predicted) {
  const double floor =
      kSmallTorque * predicted.simbody.rowwise().norm().maxCoeff();
  LargestRatio largest;
  for (Eigen::Index k = 0; k < predicted.own.rows(); ++k) {
    const auto simbody = predicted.simbody.row(k);
    largest.Add((predicted.own.row(k) - simbody).norm(),
                std::max(floor, simbody.norm()));
  }
  return largest.value();
}

}  // namespace

LogTorques CompareLogTorques(const Robot& file,
                             const CalibratedRobot* calibrated,
                             const Progress& progress,
                             const PreparedLogs& logs) {
  std::vector<CoulombTransition> transitions(file.num_joints());
  if (calibrated != nullptr) transitions = calibrated->transitions;
  std::vector<LogPredictor> predictors;
  predictors.emplace_back(file, transitions);
  if (calibrated != nullptr) {
    predictors.emplace_back(calibrated->robot, transitions);
  }
  MatrixXd recorded;
  std::vector<LogPrediction> predicted(predictors.size());
  EvenSamples even(kTorqueSamples, logs);
  int last_log = -1;
  logs.ForEach("torques", progress, [&](int log, const Trajectory& t) {
    const std::vector<int> rows = even.In(log, t);
    AppendRows(t.tau(rows, Eigen::all), &recorded);
    for (size_t m = 0; m < predictors.size(); ++m) {
      if (log != last_log) predictors[m].StartLog();
      const LogPrediction part = predictors[m].Predict(t, rows);
      AppendRows(part.simbody, &predicted[m].simbody);
      AppendRows(part.own, &predicted[m].own);
    }
    last_log = log;
  });
  LogTorques result;
  result.samples = static_cast<int>(recorded.rows());
  if (result.samples == 0) return result;
  result.max_rel = LargestDifference(predicted.back());
  for (int j = 0; j < file.num_joints(); ++j) {
    const Joint& joint = file.links[j].joint;
    JointLogTorque torque{joint.name, EffortUnit(joint.type)};
    torque.recorded_rms = ColumnRms(recorded, j);
    torque.before_rms = ColumnRms(recorded - predicted[0].simbody, j);
    if (calibrated != nullptr) {
      torque.after_rms = ColumnRms(recorded - predicted[1].simbody, j);
    }
    result.joints.push_back(torque);
  }
  return result;
}

}  // namespace armcal
