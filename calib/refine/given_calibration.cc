#include "calib/refine/given_calibration.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <filesystem>
#include <map>
#include <vector>

#include "calib/numerics/json_value.h"
#include "calib/refine/calibration_reader.h"
#include "calib/refine/covariance_file.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The part of a written covariance that was seen: an empty cell was not.
struct SeenCovariance {
  std::vector<int> parameters;  // of the calibration's
  MatrixXd value;
};

SeenCovariance ReadSeenCovariance(const std::string& path, int size) {
  const MatrixXd whole = ReadCovarianceCsv(path, size);
  SeenCovariance seen;
  for (int k = 0; k < size; ++k) {
    if (whole(k, k) > 0) seen.parameters.push_back(k);
  }
  seen.value = whole(seen.parameters, seen.parameters);
  return seen;
}

// For each wanted parameter of the calibration, the model's of the same name.
std::vector<int> Places(const JsonValue& names, const std::vector<int>& wanted,
                        const ModelParameters& model) {
  std::map<std::string, int> place;
  for (int k = 0; k < model.size(); ++k) {
    place[model.parameters()[k].name] = k;
  }
  const std::vector<JsonValue> entries = names.Entries();
  std::vector<int> places;
  for (const int k : wanted) {
    const auto found = place.find(entries[k].Text());
    if (found == place.end()) {
      entries[k].Refuse(
          "expected a parameter of the model that the motion is for: give the "
          "logs of this calibration instead");
    }
    places.push_back(found->second);
  }
  return places;
}

}  // namespace

// The information is the inverse of the covariance of what was seen, C = D K D
// with correlations K and deviations D: D^-1 K^-1 D^-1. K is what is factored,
// as variances of inertias and of friction may be many orders apart.
GivenCalibration ReadGivenCalibration(const std::string& path,
                                      const Robot& robot,
                                      const ModelParameters& model) {
  const nlohmann::json text = ReadJson(path);
  const JsonValue root(path, "", text);
  ExpectCalibrationOf(robot, root);
  GivenCalibration given{VectorXd(robot.num_joints()),
                         MatrixXd::Zero(model.size(), model.size())};
  const std::vector<JsonValue> joints = root.At("joints").Entries();
  for (int j = 0; j < robot.num_joints(); ++j) {
    const JsonValue density = joints[j].At("noise_density");
    given.density[j] = density.Number();
    if (given.density[j] <= 0) density.Refuse("expected more than 0");
  }
  const JsonValue covariance = root.At("covariance");
  const JsonValue names = covariance.At("names");
  const std::filesystem::path file = covariance.At("file").Text();
  const SeenCovariance seen = ReadSeenCovariance(
      std::filesystem::path(path).replace_filename(file.filename()),
      static_cast<int>(names.Entries().size()));
  const std::vector<int> places = Places(names, seen.parameters, model);
  const VectorXd unit = seen.value.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LLT<MatrixXd> correlation(unit.asDiagonal() * seen.value *
                                         unit.asDiagonal());
  const Eigen::Index m = seen.value.rows();
  const MatrixXd inverse = correlation.solve(MatrixXd::Identity(m, m));
  if (correlation.info() != Eigen::Success || !inverse.allFinite()) {
    covariance.At("file").Refuse("expected a positive definite matrix in it");
  }
  given.A(places, places) = unit.asDiagonal() * inverse * unit.asDiagonal();
  return given;
}

}  // namespace armcal
