#!/usr/bin/env python3
"""Drake reads the robot files that armcal writes.

    pip install drake==1.51.1
    python3 tests/peers/check_drake.py robot.urdf robot.sdf ..

Prints, for each file, how many degrees of freedom its arm has beside a free base and how
many actuators; exit code 1 where Drake refuses one. Whether torques are the same,
compare_engines.py tells."""

import sys

from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import MultibodyPlant

FREE_BASE = 6  # of a URDF, which says nothing of what holds the arm


def degrees_of_freedom(path):
    plant = MultibodyPlant(0.)
    Parser(plant).AddModels(path)
    plant.Finalize()
    free = len(plant.GetFloatingBaseBodies())
    return plant.num_velocities() - FREE_BASE * free, plant.num_actuators()


def main():
    refused = False
    for path in sys.argv[1:]:
        try:
            free, actuators = degrees_of_freedom(path)
            print(f"{path}: {free} degrees of freedom, {actuators} actuators")
        except RuntimeError as error:
            refused = True
            print(f"{path}: refused: {error}")
    sys.exit(refused)


if __name__ == "__main__":
    main()
