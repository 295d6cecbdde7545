"""The program armcal, which lies beside this file in wheels: pip puts the script
`armcal` on the PATH, which is main(). A package of its own, so that neither NumPy
nor the module is loaded before the program starts."""

import os
import sys
from typing import NoReturn


def main() -> NoReturn:
    """Becomes the program, with the arguments, the exit code and the signals."""
    folder = os.path.dirname(os.path.abspath(__file__))
    os.execv(os.path.join(folder, "armcal"), sys.argv)
