#!/usr/bin/env python3
"""What urdfdom and MuJoCo do with the malformed robots of tests/malformed.

  malformed_robots.py PEERS [--urdfdom=/usr]

PEERS is what fetch.sh makes. Each URDF and MJCF of the table whose fault lies in
the file is given to urdfdom and MuJoCo, in a process each: Debian's urdfdom
(liburdfdom-dev below --urdfdom; parseURDFFile), PyPI's (it comes with `pin`, but
without all headers: its check_urdf, which also prints the tree) and PyPI's
MuJoCo. Prints a table for docs/malformed.md: accepts, refuses, crashes (ends by
a signal), hangs (over LONGEST seconds of CPU time or HANGS on the clock). What
all refuse is left out, and counted on stderr as well.
"""

import argparse
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "malformed"))
import mjcf_robots  # noqa: E402
import urdf_robots  # noqa: E402
from inputs import Row, nothing, write  # noqa: E402

LONGEST, HANGS = 10, 60  # s
MOST_ADDRESSES = 8 << 30
URDFDOM = """#include <urdf_parser/urdf_parser.h>
int main(int, char** argv) { return urdf::parseURDFFile(argv[1]) ? 0 : 1; }
"""
MUJOCO = "import sys, mujoco\nmujoco.MjModel.from_xml_path(sys.argv[1])"


def limit():
    resource.setrlimit(resource.RLIMIT_CPU, (LONGEST, LONGEST + 1))
    resource.setrlimit(resource.RLIMIT_AS, (MOST_ADDRESSES, MOST_ADDRESSES))


def outcome(command, path, folder, environment):
    try:
        code = subprocess.run(
            command + [path], cwd=folder, env=environment, timeout=HANGS, preexec_fn=limit,
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL).returncode
    except subprocess.TimeoutExpired:
        return "hangs"
    if code in (-24, -9):  # SIGXCPU, SIGKILL
        return "hangs"
    return "accepts" if code == 0 else "crashes" if code < 0 else "refuses"


def debian_urdfdom(root, folder):
    """Heading, command and environment of a program that calls its parser."""
    libraries, = root.glob("lib/*/liburdfdom_model.so")
    settings = (libraries.parent / "pkgconfig/urdfdom.pc").read_text()
    version = re.search(r"^Version: *(\S+)", settings, re.M)[1]
    program = folder / "parse"
    subprocess.run(["g++", "-std=c++17", "-xc++", "-", "-o", program, f"-I{root}/include",
                    f"-L{libraries.parent}", f"-Wl,-rpath-link,{libraries.parent}",
                    "-lurdfdom_model"], input=URDFDOM.encode(), check=True)
    return (f"urdfdom {version}", False, [str(program)],
            os.environ | {"LD_LIBRARY_PATH": str(libraries.parent)})


def readers(peers, root, folder):
    """(heading, of MJCF as well, command, environment) of each peer."""
    yield debian_urdfdom(root, folder)
    packages, = peers.glob("lib/python3*/site-packages")
    prefix = packages / "cmeel.prefix"
    about, = packages.glob("cmeel_urdfdom-*.dist-info")
    version = about.stem.split("-")[1]
    yield (f"check_urdf {version}", False, [str(prefix / "bin/check_urdf")],
           os.environ | {"LD_LIBRARY_PATH": str(prefix / "lib")})
    python = str(peers / "bin/python")
    version = subprocess.run([python, "-c", "import mujoco; print(mujoco.__version__)"],
                             capture_output=True, text=True, check=True).stdout.strip()
    yield f"MuJoCo {version}", True, [python, "-c", MUJOCO], os.environ


def compare(group, robot, peers, counts):
    for row in [Row("good file", nothing, "")] + group.rows:
        if row.command:
            continue
        found = []
        for heading, any_format, command, environment in peers:
            if robot.endswith(".xml") and not any_format:
                found.append("")
                continue
            with tempfile.TemporaryDirectory() as folder:
                folder = pathlib.Path(folder)
                for name, content in group.good.items():
                    write(folder / name, content)
                row.change(folder)
                found.append(outcome(command, robot, folder, environment))
            if row.name != "good file":
                count = counts.setdefault((heading, group.name), {})
                count[found[-1]] = count.get(found[-1], 0) + 1
        if set(found) - {"", "refuses"}:
            print(f"| {group.name}: {row.name} | {' | '.join(found)} |", flush=True)


def compare_all(peers):
    print("| input | " + " | ".join(heading for heading, *_ in peers) + " |")
    print("|---|" + "---|" * len(peers))
    counts = {}
    for module, robot in ((urdf_robots, "robot.urdf"), (mjcf_robots, "robot.xml")):
        for group in module.GROUPS:
            if group.rows:
                compare(group, robot, peers, counts)
    for (heading, group), count in counts.items():
        print(f"{heading}, {group}: " + ", ".join(
            f"{word} {number}" for word, number in sorted(count.items())), file=sys.stderr)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("peers", type=pathlib.Path)
    parser.add_argument("--urdfdom", type=pathlib.Path, default=pathlib.Path("/usr"))
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        compare_all(list(readers(arguments.peers, arguments.urdfdom, pathlib.Path(folder))))


if __name__ == "__main__":
    main()
