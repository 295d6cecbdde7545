#include "calib/refine/parameter_posterior.h"

#include <cmath>
#include <filesystem>
#include <map>

#include "calib/numerics/json_value.h"
#include "calib/refine/calibration_reader.h"
#include "calib/refine/covariance_file.h"

namespace armcal {
namespace {

using Parameter = ParameterPosterior::Parameter;

constexpr JointTerm kEstimatedTerms[] = {
    JointTerm::kViscous, JointTerm::kCoulomb, JointTerm::kOffset,
    JointTerm::kArmature};

// A robot's parameters by the names that calibrations give them.
std::map<std::string, Parameter> ParametersOf(const Robot& robot) {
  std::map<std::string, Parameter> parameters;
  for (int i = 0; i < robot.num_joints(); ++i) {
    const Link& link = robot.links[i];
    for (int k = 0; k < 10; ++k) {
      parameters[link.name + "." + InertialName(k)] = {i, std::nullopt, k};
    }
    for (const JointTerm term : kEstimatedTerms) {
      parameters[link.joint.name + "." + JointTermName(term)] = {i, term};
    }
  }
  return parameters;
}

}  // namespace

double ParameterPosterior::Stddev(int joint, JointTerm term) const {
  for (size_t k = 0; k < parameters.size(); ++k) {
    if (parameters[k].link != joint || parameters[k].term != term) continue;
    return std::sqrt(covariance(k, k));
  }
  return 0;
}

std::string CalibrationFile(const std::string& path) {
  std::error_code error;
  const auto inside = std::filesystem::path(path) / "calibration.json";
  return std::filesystem::exists(inside, error) ? inside.string() : path;
}

// Rows and columns of what is not the robot's links and terms are left out:
// what remains of a Gaussian's covariance is that of its marginal.
ParameterPosterior ReadParameterPosterior(const std::string& path,
                                          const Robot& robot) {
  const nlohmann::json text = ReadJson(path);
  const JsonValue root(path, "", text);
  ExpectCalibrationOf(robot, root);
  const JsonValue covariance = root.At("parameters_covariance");
  const std::vector<JsonValue> names = covariance.At("names").Entries();
  if (!covariance.Has("posterior_file")) {
    covariance.Refuse(
        "expected a posterior_file in it, the covariance of all parameters: "
        "calibrate again with this version");
  }
  const JsonValue file = covariance.At("posterior_file");
  const std::filesystem::path name = file.Text();
  const Eigen::MatrixXd whole = ReadCovarianceCsv(
      std::filesystem::path(path).replace_filename(name.filename()),
      static_cast<int>(names.size()));
  const std::map<std::string, Parameter> known = ParametersOf(robot);
  ParameterPosterior posterior;
  std::vector<int> estimated;
  for (int k = 0; k < static_cast<int>(names.size()); ++k) {
    const auto parameter = known.find(names[k].Text());
    if (parameter == known.end() || !(whole(k, k) > 0)) continue;
    estimated.push_back(k);
    posterior.parameters.push_back(parameter->second);
  }
  posterior.covariance = whole(estimated, estimated);
  if (estimated.empty() || !posterior.covariance.allFinite()) {
    file.Refuse("expected the covariance of the estimated parameters in it");
  }
  return posterior;
}

}  // namespace armcal
