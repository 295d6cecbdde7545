"""Random motions and torques of an arm, most of them spoiled."""

import numpy as np

import robots
from robots import chance


def fourier(rng, t, n, span):
    """Four harmonics: q, qd, qdd."""
    base = 2 * np.pi * rng.choice([1, 2, 4]) / span
    q = np.tile(rng.uniform(-1, 1, n), (len(t), 1))
    qd, qdd = np.zeros_like(q), np.zeros_like(q)
    for k in range(1, 5):
        w, s, c = k * base, np.sin(k * base * t)[:, None], np.cos(k * base * t)[:, None]
        a, b = rng.uniform(-1, 1, (2, n)) / k
        q += a * s + b * c
        qd += w * (a * c - b * s)
        qdd -= w * w * (a * s + b * c)
    return q, qd, qdd


def differences(t, q):
    """qd, qdd of positions that have no derivatives."""
    if len(t) < 3 or np.any(np.diff(t) <= 0):
        return np.zeros_like(q), np.zeros_like(q)
    qd = np.gradient(q, t, axis=0)
    return qd, np.gradient(qd, t, axis=0)


MOTIONS = {"excites all": 10, "one joint": 1.5, "still": 1, "one sample": 0.5, "two samples": 0.5,
           "a few samples": 1, "ramp": 0.7, "steps": 0.7, "walk": 0.7, "noise": 0.5, "huge": 0.5,
           "tiny": 0.7, "quantised": 1.5, "in phase": 0.7, "stops and goes": 0.7, "one speed": 0.5}


def motion(rng, kind, t, n, span):
    q, qd, qdd = fourier(rng, t, n, span)
    if kind == "one joint":
        alone = np.arange(n) == rng.integers(n)
        return np.where(alone, q, q[:1]), qd * alone, qdd * alone
    if kind == "huge" or kind == "tiny":
        f = 10 ** (rng.uniform(1, 6) if kind == "huge" else rng.uniform(-12, -2))
        return q * f, qd * f, qdd * f
    if kind == "in phase":  # all joints do what the first does
        return (np.tile(x[:, :1], (1, n)) for x in (q, qd, qdd))
    if kind == "quantised":
        step = 10 ** rng.uniform(-6, -0.5)
        return np.round(q / step) * step, qd, qdd
    s = (t - t[0]) / span
    if kind == "still":
        q = np.tile(q[:1], (len(t), 1))
    elif kind in ("ramp", "one speed"):
        q = q[:1] + np.outer(s, rng.normal(size=n))
        if kind == "one speed":
            q[:, 1:] = q[0, 1:]
    elif kind == "steps":
        q = q[(s * 6).astype(int) * (len(t) // 7)]
    elif kind == "walk":
        q = np.cumsum(rng.normal(size=(len(t), n)), 0) * 0.01
    elif kind == "noise":
        q = rng.normal(size=(len(t), n))
    elif kind == "stops and goes":
        q = q[(np.abs(s % 0.5 - 0.25) * 4 * (len(t) - 1) * 0.999).astype(int)]
        q[s < 0.3] = q[0]
    else:
        return q, qd, qdd
    return q, *differences(t, q)


TIMES = {"even": 10, "jitter": 1.5, "gaps": 1, "stamps twice": 0.7, "random": 0.5,
         "since 1970": 0.7, "very fast": 0.4, "very slow": 0.4, "before 0": 0.4, "all one": 0.1}


def times(rng, kind, count):
    dt = 1 / rng.choice([20, 50, 100, 100, 500])
    if kind == "very fast":
        dt = 10 ** rng.uniform(-8, -4)
    elif kind == "very slow":
        dt = 10 ** rng.uniform(0, 4)
    t = np.arange(count) * dt
    if kind == "jitter":
        t = t + rng.uniform(-0.4, 0.4, count) * dt
    elif kind == "gaps":
        t = t + np.cumsum(rng.random(count) < 3 / count) * rng.uniform(1, 300) * dt
    elif kind == "stamps twice":
        t = np.repeat(t, 2)[:count]
    elif kind == "random":
        t = np.sort(rng.uniform(0, count * dt, count))
    elif kind == "since 1970":
        t = t + 1.7e9
    elif kind == "before 0":
        t = t - 1e3
    elif kind == "all one":
        t = t * 0
    return t


TORQUES = {"exact": 4, "noise": 6, "more noise": 1.5, "noise alone": 1, "zero": 0.7,
           "constant": 0.7, "saturated": 1, "of another arm": 1.5, "quantised": 1, "spikes": 1,
           "huge": 0.4, "tiny": 0.4, "one joint zero": 0.7, "beyond numbers": 0.1}


def spoiled(rng, kind, tau):
    size = np.abs(tau).max(axis=0) if len(tau) else 0
    size = np.where(np.isfinite(size) & (size > 0), size, 1)
    if kind in ("noise", "more noise"):
        share = 10 ** (rng.uniform(-6, -0.5) if kind == "noise" else rng.uniform(-0.5, 3))
        return tau + rng.normal(size=tau.shape) * size * share
    if kind == "noise alone":
        return rng.normal(size=tau.shape) * 10 ** rng.uniform(-9, 6)
    if kind == "zero":
        return tau * 0
    if kind == "constant":
        return tau * 0 + rng.normal(size=tau.shape[1])
    if kind == "saturated":
        return np.clip(tau, -0.3 * size, 0.3 * size)
    if kind == "quantised":
        return np.round(tau / size * 8) * size / 8
    if kind == "spikes":
        return tau + (rng.random(tau.shape) < 0.02) * rng.normal(size=tau.shape) * size * 100
    if kind in ("huge", "tiny"):
        return tau * 10 ** (rng.uniform(6, 30) if kind == "huge" else rng.uniform(-30, -6))
    if kind == "beyond numbers":
        return tau / size * 10 ** rng.uniform(100, 307)
    if kind == "one joint zero":
        return np.where(np.arange(tau.shape[1]) == rng.integers(tau.shape[1]), 0, tau)
    return tau


COLUMNS = {"t q tau": 8, "and qd": 2, "and qdd": 3, "qd is wrong": 0.5, "currents": 0.7,
           "degrees": 0.5, "and qref": 0.5, "and temp": 0.2}
CELLS = {"numbers": 30, "nan": 0.3, "empty": 0.3, "inf": 0.2, "rows twice": 1.5, "no rows": 0.2,
         "rows of zeros": 0.5}


# What a log is drawn from that nothing is wrong with.
SOUND = {"motion": {"excites all": 1}, "times": {"even": 1}, "torque": {"exact": 1, "noise": 3},
         "columns": {"t q tau": 2, "and qd": 1, "and qdd": 1}, "cells": {"numbers": 1}}


def draw(rng, robot, samples, sound=0.4):
    """(CSV text, kinds, whether it holds currents)"""
    n = len(robot.links)
    if rng.random() < sound:
        kinds = {group: chance(rng, choice) for group, choice in SOUND.items()}
        samples = max(samples, 40 * n)
    else:
        kinds = {"motion": chance(rng, MOTIONS), "times": chance(rng, TIMES),
                 "torque": chance(rng, TORQUES), "columns": chance(rng, COLUMNS),
                 "cells": chance(rng, CELLS)}
    count = {"one sample": 1, "two samples": 2, "a few samples": int(rng.integers(3, 12))}.get(
        kinds["motion"], samples)
    t = times(rng, kinds["times"], count)
    span = max(t[-1] - t[0], 1e-9) if count > 1 else 1.0
    with np.errstate(all="ignore"):
        q, qd, qdd = motion(rng, kinds["motion"], t, n, span)
        # A slide moves by as much as the arm is long.
        slides = np.array([robot.length if link.prismatic else 1.0 for link in robot.links])
        q, qd, qdd = q * slides, qd * slides, qdd * slides
        mover = robot
        if kinds["torque"] == "of another arm":
            mover = robot._replace(links=[link._replace(
                mass=rng.uniform(0, 10), com=rng.uniform(-0.5, 0.5, 3),
                inertia=np.diag(rng.uniform(0.5, 1, 3))) for link in robot.links])
        tau = spoiled(rng, kinds["torque"], robots.torques(mover, q, qd, qdd))
    text, currents = table(rng, kinds, t, q, qd, qdd, tau)
    return text, kinds, currents


def table(rng, kinds, t, q, qd, qdd, tau):
    signals = {"q": q, "tau": tau}
    extra = kinds["columns"]
    if extra in ("and qd", "and qdd"):
        signals["qd"] = qd
    if extra == "and qdd":
        signals["qdd"] = qdd
    elif extra == "qd is wrong":
        signals["qd"] = rng.normal(size=qd.shape)
    elif extra == "currents":
        signals["i"] = signals.pop("tau") / 2
    elif extra == "degrees":
        signals["q"] = np.degrees(q)
    elif extra == "and qref":
        signals["qref"] = q + rng.normal(size=q.shape) * 1e-3
    elif extra == "and temp":
        signals["temp"] = np.full_like(q, 20) + 10 * (t[:, None] - t[0])
    unit = " [deg]" if extra == "degrees" else ""
    names = ["t"] + [f"{s}{k + 1}{unit if s == 'q' else ''}" for s in signals
                     for k in range(q.shape[1])]
    rows = np.hstack([t[:, None]] + list(signals.values()))
    cells = kinds["cells"]
    if cells == "rows twice":
        rows = np.repeat(rows, 2, axis=0)
    elif cells == "no rows":
        rows = rows[:0]
    elif cells == "rows of zeros":
        rows[len(rows) // 2:, 1:] = 0
    lines = [[f"{x:.17g}" for x in row] for row in rows.tolist()]
    if cells in ("nan", "empty", "inf"):
        lines[rng.integers(len(lines))][rng.integers(len(names))] = "" if cells == "empty" else cells
    return ("\n".join([",".join(names)] + [",".join(line) for line in lines]) + "\n",
            extra == "currents")


def poses(rng, robot, count):
    """A table of measured poses, and its kind."""
    n = len(robot.links)
    kind = chance(rng, {"targets": 3, "poses": 2, "wire": 1})
    place = chance(rng, {"many": 5, "one place": 1, "one joint": 1, "far off": 1})
    q = rng.uniform(-2, 2, (count, n)) * (place != "one place")
    if place == "one joint":
        q[:, 1:] = 0
    R, p = robots.tips(robot, q)
    p = p + robot.length * rng.normal(size=p.shape) * 10 ** rng.uniform(-9, -2)
    if place == "far off":
        p = p + robot.length * 10 ** rng.uniform(-2, 3)
    if kind == "targets":
        names, values = ["x1", "y1", "z1"], p
    elif kind == "wire":
        names, values = ["length1"], np.linalg.norm(p - robot.length, axis=1)[:, None]
    else:
        w = np.sqrt(np.maximum(0, 1 + np.trace(R, axis1=1, axis2=2))) / 2
        quaternions = np.column_stack([w, *(np.sqrt(np.maximum(
            0, 1 + 2 * R[:, k, k] - np.trace(R, axis1=1, axis2=2))) / 2 * np.copysign(
                1, R[:, (k + 2) % 3, (k + 1) % 3] - R[:, (k + 1) % 3, (k + 2) % 3])
            for k in range(3))])
        names, values = ["x", "y", "z", "qw", "qx", "qy", "qz"], np.hstack([p, quaternions])
    lines = [",".join([f"q{k + 1}" for k in range(n)] + names)]
    lines += [",".join(f"{x:.17g}" for x in row) for row in np.hstack([q, values]).tolist()]
    return "\n".join(lines) + "\n", f"{kind}, {place}"
