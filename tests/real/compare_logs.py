#!/usr/bin/env python3
"""Do calibrations of real robots agree with themselves?

  compare_logs.py --armcal=build/armcal [--data=../shared/data]

Each robot's logs are calibrated one by one and in two groups, every other log
and the first and second half, and compared: single logs in pairs, the groups
with each other. Nothing was changed on the robots between the logs. Prints how
many agree; decides nothing (docs/compare.md has the figures).
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

import result_files  # noqa: E402

ROBOTS = {
    "double pendulum A": ("dfki_double_pendulum/robot_A.urdf",
                          "dfki_double_pendulum/A0_sysid_*.csv"),
    "double pendulum C": ("dfki_double_pendulum/robot_C.urdf",
                          "dfki_double_pendulum/C1_sysid_*.csv"),
    "Acrobot": ("dfki_acrobot/robot.urdf", "dfki_acrobot/reference_*.csv.gz"),
}


class Comparer:
    def __init__(self, armcal, folder):
        self._armcal, self._folder, self._count = armcal, folder, 0

    def calibrate(self, robot, logs):
        self._count += 1
        out = f"{self._folder}/{self._count}"
        subprocess.run([self._armcal, "calibrate", f"--robot={robot}", "--quiet",
                        "--log=" + ",".join(map(str, logs)),
                        "--estimate=linear", f"--out={out}"],
                       check=False, capture_output=True)
        return out

    def compare(self, robot, logs, others):
        """The pair of comparison.json."""
        made = subprocess.run(
            [self._armcal, "compare", self.calibrate(robot, logs),
             self.calibrate(robot, others), "--json"],
            check=False, capture_output=True, text=True)
        return json.loads(made.stdout)["pairs"][0]


def say(name, pair):
    """Prints it and returns {agree, p, the deviations of what differs}."""
    differ = [f"{v['name']} {v['deviations']:.1f}" for v in pair["values"]
              if v["differs"]]
    print(f"{name}: {'agree' if pair['agrees'] else 'disagree'}, "
          f"p = {pair['probability']:.1g}", *differ)
    return {"agrees": int(pair["agrees"]), "p": pair["probability"],
            "differ": sorted(abs(v["deviations"]) for v in pair["values"] if v["differs"])}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--armcal", required=True)
    parser.add_argument("--data", default="../shared/data")
    result_files.add_flag(parser)
    flags = parser.parse_args()
    data = pathlib.Path(flags.data)
    with tempfile.TemporaryDirectory() as folder:
        comparer = Comparer(flags.armcal, folder)
        singles, every_other, halves = [], [], []
        for name, (robot, pattern) in ROBOTS.items():
            robot, logs = data / robot, sorted(data.glob(pattern))
            half = len(logs) // 2
            single = [comparer.compare(robot, [a], [b])["agrees"]
                      for a, b in zip(logs[:8:2], logs[1:8:2])]
            print(f"{name}: single logs, {sum(single)} of {len(single)} agree")
            singles += single
            every_other.append(say(f"{name}: every other log",
                                   comparer.compare(robot, logs[::2], logs[1::2])))
            halves.append(say(f"{name}: halves",
                              comparer.compare(robot, logs[:half], logs[half:])))
    if flags.results:
        result_files.write(
            flags.results, "real robots, their logs in ../shared/data",
            {"single_disagree": [singles.count(False), len(singles)],
             "every_other_agree": [sum(x["agrees"] for x in every_other), len(every_other)],
             "every_other_p": sorted(x["p"] for x in every_other),
             "halves_agree": [sum(x["agrees"] for x in halves), len(halves)],
             "halves_differ": [d for x in halves for d in x["differ"][:1] + x["differ"][1:][-1:]]})


if __name__ == "__main__":
    main()
