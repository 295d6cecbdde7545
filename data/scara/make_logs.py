#!/usr/bin/env python3
"""Writes A.csv.gz, B.csv.gz and C.csv.gz: exact logs of the paper's SCARA.

Three motions of 4 s, sampled every 2 ms: positions, velocities, accelerations
and the torques that the closed form (3.14)-(3.16) of Ha, Ko and Kwon gives for
X_TRUE, with the misprints of (3.15) corrected. No noise, 17 digits. The file
shares no code with armcal. Usage: make_logs.py [FOLDER]
"""

import gzip
import math
import os
import sys

# X11, X21, X22, X23, X31, X41 of (3.12): kg m^2, the fifth kg.
X_TRUE = (17.55, 7.55, 2.343, 0.176, 3.11, 0.35)
GRAVITY = 9.8  # m/s^2, along +z: down
STEP_MS = 2
SAMPLES = 2001
PI = math.pi


def raised_cosine(t, offset, amplitude, w):
    """q = offset + amplitude (1 - cos wt), with both derivatives."""
    c, s = math.cos(w * t), math.sin(w * t)
    return (offset + amplitude * (1 - c), amplitude * w * s,
            amplitude * w * w * c)


def two_tones(t, offset, amplitudes, w, phases):
    """q = offset + sum of amplitude sin(wt + phase), with both derivatives."""
    q, qd, qdd = offset, 0.0, 0.0
    for k in range(2):
        s = amplitudes[k] * math.sin(w[k] * t + phases[k])
        c = amplitudes[k] * math.cos(w[k] * t + phases[k])
        q, qd, qdd = q + s, qd + w[k] * c, qdd - w[k] * w[k] * s
    return q, qd, qdd


def rest_to_rest(t, begin, end, duration=4.0):
    """The quintic that rests at both ends, with both derivatives."""
    s, d = t / duration, end - begin
    return (begin + d * (10 * s**3 - 15 * s**4 + 6 * s**5),
            d * (30 * s**2 - 60 * s**3 + 30 * s**4) / duration,
            d * (60 * s - 180 * s**2 + 120 * s**3) / duration**2)


MOTIONS = {
    # Time-symmetric about t = 2 s, 1 s and so on: hard to identify from.
    "A": lambda t: [raised_cosine(t, *p) for p in (
        (0, .8, PI / 2), (.3, .6, PI), (0, .05, PI / 2), (0, .7, PI))],
    "B": lambda t: [two_tones(t, *p) for p in (
        (0, (.5, .15), (2 * PI * .25, 2 * PI * .6), (0, .4)),
        (.4, (.6, -.2), (2 * PI * .4, 2 * PI * .75), (.7, 1.1)),
        (0, (.06, .02), (2 * PI * .5, 2 * PI * .8), (.2, 0)),
        (0, (.7, .3), (2 * PI * .3, 2 * PI * .7), (1, .3)))],
    # What an industrial arm does: one move from pose to pose.
    "C": lambda t: [rest_to_rest(t, *p) for p in (
        (0, 1.5), (.2, 1.6), (0, .12), (0, -1.2))],
}


def torques(q, qd, qdd):
    """(3.14)-(3.16) times X_TRUE: N m, N m, N, N m."""
    x11, x21, x22, x23, x31, x41 = X_TRUE
    c2, s2 = math.cos(q[1]), math.sin(q[1])
    swing = 2 * qdd[0] + qdd[1]
    coriolis = 2 * qd[0] * qd[1] + qd[1] ** 2
    return (
        x11 * qdd[0] + x21 * qdd[1] + x22 * (swing * c2 - coriolis * s2)
        + x23 * (-swing * s2 - coriolis * c2) + x41 * qdd[3],
        x21 * (qdd[0] + qdd[1]) + x22 * (qdd[0] * c2 + qd[0] ** 2 * s2)
        + x23 * (-qdd[0] * s2 + qd[0] ** 2 * c2) + x41 * qdd[3],
        x31 * (qdd[2] - GRAVITY),
        x41 * (qdd[0] + qdd[1] + qdd[3]))


def log_text(motion):
    names = [p + str(j) for p in ("q", "qd", "qdd", "tau") for j in (1, 2, 3, 4)]
    lines = [",".join(["t"] + names + ["simulated"])]
    for k in range(SAMPLES):
        q, qd, qdd = zip(*motion(k * STEP_MS / 1000))
        values = q + qd + qdd + torques(q, qd, qdd)
        lines.append(",".join(["%.3f" % (k * STEP_MS / 1000)] +
                              ["%.17g" % v for v in values] + ["1"]))
    return "\n".join(lines) + "\n"


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(
        os.path.abspath(__file__))
    for name, motion in MOTIONS.items():
        path = os.path.join(folder, name + ".csv.gz")
        with open(path, "wb") as file:
            # No name and no time in the header: the same bytes each time.
            with gzip.GzipFile("", "wb", 9, file, mtime=0) as stream:
                stream.write(log_text(motion).encode("ascii"))
        print(path)


if __name__ == "__main__":
    main()
