#include "calib/watch/model.h"

#include <algorithm>

#include "calib/numerics/json_value.h"
#include "calib/refine/calibration_reader.h"
#include "calib/refine/parameter_posterior.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

const std::vector<JointTerm> kWatchedTerms = {
    JointTerm::kViscous, JointTerm::kCoulomb, JointTerm::kOffset,
    JointTerm::kArmature};

ModelParameters ParametersOf(const CalibratedRobot& calibrated) {
  ModelParameters::Options options;
  options.joint_terms = kWatchedTerms;
  for (const CoulombTransition& transition : calibrated.transitions) {
    options.transitions.push_back({transition});
  }
  return ModelParameters(calibrated.robot, options);
}

// The parameters x are linear in the links' and joints' numbers, as the
// geometry is given: a difference over one unit is exact but for rounding.
VectorXd Difference(const ModelParameters& model, const Robot& robot,
                    const ParameterPosterior::Parameter& parameter) {
  Robot changed = robot;
  Link& link = changed.links[parameter.link];
  if (parameter.term) {
    *TermOf(*parameter.term, &link.joint) += 1;
  } else {
    Vector10d V = link.inertial.ToVector();
    V[parameter.inertial] += 1;
    link.inertial = InertialParameters::FromVector(V);
  }
  return model.Values(changed) - model.Values(robot);
}

void ReadRms(const std::string& path, WatchModel* model) {
  const nlohmann::json parsed = ReadJson(path);
  const std::vector<JsonValue> joints =
      JsonValue(path, "", parsed).At("joints").Entries();
  const int n = model->num_joints();
  model->residual_rms.resize(n);
  model->torque_rms.resize(n);
  for (int j = 0; j < n; ++j) {
    model->torque_rms[j] = joints[j].At("torque_rms").Number();
    // A log without noise leaves nothing, and rounding errors are no weight.
    model->residual_rms[j] = std::max(joints[j].At("residual_rms").Number(),
                                      1e-6 * model->torque_rms[j] + 1e-12);
  }
}

}  // namespace

WatchModel ReadWatchModel(const Robot& nominal, const std::string& path) {
  const std::string file = CalibrationFile(path);
  const CalibratedRobot calibrated = ReadCalibration(file, nominal);
  const ParameterPosterior posterior = ReadParameterPosterior(file, nominal);
  WatchModel model{calibrated.robot, ParametersOf(calibrated), {}, {}, {}, {}};
  model.x = model.parameters.Values(calibrated.robot);
  MatrixXd J(model.size(), posterior.parameters.size());
  for (size_t k = 0; k < posterior.parameters.size(); ++k) {
    J.col(k) =
        Difference(model.parameters, calibrated.robot, posterior.parameters[k]);
  }
  model.covariance = J * posterior.covariance * J.transpose();
  ReadRms(file, &model);
  return model;
}

MatrixXd PayloadColumns(const WatchModel& model) {
  MatrixXd columns(model.size(), 10);
  for (int k = 0; k < 10; ++k) {
    columns.col(k) = Difference(model.parameters, model.robot,
                                {model.num_joints() - 1, {}, k});
  }
  return columns;
}

MatrixXd CovarianceWithSlowLaws(const WatchModel& model) {
  constexpr double kShare = .1;
  const int n = model.num_joints(), p = model.size();
  MatrixXd covariance = MatrixXd::Zero(model.columns(), model.columns());
  covariance.topLeftCorner(p, p) = model.covariance;
  for (int k = 0; k < WatchModel::kSlowLaws * n; ++k) {
    const double size = kShare * model.robot.links[k % n].joint.coulomb;
    covariance(p + k, p + k) = size * size;
  }
  return covariance;
}

int TermColumn(const ModelParameters& parameters, int j, JointTerm term) {
  for (int k = 0; k < parameters.size(); ++k) {
    const ModelParameter& p = parameters.parameters()[k];
    if (p.is_joint_term && p.block == j && p.term == term) return k;
  }
  return -1;
}

}  // namespace armcal
