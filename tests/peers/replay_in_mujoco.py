"""Which of two robots follows a held-out log more closely in MuJoCo?

  replay_in_mujoco.py --original=robot.xml --corrected=diagnosed/robot.xml \
      [--refitted=calibrated/robot.xml] \\
      --train=train/log.csv --held_out=held_out/log.csv

The original gets viscous and Coulomb friction, fitted by least squares on the
training log; --refitted is armcal calibrate's, which has the same laws but
fits the bodies as well. All start at the measured state of each window and get the
recorded torques, open loop; the error is the rms of all joints' positions over
the window. Prints medians over windows with bootstrap intervals, and the median
of the windows' ratios (below 1: the corrected robot is closer).
"""

import argparse
import json

import numpy as np

from mujoco_arm import Arm, Log


def window_errors(arm, log, window, begin=0.0, end=np.inf):
    length = int(window / log.step)
    chosen = np.flatnonzero((log.grid >= begin) & (log.grid < end))
    errors = []
    for start in range(chosen[0], chosen[-1] - length, length):
        path = arm.replay(log, start, start + length)
        off = path - log.grid_q[start:start + length]
        errors.append(np.sqrt(np.mean(off ** 2)))
    return np.array(errors)


def median_with_interval(values, seed=1):
    random = np.random.default_rng(seed)
    draws = random.integers(0, len(values), (2000, len(values)))
    low, high = np.percentile(np.median(values[draws], axis=1), [2.5, 97.5])
    return [float(np.median(values)), float(low), float(high)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--original", required=True)
    parser.add_argument("--corrected", required=True)
    parser.add_argument("--refitted")
    parser.add_argument("--train", required=True)
    parser.add_argument("--held_out", required=True)
    parser.add_argument("--train_until", type=float, default=np.inf)
    parser.add_argument("--held_out_from", type=float, default=0)
    parser.add_argument("--window", type=float, default=0.5)
    parser.add_argument("--smooth", type=float, default=0.02)
    flags = parser.parse_args()

    train = Log(flags.train, flags.smooth)
    keep = train.grid < flags.train_until
    for name in ("grid", "grid_q", "grid_qd", "grid_qdd"):
        setattr(train, name, getattr(train, name)[keep])
    held_out = Log(flags.held_out, flags.smooth)
    original, corrected = Arm(flags.original), Arm(flags.corrected)
    damping, dry = original.fit_friction(train)
    arms = {"original": original, "corrected": corrected}
    if flags.refitted:
        arms["refitted"] = Arm(flags.refitted)
    errors = {name: window_errors(arm, held_out, flags.window, flags.held_out_from)
              for name, arm in arms.items()}
    result = {"windows": len(errors["original"])}
    for name in arms:
        result[name + "_rad"] = median_with_interval(errors[name])
        if name == "corrected":
            continue
        ratios = errors["corrected"] / errors[name]
        result["corrected_to_" + name] = median_with_interval(ratios)
        result["won_against_" + name] = int(np.sum(ratios < 1))
    print(json.dumps({
        **result,
        "damping": damping.round(4).tolist(),
        "frictionloss": dry.round(4).tolist()}))


if __name__ == "__main__":
    main()
