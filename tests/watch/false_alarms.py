#!/usr/bin/env python3
"""How often does armcal watch tell a change that is none?

  false_alarms.py --armcal=build/armcal --robot=ROBOT --seed=N [--hours=5]

An arm whose masses, inertias and friction are 5 % off its file is calibrated on
three logs of 30 s; then one process of armcal watch is fed hours of it at 1 kHz,
five minutes of one motion after the other (Fourier series and moves between
points with rests, in turns, at full and half speed), each drawn anew, with a
second without rows between, as they begin elsewhere. Nothing changes, so every
change told is a false alarm. No more than one piece is ever on
the disk. Prints what was told, seconds of CPU, and the memory of the process
every half hour.
"""

import argparse
import json
import pathlib
import subprocess
import tempfile
import threading

PIECE = 300  # s of motion


def simulate(armcal, robot, seed, run, out, **options):
    command = [armcal, "simulate", f"--robot={robot}", f"--seed={seed}",
               f"--run={run}", "--robot_error=0.05", "--log_rate=1000",
               "--quiet", f"--out={out}"]
    command += [f"--{name}={value}" for name, value in options.items()]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return f"{out}/log.csv"


def calibrate(armcal, robot, seed, folder):
    logs = [simulate(armcal, robot, seed, run, f"{folder}/c{run}", duration=30)
            for run in (1, 2, 3)]
    subprocess.run([armcal, "calibrate", f"--robot={robot}", "--quiet",
                    "--log=" + ",".join(logs), f"--out={folder}/calibration"],
                   check=True, stdout=subprocess.DEVNULL)
    return f"{folder}/calibration"


def copy_rows(path, to, begin, header):
    """Writes rows with their times after `begin`; returns the last time."""
    time = begin
    with open(path, encoding="ascii") as log:
        first = next(log)
        if header:
            to.write(first)
        for line in log:
            stamp, rest = line.split(",", 1)
            time = begin + float(stamp)
            to.write(f"{time:.6f},{rest}")
    return time


def usage(process):
    """Resident MB and seconds of CPU."""
    status = pathlib.Path(f"/proc/{process.pid}/status").read_text("ascii")
    memory = [l for l in status.splitlines() if l.startswith("VmRSS")][0]
    fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text("ascii").split()
    return int(memory.split()[1]) / 1024, (int(fields[13]) + int(fields[14])) / 100


def feed(arguments, folder, process):
    time, run, told = 0, 100, 0
    while time < arguments.hours * 3600:
        run += 1
        log = simulate(arguments.armcal, arguments.robot, arguments.seed, run,
                       f"{folder}/piece", duration=PIECE,
                       motion=("fourier", "points")[run % 2],
                       speed=(1, .5)[run // 2 % 2])
        time = copy_rows(log, process.stdin, time, run == 101) + 1
        if time >= told:
            memory, cpu = usage(process)
            print(f"{time / 3600:6.2f} h  {memory:6.1f} MB  {cpu:7.1f} s of CPU, "
                  f"{100 * cpu / time:.2f} % of a core", flush=True)
            told += 1800


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--armcal", required=True)
    parser.add_argument("--robot", required=True)
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--hours", type=float, default=5)
    arguments = parser.parse_args()
    changes = []
    with tempfile.TemporaryDirectory() as folder:
        calibration = calibrate(arguments.armcal, arguments.robot,
                                arguments.seed, folder)
        process = subprocess.Popen(
            [arguments.armcal, "watch", f"--robot={arguments.robot}",
             f"--calibration={calibration}", "--log=-", "--json"],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

        def listen():
            for line in process.stdout:
                event = json.loads(line)
                if event["event"] in ("contact", "payload", "friction",
                                      "cannot tell yet"):
                    changes.append(event)
                    print("told", line[:300].strip(), flush=True)
        listener = threading.Thread(target=listen)
        listener.start()
        feed(arguments, folder, process)
        process.stdin.close()
        listener.join()
        process.wait()
    print(f"{len(changes)} told in {arguments.hours:g} h")


if __name__ == "__main__":
    main()
