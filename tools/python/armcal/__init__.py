"""armcal: calibrates a robot arm's dynamics from its logs and says why its
simulation differs from the real machine.

    robot = armcal.read_robot("arm.urdf")
    result = armcal.calibrate(robot, "log.csv", validate="other.csv")
    print(result.report())

Units are SI and radians. Bad input raises InputError, a wrong option
UsageError; both are ValueErrors.
"""

from armcal import plot
from armcal._armcal import (INERTIAL_NAMES, INERTIAL_UNITS, InputError,
                            PredictedLog, Robot, UsageError, __version__,
                            options, read_robot)
from armcal.commands import (calibrate, compare, diagnose, excite, inspect,
                             merge, reduce, simulate, verify)
from armcal.log import Log, read_log
from armcal.robot import from_arrays as _from_arrays  # Robot.from_arrays
from armcal.results import (Calibration, Comparison, Diagnosis, Estimates,
                            Excitation, Inspection, Merger, Reduction, Result,
                            Simulation, Verification)

__all__ = [
    "Calibration", "Comparison", "Diagnosis", "Estimates", "Excitation", "INERTIAL_NAMES",
    "INERTIAL_UNITS", "InputError", "Inspection", "Log", "Merger",
    "PredictedLog", "Reduction", "Result", "Robot", "Simulation", "UsageError", "Verification",
    "__version__", "calibrate", "compare", "diagnose", "excite", "inspect",
    "merge", "options", "plot", "read_log", "read_robot", "reduce", "simulate", "verify",
]
