"""write_log.py URDF ROWS SEED OUT.csv: a log of a robot as Pinocchio moves it.

A multisine of 0.1 to 0.6 Hz at 1 kHz; q, qd and qdd exact; tau of the rigid
links with friction and armature and 1 % of noise. Columns as armcal reads them.
"""

import sys

import numpy as np
import pinocchio

VISCOUS, COULOMB, ARMATURE = 5., 3., .5  # N m s/rad, N m, kg m^2; of all joints


def main():
    urdf, rows, seed, out = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), \
        sys.argv[4]
    model = pinocchio.buildModelFromUrdf(urdf)
    data = model.createData()
    random = np.random.default_rng(seed)
    n = model.nv
    t = np.arange(rows) * 1e-3
    omega = 2 * np.pi * random.uniform(.1, .6, (n, 3))
    amplitude = random.uniform(.1, .5, (n, 3))
    phase = random.uniform(0, 2 * np.pi, (n, 3))
    q, qd, qdd = np.zeros((3, rows, n))
    for j in range(n):
        for a, w, p in zip(amplitude[j], omega[j], phase[j]):
            q[:, j] += a * np.sin(w * t + p)
            qd[:, j] += a * w * np.cos(w * t + p)
            qdd[:, j] -= a * w * w * np.sin(w * t + p)
    tau = np.array([pinocchio.rnea(model, data, *x) for x in zip(q, qd, qdd)])
    tau += VISCOUS * qd + COULOMB * np.sign(qd) + ARMATURE * qdd
    tau += .01 * tau.std(axis=0) * random.standard_normal(tau.shape)
    names = ["t"] + [f"{s}{j + 1}" for s in ("q", "qd", "qdd", "tau")
                     for j in range(n)]
    np.savetxt(out, np.column_stack([t, q, qd, qdd, tau]), fmt="%.9g",
               delimiter=",", header=",".join(names), comments="")


if __name__ == "__main__":
    main()
