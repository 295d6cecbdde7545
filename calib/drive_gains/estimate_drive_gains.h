#pragma once

#include "calib/drive_gains/drive_gains.h"
#include "calib/linear/calibration.h"
#include "calib/logs/log_set.h"
#include "model/robot/robot.h"

namespace armcal {

// Estimates every joint's torque per current from logs of the bare arm and logs
// of the same arm with a payload of known mass fixed to the last link, its
// centre of mass and inertia unknown (after Gautier and Briot, J. Dyn. Syst.
// Meas. Control 136, 2014, who take total least squares):
//   i_j = (U_j x + U_Lj x_L) / K_j + error,
// in weak form, errors in the currents. That the joints share parameters x (the
// mass matrix is symmetric: action is reaction) ties their gains to each
// other; the payload's mass alone sets their common scale, as the currents of a
// bare arm show only products of gain and inertia. Friction, offset and
// armature of a joint are its own: they neither help nor harm.
//
// Both log sets are read as currents with torque constants of 1. `payload` may
// be null: then nothing is identifiable, and `reason` says so. A gain counts as
// identifiable where its inverse is three standard deviations clear of 0. Of
// `options`, identification, solver and geometry are not looked at: the lengths
// are those of the file. Bad input throws InputError.
DriveGains EstimateDriveGains(const Robot& robot,
                              const LinearCalibrationOptions& options,
                              double payload_mass, const LogSet& bare,
                              const LogSet* payload);

}  // namespace armcal
