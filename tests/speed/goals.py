#!/usr/bin/env python3
"""The goals of armcal's speed, and what was measured of them.

    goals.py [--json OUT] BENCHMARKS.json [VALUES.json ..]

BENCHMARKS.json is what Google Benchmark writes with repetitions; a benchmark's
time is the median over them of the CPU time per item (items_per_second, or the
counter per_sample), and its number otherwise the median of the counter value.
VALUES.json are what the
other scripts of tests/speed and tests/peers write: {"values": {name: number}}.
Every goal but those in seconds is a ratio of two of these numbers, so the
machine's speed drops out; floor and stretch say what it should be at most.
Python's standard library only.
"""

import argparse
import json
import re
import statistics
import sys

# Floating-point operations of the regressor per sample of a 6R arm of general
# geometry, 60 columns, counted with an instrumented scalar. Those of Householder
# QR of the joints' equations, 2 sum k_j^2, say the benchmarks themselves.
REGRESSOR_FLOPS = 2049
LOG_NUMBERS = 100_000 * 25  # of the log that command lines calibrate

REGRESSOR = "LinkColumns"
PINOCCHIO_REGRESSOR = "Pinocchio/computeJointTorqueRegressor"


INSTRUCTION_SETS = ["baseline", "avx2", "avx512"]


class Measured(dict):
    """Name to number; a kernel's name to its best instruction set's."""

    def __missing__(self, name):
        sets = [f"{name}/{s}" for s in INSTRUCTION_SETS]
        found = [self[s] for s in sets if s in self]
        if not found:
            raise LookupError(name)
        return min(found)

    def flop_limit(self, flops):
        """Seconds that these take one core at its peak."""
        return flops * self["FmaPeak"]


# (what, floor, stretch, ratio); in the order of the issue.
GOALS = [
    ("regressor into chunks / Pinocchio's computeJointTorqueRegressor",
     .10, .05, lambda m: m[REGRESSOR] / m[PINOCCHIO_REGRESSOR]),
    ("regressor of one sample / Pinocchio's",
     .30, .20, lambda m: m["LinkColumnsOfOne"] / m[PINOCCHIO_REGRESSOR]),
    ("regressor into chunks / limit of its flops",
     3.0, 1.5, lambda m: m[REGRESSOR] / m.flop_limit(REGRESSOR_FLOPS)),
    ("1e6 samples to base parameters / structured flop limit",
     2.5, 1.5, lambda m: m["LinearCalibration/1000000"] /
     m.flop_limit(REGRESSOR_FLOPS +
                  m["LinearCalibration/1000000.qr_flops"])),
    ("the same / dense Householder QR of Eigen, 2e5 samples",
     1 / 25, 1 / 45, lambda m: m["LinearCalibration/200000"] /
     m["DenseQr/200000"]),
    ("the same, 2 threads / 1 thread",
     .6, .52, lambda m: m["LinearCalibration/threads:2"] /
     m["LinearCalibration/threads:1"]),
    ("memory beyond the log, 1e4 to 1e6 samples, MB",
     8, 1, lambda m: m["Memory/growth_mb"]),
    ("weak-form rows / differential ones",
     2, 1, lambda m: m["WeakRows/chunk"] / m["DifferentialRows/chunk"]),
    ("Jacobian of one sample / Ceres autodiff",
     1 / 15, 1 / 20, lambda m: m["Jacobian/scalar"] / m["Ceres/autodiff"]),
    ("Jacobian in lanes / Ceres autodiff",
     1 / 40, 1 / 65, lambda m: m["Jacobian/chunk"] / m["Ceres/autodiff"]),
    ("nonlinear iteration / Ceres, analytic blocks per sample",
     .3, .14, lambda m: m["Nonlinear/iteration"] / m["Ceres/iteration"]),
    ("covariance / Ceres SPARSE_QR",
     .05, .015, lambda m: m["Nonlinear/covariance"] /
     m["Ceres/covariance_sparse_qr"]),
    ("RK4 step / MuJoCo's",
     .4, .28, lambda m: m["Rollout/scalar"] / m["Mujoco/mj_step_rk4"]),
    ("RK4 step, windows in lanes / MuJoCo's",
     .10, .06, lambda m: m["Rollout/lanes"] / m["Mujoco/mj_step_rk4"]),
    ("CSV of 1e5 rows to parameters, cold / parsing alone",
     3, 2, lambda m: m["Command/calibrate_s"] /
     (LOG_NUMBERS * m["Log/parsing_alone.cpu"])),
    ("the same / FIGAROH on the same file",
     1 / 100, 1 / 100, lambda m: m["Command/calibrate_s"] /
     m["Figaroh/total_s"]),
    ("its held-out residual / FIGAROH's",
     1, 1, lambda m: m["Command/held_out"] / m["Figaroh/held_out"]),
    # Seconds of wall clock, that a user waits.
    ("diagnosis screen of 60 s, 6 joints, whole catalogue, s",
     1, 1, lambda m: m["DiagnosisScreen"]),
    ("whole diagnosis with simulation-calibrated threshold, 2 cores, s",
     20, 5, lambda m: m["Diagnosis/whole_s"]),
]

# (work, ours, theirs): the same on the same robot and states.
PEERS = [
    ("regressor, Pinocchio", REGRESSOR, PINOCCHIO_REGRESSOR),
    ("regressor of one sample, Pinocchio", "LinkColumnsOfOne",
     PINOCCHIO_REGRESSOR),
    ("inverse dynamics, Pinocchio", "Torque", "Pinocchio/rnea"),
    ("inverse dynamics, MuJoCo", "Torque", "Mujoco/mj_inverse"),
    ("forward dynamics, Pinocchio", "ForwardDynamics/lanes", "Pinocchio/aba"),
    ("mass matrix, Pinocchio", "MassMatrix/lanes", "Pinocchio/crba"),
    ("RK4 step, MuJoCo", "Rollout/lanes", "Mujoco/mj_step_rk4"),
    ("RK4 step of one arm, MuJoCo", "Rollout/scalar", "Mujoco/mj_step_rk4"),
    ("RK4 step with viscous friction, MuJoCo", "Rollout/lanes_damped",
     "Mujoco/mj_step_rk4_damped"),
    ("torque's Jacobian, 84 parameters, Ceres autodiff", "Jacobian/chunk",
     "Ceres/autodiff"),
    ("CSV of 1e5 rows to parameters, FIGAROH", "Command/calibrate_s",
     "Figaroh/total_s"),
    ("the same by smoothed motion and weak rows, FIGAROH", "Command/default_s",
     "Figaroh/total_s"),
    ("CSV of 1e5 rows to parameters, NumPy and SciPy", "Command/calibrate_s",
     "Scipy/total_s"),
    ("one Jacobian of a log of 1e4 steps, MuJoCo sysid", "Nonlinear/iteration_s",
     "Sysid/jacobian_s"),
]
# How well the same was computed, by the names of both above.
ERRORS = {
    "Command/calibrate_s": "Command/held_out",
    "Figaroh/total_s": "Figaroh/held_out",
    "Scipy/total_s": "Scipy/held_out",
}


def read(paths):
    """All numbers of the files by name, and what else is said of benchmarks."""
    measured, details, context = Measured(), {}, {}
    for path in paths:
        with open(path, encoding="utf-8") as file:
            content = json.load(file)
        measured.update(content.get("values", {}))
        context.update(content.get("context", {}))
        repetitions = {}
        for run in content.get("benchmarks", []):
            if run["run_type"] == "iteration" and (
                    {"items_per_second", "per_sample", "value"} & run.keys()):
                # Without how often it was run: "Name/iterations:1/repeats:3".
                name = re.sub("/(iterations|repeats|min_time):[^/]*|"
                              "/(process|real)_time", "", run["run_name"])
                repetitions.setdefault(name, []).append(run)
        for name, runs in repetitions.items():
            if "value" in runs[0]:
                measured[name] = statistics.median(run["value"] for run in runs)
                continue
            seconds = [run["per_sample"] if "per_sample" in run else
                       1 / run["items_per_second"] for run in runs]
            measured[name] = statistics.median(seconds)
            details[name] = {"median_s": measured[name], "min_s": min(seconds),
                             "max_s": max(seconds), "repetitions": len(runs)}
            if runs[0]["run_name"].endswith("/real_time"):
                measured[name + ".cpu"] = statistics.median(
                    s * run["cpu_time"] / run["real_time"]
                    for s, run in zip(seconds, runs))
            if "qr_flops" in runs[0]:
                measured[name + ".qr_flops"] = runs[0]["qr_flops"]
            if "error" in runs[0]:
                details[name]["error"] = max(run["error"] for run in runs)
    return measured, details, context


def judge(measured):
    """What was reached of every goal."""
    for what, floor, stretch, ratio in GOALS:
        result = {"what": what, "floor": floor, "stretch": stretch}
        try:
            result["ratio"] = ratio(measured)
        except (LookupError, ValueError) as missing:
            result["reached"] = None
            result["needs"] = str(missing)
        else:
            result["reached"] = ("stretch" if result["ratio"] <= stretch else
                                 "floor" if result["ratio"] <= floor else "no")
        yield result


def compare(measured, details):
    """Ours beside theirs."""
    def error_of(name):
        if name in details:
            return details[name].get("error")
        of_sets = [details[of]["error"] for s in INSTRUCTION_SETS
                   for of in (f"Accuracy/{name}/{s}", f"{name}/{s}")
                   if "error" in details.get(of, {})]
        return max(of_sets) if of_sets else measured.get(ERRORS.get(name))

    for work, ours, theirs in PEERS:
        row = {"work": work, "ours": ours, "theirs": theirs}
        for side in ours, theirs:
            key = "ours_s" if side == ours else "theirs_s"
            try:
                row[key] = measured[side]
            except LookupError:
                row[key] = None
            row[key.replace("_s", "_error")] = error_of(side)
        if row["ours_s"] is not None and row["theirs_s"] is not None:
            row["ratio"] = row["ours_s"] / row["theirs_s"]
        yield row


def number(value, none="-"):
    """A ratio below a tenth also as a fraction."""
    if value is None:
        return none
    text = f"{value:.3g}"
    return f"{text} (1/{1 / value:.0f})" if 0 < value < .1 else text


def scientific(value):
    return "-" if value is None else f"{value:.2g}"


def duration(seconds):
    if seconds is None:
        return "not built"
    for unit, size in ("s", 1), ("ms", 1e-3), ("us", 1e-6):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds / 1e-9:.3g} ns"


def print_table(rows):
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    for i, row in enumerate(rows):
        print("  ".join(cell.ljust(w) for cell, w in zip(row, widths)).rstrip())
        if i == 0:
            print("  ".join("-" * w for w in widths))


def print_goals(goals):
    rows = [("goal: at most", "floor", "stretch", "measured", "reached")]
    for goal in goals:
        reached = goal["reached"] or f"not measured here: needs {goal['needs']}"
        rows.append((goal["what"], number(goal["floor"]),
                     number(goal["stretch"]), number(goal.get("ratio")),
                     reached))
    print_table(rows)


def print_peers(peers):
    rows = [("work", "ours", "theirs", "ratio", "error ours", "theirs")]
    for peer in peers:
        if peer["theirs_s"] is None:
            continue
        rows.append((peer["work"], duration(peer["ours_s"]),
                     duration(peer["theirs_s"]), number(peer.get("ratio")),
                     scientific(peer["ours_error"]),
                     scientific(peer["theirs_error"])))
    if len(rows) > 1:
        print()
        print_table(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--json", metavar="OUT")
    parser.add_argument("files", nargs="+", metavar="FILE.json")
    arguments = parser.parse_args()
    try:
        measured, details, context = read(arguments.files)
    except (OSError, ValueError, KeyError) as error:
        sys.exit(f"goals.py: {error}")
    goals = list(judge(measured))
    peers = list(compare(measured, details))
    print_goals(goals)
    print_peers(peers)
    if arguments.json:
        with open(arguments.json, "w", encoding="utf-8") as file:
            json.dump({"context": context, "goals": goals, "peers": peers,
                       "benchmarks": details, "values": measured}, file,
                      indent=1)
            file.write("\n")


if __name__ == "__main__":
    main()
