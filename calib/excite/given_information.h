#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/linear/calibration.h"
#include "calib/logs/prepared_logs.h"
#include "model/dynamics/model_parameters.h"
#include "model/robot/robot.h"

namespace armcal {

// What a stretch of a log's motion tells about the parameters of a model.
struct SegmentInformation {
  int log = 0;
  TimeRange range;    // s since the log's first row
  Eigen::MatrixXd A;  // m x m
};
// Of every stretch of `segment_s` s in which something moves, with errors of
// that density.
std::vector<SegmentInformation> InformationBySegment(
    const Robot& robot, const ModelParameters& model,
    const Eigen::VectorXd& density, double segment_s, const Progress& progress,
    const PreparedLogs& logs);

// What the motions of logs tell about the parameters of `model` (m x m) where
// torques have such errors; standstill tells nothing.
Eigen::MatrixXd GivenInformation(const Robot& robot,
                                 const ModelParameters& model,
                                 const Eigen::VectorXd& density,
                                 const Progress& progress,
                                 const PreparedLogs& logs);

}  // namespace armcal
