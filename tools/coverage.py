#!/usr/bin/env python3
"""Which lines the tests run: a table per folder, and every line as HTML.

    coverage.py [BUILD]

BUILD (default build-instrumented, CMake's preset `instrumented`) has the
libraries, and in profiles/ what its programs counted while tests ran
(tools/test.sh --full). Fails below 90 % in model/, problems/ or calib/.
Python's standard library only.
"""

import collections
import glob
import json
import os
import subprocess
import sys

LEAST = 90  # % of lines
HELD_TO_IT = ("model", "problems", "calib")
SOURCES = (".cc", ".h", ".inc")


def folder_of(path):
    """calib/diagnose/select/fit.cc is of its room, of calib/diagnose and of calib."""
    folder = os.path.dirname(path)
    while folder:
        yield folder
        folder = os.path.dirname(folder)


def main():
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    build = os.path.abspath(sys.argv[1] if len(sys.argv) > 1
                            else f"{root}/build-instrumented")
    profiles = [entry.path for entry in os.scandir(f"{build}/profiles")
                if entry.stat().st_size > 0]
    if not profiles:
        sys.exit(f"coverage.py: {build}/profiles is empty: run the tests first "
                 "(tools/test.sh --full)")
    profile = f"{build}/coverage.profdata"
    names = f"{build}/profiles.txt"
    with open(names, "w", encoding="utf-8") as file:
        file.write("\n".join(profiles))
    # A program that was killed leaves half a profile.
    subprocess.run(["llvm-profdata", "merge", "--sparse", "--failure-mode=all",
                    f"--input-files={names}", "-o", profile], check=True)
    # Objects rather than programs, as they hold what no program needs as well.
    objects = sorted(glob.glob(f"{build}/CMakeFiles/*.dir/**/*.cc.o", recursive=True))
    objects = objects[:1] + [f"--object={path}" for path in objects[1:]]
    common = [f"--instr-profile={profile}", *objects]
    text = subprocess.run(["llvm-cov", "export", "--summary-only", *common],
                          check=True, capture_output=True).stdout
    lines = collections.defaultdict(lambda: [0, 0])  # all, run
    for file in json.loads(text)["data"][0]["files"]:
        path = os.path.relpath(file["filename"], root)
        if path.startswith(".."):
            continue
        summary = file["summary"]["lines"]
        for name in (path, *folder_of(path)):
            lines[name][0] += summary["count"]
            lines[name][1] += summary["covered"]
    share = {name: 100 * run / max(1, count) for name, (count, run) in lines.items()}
    subprocess.run(["llvm-cov", "show", "--format=html",
                    f"--output-dir={build}/coverage", *common],
                   check=True, stdout=subprocess.DEVNULL)

    print(f"{'lines':>8} {'run':>7}   folder")
    for name in sorted(name for name in lines if not name.endswith(SOURCES)):
        print(f"{lines[name][0]:8} {share[name]:6.1f}%   {name}/")
    missed = sorted((name for name in lines if name.endswith(SOURCES)),
                    key=lambda name: lines[name][1] - lines[name][0])
    print("most lines that no test runs:")
    for name in missed[:20]:
        print(f"{lines[name][0] - lines[name][1]:8} {share[name]:6.1f}%   {name}")
    print(f"every line: {build}/coverage/index.html")
    low = [name for name in HELD_TO_IT if share.get(name, 0) < LEAST]
    if low:
        sys.exit(f"coverage.py: below {LEAST} %: " +
                 ", ".join(f"{name}/ {share.get(name, 0):.1f} %" for name in low))


if __name__ == "__main__":
    main()
