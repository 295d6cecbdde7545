"""figaroh_calibration.py URDF TRAIN.csv HELD_OUT.csv: FIGAROH's own way.

Its regressor (a call of Pinocchio per sample), its elimination of columns, its
double QR to base parameters, its standard deviations. Prints a line of JSON:
seconds of CPU per stage and the held-out residual.
"""

import json
import logging
import sys

import numpy as np
import pandas
from figaroh.identification.identification_tools import relative_stdev
from figaroh.identification.parameter import (
    add_standard_additional_parameters, get_standard_parameters)
from figaroh.tools.qrdecomposition import QRDecomposer
from figaroh.tools.regressor import (
    build_regressor_basic, build_regressor_reduced, get_index_eliminate)
from figaroh.tools.robot import Robot

from log_columns import Stages, relative_residual, split

CONFIG = {"is_joint_torques": True, "has_friction": True, "act_idxv": range(6),
          "has_actuator_inertia": True, "has_joint_offset": True}


def main():
    logging.disable(logging.WARNING)
    urdf, train, held_out = sys.argv[1:]
    values = {}
    stages = Stages("Figaroh", values)
    robot = Robot(urdf, package_dirs="")
    _, q, qd, qdd, tau = split(pandas.read_csv(train).to_numpy())
    stages.took("read")
    W = build_regressor_basic(robot, q, qd, qdd, CONFIG)
    stages.took("regressor")
    names = get_standard_parameters(robot.model, CONFIG)
    names.update(add_standard_additional_parameters(robot.model, CONFIG))
    eliminated, kept = get_index_eliminate(W, names)
    W = build_regressor_reduced(W, eliminated)
    stacked = tau.T.ravel()  # its regressor has all samples of joint 1 first
    decomposer = QRDecomposer()
    W_base, _, _, phi = decomposer.double_decomposition(stacked, W, kept)
    relative_stdev(W_base, phi, stacked)
    stages.took("solve")
    values["Figaroh/base_parameters"] = len(phi)

    _, q, qd, qdd, tau = split(pandas.read_csv(held_out).to_numpy())
    W = build_regressor_reduced(
        build_regressor_basic(robot, q, qd, qdd, CONFIG), eliminated)
    predicted = W[:, decomposer.get_base_indices()] @ phi
    values["Figaroh/held_out"] = relative_residual(tau.T.ravel(), predicted)
    print(json.dumps({"values": values}))


if __name__ == "__main__":
    main()
