"""Logs of many units of one arm whose differences are known: torques of the
arm's equations with each unit's own parameters, and white noise."""

import contextlib
import csv
import datetime
import logging
import pathlib

import armcal
import numpy as np

# Two links that swing, with masses to refine.
ARM = (pathlib.Path(__file__).resolve().parent.parent /
       "swinging_arm.yaml").read_text()
#: What is planted, by the number of the unit; and what of all grows by day.
OUTLIERS = {3: ("coulomb[2]", 2.0), 7: ("viscous[1]", 2.0),
            11: ("coulomb[1]", 3.0)}
DRIFT = ("viscous[2]", 3e-3)  # N m s/rad a day
#: Reduces all units alike.
MODEL = {"bandwidth": 10, "coulomb_width": "0.02rad/s", "window": 0.3}
WIDTH = .02  # rad/s


def motion(random, seconds, rate=100):
    t = np.arange(int(seconds * rate)) / rate
    q, qd, qdd = (np.zeros((t.size, 2)) for _ in range(3))
    for joint in range(2):
        for _ in range(3):
            w, phase = random.uniform(.6, 4), random.uniform(0, 2 * np.pi)
            q[:, joint] += .4 * np.sin(w * t + phase)
            qd[:, joint] += .4 * w * np.cos(w * t + phase)
            qdd[:, joint] -= .4 * w * w * np.sin(w * t + phase)
    return t, q, qd, qdd


def parameters_of(robot, unit, day, random):
    """A unit's own: links, viscous and Coulomb friction."""
    links = robot.inertial_parameters
    links = links * (1 + .02 * random.standard_normal((2, 1)))
    friction = {"viscous": robot.viscous * (1 + .1 * random.standard_normal(2)),
                "coulomb": robot.coulomb * (1 + .1 * random.standard_normal(2))}
    planted = [(DRIFT[0], DRIFT[1] * day)]
    if unit in OUTLIERS:
        planted.append(OUTLIERS[unit])
    for name, change in planted:
        term, joint = name[:-3], int(name[-2]) - 1
        friction[term][joint] += change
    return robot.replace(inertial_parameters=links, **friction)


def write_units(folder, count, seed=1, long_s=12, short_s=4, noise=(.5, .25)):
    """Writes arm.yaml, a log for each unit (every third a short one) and
    units.csv; returns each unit's friction."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "arm.yaml").write_text(ARM)
    robot = armcal.read_robot(folder / "arm.yaml")
    random = np.random.default_rng(seed)
    rows, truth = [], []
    for unit in range(count):
        day = int(random.integers(0, 300))
        own = parameters_of(robot, unit, day, random)
        t, q, qd, qdd = motion(random, short_s if unit % 3 == 2 else long_s)
        tau = own.inverse_dynamics(q, qd, qdd) + own.viscous * qd + (
            own.coulomb * np.tanh(qd / WIDTH)) + own.armature * qdd
        tau += noise * random.standard_normal(tau.shape)
        name = f"unit{unit:03d}.csv"
        np.savetxt(folder / name, np.column_stack([t, q, qd, tau]),
                   fmt="%.9g", delimiter=",", comments="",
                   header="t,q1,q2,qd1,qd2,tau1,tau2")
        date = datetime.date(2026, 1, 1) + datetime.timedelta(day)
        rows.append({"log": name, "unit": f"u{unit:03d}", "date": str(date)})
        truth.append({"viscous": own.viscous, "coulomb": own.coulomb})
    with open(folder / "units.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, ["log", "unit", "date"])
        writer.writeheader()
        writer.writerows(rows)
    return truth


@contextlib.contextmanager
def cluster_of(workers):
    """A client of so many processes on this machine, each with one thread."""
    import distributed  # not everywhere, and what is above needs none
    with distributed.LocalCluster(
            n_workers=workers, threads_per_worker=1,
            dashboard_address="127.0.0.1:0",
            silence_logs=logging.CRITICAL) as cluster, distributed.Client(
                cluster) as client:
        yield client
