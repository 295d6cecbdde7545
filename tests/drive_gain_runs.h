#pragma once

// Simulated arms with drives whose torque constants are known, with and without
// a payload, and what EstimateDriveGains makes of their currents.

#include <random>
#include <string>
#include <vector>

#include "calib/drive_gains.h"
#include "tests/nonlinear_runs.h"

namespace armcal {

struct DrivenArm {
  SimulatedArm arm;
  InertialParameters payload;  // about the last link's frame
  Eigen::VectorXd K;           // N m/A or N/A
};

DrivenArm Drive(const SimulatedArm& arm, std::mt19937_64* random);

// Torque constants from 0.02 to 20.
DrivenArm MakeDrivenArm(const std::string& name, std::mt19937_64* random);

Robot Loaded(const DrivenArm& driven);

// Torques divided by the torque constants.
Log ToCurrents(Log log, const Eigen::VectorXd& K);

// Noise of `current` times each joint's rms current, and of `encoder` rad or m.
void AddDriveNoise(double current, double encoder, std::mt19937_64* random,
                   Log* log);

// A CSV with currents i1 .. in place of torques.
std::string CurrentCsv(const Log& log);

LinearCalibrationOptions DriveOptions();

LinearCalibrationOptions ExactOptions();

// Currents of the bare arm and of the arm with its payload, without noise.
struct Currents {
  Currents(const DrivenArm& driven, double duration, std::mt19937_64* random);
  Log bare, loaded;
};

// EstimateDriveGains as a user meets it, on logs written to files. `loaded` may
// be empty.
DriveGains EstimateFromLogs(const Robot& robot, double payload_mass,
                            const std::vector<Log>& bare,
                            const std::vector<Log>& loaded,
                            const LinearCalibrationOptions& options);

}  // namespace armcal
