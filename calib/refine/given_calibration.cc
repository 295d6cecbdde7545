#include "calib/refine/given_calibration.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <vector>

#include "calib/numerics/json_value.h"
#include "calib/refine/calibration_reader.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The part of a written covariance that was seen: an empty cell was not.
struct SeenCovariance {
  std::vector<int> parameters;  // of the calibration's
  MatrixXd value;
};

MatrixXd ReadMatrix(const std::string& path, int size) {
  constexpr long kMaxBytes = 16L << 20;
  std::istringstream lines(ReadTextFile(path, kMaxBytes));
  std::string line, cell;
  std::getline(lines, line);  // names
  MatrixXd matrix(size, size);
  for (int r = 0; r < size; ++r) {
    const std::string row = "row " + std::to_string(r + 2);
    if (!std::getline(lines, line)) {
      throw InputError(path, row, "",
                       "expected " + std::to_string(size) +
                           " rows below the names, one per parameter");
    }
    std::istringstream cells(line + ",");
    for (int c = 0; c < size; ++c) {
      std::getline(cells, cell, ',');
      const auto number = cell.empty() ? std::nan("") : ParseNumber(cell);
      if (!cells || !number || std::isinf(*number)) {
        throw InputError(path, row + ", column " + std::to_string(c + 1),
                         OneLine(cell), "expected a number or nothing");
      }
      matrix(r, c) = *number;
    }
  }
  return matrix;
}

SeenCovariance ReadCovariance(const std::string& path, int size) {
  const MatrixXd whole = ReadMatrix(path, size);
  SeenCovariance seen;
  for (int k = 0; k < size; ++k) {
    if (whole(k, k) > 0) seen.parameters.push_back(k);
  }
  seen.value = whole(seen.parameters, seen.parameters);
  const VectorXd scale = seen.value.diagonal().cwiseSqrt();
  const MatrixXd difference = seen.value - seen.value.transpose();
  if ((difference.array().abs() <= 1e-9 * (scale * scale.transpose()).array())
          .all()) {
    return seen;
  }
  throw InputError(path, "", "", "expected a symmetric matrix below the names");
}

// Of the model's parameters, the one of each name of the calibration.
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
  const SeenCovariance seen = ReadCovariance(
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
