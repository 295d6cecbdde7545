"""Installs armcal on bare systems, calibrates, and compares with the build.

    bare_systems.py --armcal=build/armcal --wheels=build/wheels --deb=FILE
                    --systems=FOLDER

As root, with debootstrap and a network. On Debian 12 and 13 of nothing but
Python, pip installs the wheel, with NumPy from PyPI, and the program and the module
make a first calibration: within a minute, and all files of the results are byte for
byte what the build writes. So does the program of the wheel for any Python, and
on Debian 12 that of the Debian package. Without one of the wheel's libraries
nothing runs, or it would not be the wheel's libraries that were tried. FOLDER keeps
the bare systems.
"""

import argparse
import pathlib
import shutil
import tempfile
import time

import first_results
from bare_root import BareRoot
from first_results import MODULE, PROGRAM

LIMIT = 60  # seconds
# What a wheel may take from the system (PEP 600).
OF_THE_SYSTEM = {"ld-linux-x86-64.so.2", "libc.so.6", "libgcc_s.so.1",
                 "libm.so.6", "libpthread.so.0", "libresolv.so.2",
                 "libstdc++.so.6", "libz.so.1", "linux-vdso.so.1"}
INSTALL = ("python3 -m venv {venv} && {venv}/bin/pip install --quiet "
           "--disable-pip-version-check wheels/{wheel}")


def calibrate(system, name, command, expected):
    folder = system.path("/root") / name
    shutil.copytree(first_results.DATA, folder / "scara")
    system.run(f"cd {name}; {command}")
    first_results.compare(folder, expected, f"{system.root.name}, {name}")


def tell(system, what, start):
    seconds = time.monotonic() - start
    print(f"{system}: {what}: {seconds:.1f} s, results as the build's, "
          "byte for byte", flush=True)
    if seconds > LIMIT:
        raise SystemExit(f"{system}: {what}: expected at most {LIMIT} s")


def check_libraries(system, venv):
    """All libraries are the wheel's own but a few; without one it does not run."""
    package = f"{venv}/lib/python3*/site-packages"
    libraries = system.run(f"ldd {package}/armcal_program/armcal")
    for line in libraries.splitlines():
        name = pathlib.Path(line.split()[0]).name
        if "site-packages" not in line and name not in OF_THE_SYSTEM:
            raise SystemExit(f"{system.root.name}: {line.strip()} is not the wheel's")
    system.run(f"mv {package}/armcal.libs/libglog-* .")
    for without in (f"{venv}/bin/armcal --version",
                    f"{venv}/bin/python -c 'import armcal'"):
        said = system.run(f"{without} || echo it failed", check=False)
        if "libglog" not in said or "it failed" not in said:
            raise SystemExit(f"{system.root.name}: {without} runs without libglog")


def try_wheels(suite, options, expected):
    with BareRoot(suite, options.systems) as system:
        shutil.copytree(options.wheels, system.path("/root/wheels"))
        python = system.run("python3 -c 'import sys; "
                            "print(\"cp%d%d\" % sys.version_info[:2])'").strip()
        start = time.monotonic()
        system.run(INSTALL.format(venv="venv", wheel=f"armcal-*-{python}-*.whl"))
        program = PROGRAM.format(armcal="../venv/bin/armcal")
        calibrate(system, "program", program, expected)
        tell(suite, "pip install and a calibration by the program", start)
        system.path("/root/first.py").write_text(MODULE)
        calibrate(system, "module", "../venv/bin/python ../first.py", expected)
        tell(suite, "pip install and calibrations by program and module", start)
        start = time.monotonic()
        system.run(INSTALL.format(venv="any", wheel="armcal-*-py3-none-*.whl"))
        program = PROGRAM.format(armcal="../any/bin/armcal")
        calibrate(system, "any_python", program, expected)
        tell(suite, "the wheel for any Python", start)
        said = system.run("any/bin/python -c 'import armcal' || true")
        if "the program armcal alone" not in said:
            raise SystemExit(f"{suite}: import of no module says: {said}")
        check_libraries(system, "venv")


def try_package(options, expected):
    with BareRoot("bookworm", options.systems) as system:
        shutil.copy(options.deb, system.path("/root"))
        start = time.monotonic()
        system.run("apt-get -qq update && apt-get -qq install -y "
                   f"--no-install-recommends ./{options.deb.name}")
        calibrate(system, "package", PROGRAM.format(armcal="armcal"), expected)
        tell("bookworm", f"apt-get install ./{options.deb.name}", start)


def main():
    parser = argparse.ArgumentParser()
    for name in ("armcal", "wheels", "deb", "systems"):
        parser.add_argument("--" + name, type=pathlib.Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        expected = first_results.calibrated(pathlib.Path(folder, "build"),
                                            options.armcal.resolve())
        if options.wheels:
            try_wheels("bookworm", options, expected)
            try_wheels("trixie", options, expected)
        if options.deb:
            try_package(options, expected)


if __name__ == "__main__":
    main()
