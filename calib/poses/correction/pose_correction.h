#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "calib/poses/correction/correction_check.h"
#include "calib/poses/correction/correction_table.h"

namespace armcal {

// What a controller, which has the robot file's kinematics, can do about the
// geometry that poses show.
struct PoseCorrection {
  ActualArm arm;
  CorrectionTable table;
  CorrectionErrors errors;
  std::optional<CorrectionCheck> check;  // on poses that were held out
};

// Over the range of the measured joint positions. `held_out`: null: none.
PoseCorrection CorrectFromPoses(const PoseMeasurements& measured,
                                const PoseModel& model,
                                const PoseMeasurements* held_out);

// A table is as coarse as its rows are few for the joints' ranges: whether it
// does more good than harm.
bool TableHelps(const CorrectionErrors& errors);

// `held_out`: m rms by which poses that took no part in the fit miss the arm
// that was found, beside which the figures of the correction stand.
std::string CorrectionText(const PoseCorrection& correction, double held_out);
nlohmann::json CorrectionJson(const PoseCorrection& correction);

}  // namespace armcal
