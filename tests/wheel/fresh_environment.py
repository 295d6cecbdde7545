"""The wheel of a build, as setup.py makes it, in an environment of its own.

    fresh_environment.py --build=build --work=FOLDER

Needs no network: the wheel is not yet one that carries libraries
(tools/wheel.sh), and NumPy is this machine's. Program and module have to write what
the build's program does, and exit codes to come through.
"""

import argparse
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys

import first_results

ROOT = pathlib.Path(__file__).resolve().parents[2]


def run(*command, **options):
    return subprocess.run([str(part) for part in command], check=True, text=True,
                          stdout=subprocess.PIPE, **options).stdout


def install(build, work):
    """Returns the folder of the environment's programs."""
    run(sys.executable, "-m", "venv", "--system-site-packages", work / "venv")
    programs = work / "venv" / "bin"
    pip = (programs / "python", "-m", "pip", "--quiet",
           "--disable-pip-version-check")
    run(*pip, "wheel", "--no-index", "--no-deps", "--no-build-isolation",
        "--wheel-dir", work, ROOT, env={**os.environ, "ARMCAL_BUILD": str(build)})
    wheel, = work.glob("*.whl")
    run(*pip, "install", "--no-index", "--no-deps", wheel)
    return programs


def main():
    parser = argparse.ArgumentParser()
    for name in ("build", "work"):
        parser.add_argument("--" + name, type=pathlib.Path, required=True)
    options = parser.parse_args()
    missing = [name for name in ("ensurepip", "setuptools", "wheel", "numpy")
               if importlib.util.find_spec(name) is None]
    if missing:
        print("SKIPPED: this Python has no", *missing)
        sys.exit(77)
    work = options.work
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    expected = first_results.calibrated(work / "build", options.build / "armcal")
    programs = install(options.build, work)

    found = first_results.calibrated(work / "program", programs / "armcal")
    first_results.compare(found, expected, "the wheel's program")
    shutil.copytree(first_results.DATA, work / "module" / "scara")
    (work / "first.py").write_text(first_results.MODULE)
    run(programs / "python", "-B", work / "first.py", cwd=work / "module")
    first_results.compare(work / "module", expected, "the wheel's module")
    code = subprocess.run([programs / "armcal", "calibrate"],
                          stderr=subprocess.DEVNULL).returncode
    assert code == 2, f"exit code {code} of a wrong call, expected 2"


if __name__ == "__main__":
    main()
