#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calib/refine/nonlinear_calibration.h"

namespace armcal {

// Of two parameters (indices) that the data determine.
struct Correlation {
  size_t a, b;
  double value;
};
// Those of 0.9 and more in size, the strongest first.
std::vector<Correlation> StrongCorrelations(const NonlinearCalibration& result);

// The robot for a simulator on a terminal: links with masses and centres
// beside the file's, what joints add, residuals, and what stayed open.
std::string NonlinearReport(const Robot& nominal,
                            const NonlinearCalibration& result);

// Sets `parameters` and `parameters_covariance` of a calibration.
void AddParameters(const NonlinearCalibration& result,
                   nlohmann::json* calibration);

// Makes `calibration` (of ToJson) describe the refined estimate: its joints and
// parameters, the linear estimate's under "linear".
void AddRefined(const NonlinearCalibration& result,
                nlohmann::json* calibration);

// parameters_covariance.csv: a header of the parameters' names, the matrix;
// empty fields where a parameter is not identifiable.
std::string ParametersCovarianceCsv(const NonlinearCalibration& result);

// parameters_posterior.csv: the same of all parameters, those that only the
// robot file's prior tells as well; rows of what is held are 0. Their sums may
// be known far better than each of them alone, which this has and the other
// file has not.
std::string ParametersPosteriorCsv(const NonlinearCalibration& result);

}  // namespace armcal
