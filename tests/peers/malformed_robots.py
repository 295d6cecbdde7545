#!/usr/bin/env python3
"""What urdfdom and MuJoCo do with the malformed robots of tests/malformed.

  malformed_robots.py PEERS [--check_urdf=NAME=BINARY ...]

PEERS is what fetch.sh makes. Each URDF and MJCF of the table whose fault lies in
the file is given to check_urdf of PyPI's urdfdom (there through `pin`), to others
that are named, as Debian's of liburdfdom-tools, and to MuJoCo, in a process each.
Prints a table for docs/malformed.md: accepts, refuses, crashes (ends by a
signal), hangs (over LONGEST seconds of CPU time or HANGS on the clock).
"""

import argparse
import os
import pathlib
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
MUJOCO = "import sys, mujoco\nmujoco.MjModel.from_xml_path(sys.argv[1])"


def limit():
    resource.setrlimit(resource.RLIMIT_CPU, (LONGEST, LONGEST + 1))
    resource.setrlimit(resource.RLIMIT_AS, (MOST_ADDRESSES, MOST_ADDRESSES))


def outcome(command, path, folder, environment):
    try:
        code = subprocess.run(
            command + [path], cwd=folder, env=environment, timeout=HANGS, preexec_fn=limit,
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode
    except subprocess.TimeoutExpired:
        return "hangs"
    if code in (-24, -9):  # SIGXCPU, SIGKILL
        return "hangs"
    return "accepts" if code == 0 else "crashes" if code < 0 else "refuses"


def readers(peers, others):
    """(heading, of MJCF as well, command, environment) of each peer."""
    packages, = peers.glob("lib/python3*/site-packages")
    prefix = packages / "cmeel.prefix"
    version, = (path.name.split("-")[1] for path in packages.glob("cmeel_urdfdom-*.dist-info"))
    version = version.removesuffix(".dist")
    yield (f"urdfdom {version}", False, [str(prefix / "bin/check_urdf")],
           os.environ | {"LD_LIBRARY_PATH": str(prefix / "lib")})
    for name, binary in others:
        yield name, False, [binary], os.environ
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
        print(f"| {group.name}: {row.name} | {' | '.join(found)} |", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("peers", type=pathlib.Path)
    parser.add_argument("--check_urdf", action="append", default=[])
    arguments = parser.parse_args()
    peers = list(readers(arguments.peers, [x.split("=", 1) for x in arguments.check_urdf]))
    print("| input | " + " | ".join(heading for heading, *_ in peers) + " |")
    print("|---|" + "---|" * len(peers))
    counts = {}
    for module, robot in ((urdf_robots, "robot.urdf"), (mjcf_robots, "robot.xml")):
        for group in module.GROUPS:
            compare(group, robot, peers, counts)
    for (heading, group), count in counts.items():
        print(f"{heading}, {group}: " + ", ".join(
            f"{word} {number}" for word, number in sorted(count.items())), file=sys.stderr)


if __name__ == "__main__":
    main()
