"""scipy_calibration.py URDF TRAIN.csv HELD_OUT.csv: what one writes in NumPy.

numpy.loadtxt, Pinocchio's regressor per sample from Python, the stacked matrix
and a dense pivoted QR of SciPy. Prints a line of JSON: seconds of CPU per stage
and the held-out residual.
"""

import json
import sys

import numpy as np
import pinocchio
import scipy.linalg

from log_columns import Stages, relative_residual, split


def stacked_regressor(model, q, qd, qdd):
    """Samples x joints in rows; friction, armature and offset of each joint."""
    data, n = model.createData(), model.nv
    W = np.zeros((len(q), n, 14 * n))
    joint = np.arange(n)
    for k, x in enumerate(zip(q, qd, qdd)):
        W[k, :, :10 * n] = pinocchio.computeJointTorqueRegressor(model, data, *x)
        for c, column in enumerate((x[1], np.sign(x[1]), x[2], 1)):
            W[k, joint, (10 + c) * n + joint] = column
    return W.reshape(-1, 14 * n)


def main():
    urdf, train, held_out = sys.argv[1:]
    values = {}
    stages = Stages("Scipy", values)
    _, q, qd, qdd, tau = split(np.loadtxt(train, delimiter=",", skiprows=1))
    stages.took("read")
    model = pinocchio.buildModelFromUrdf(urdf)
    W = stacked_regressor(model, q, qd, qdd)
    stages.took("regressor")
    W = np.asfortranarray(W)
    Q, R, pivots = scipy.linalg.qr(W, mode="economic", pivoting=True,
                                   overwrite_a=True)
    rank = int((np.abs(np.diag(R)) > 1e-9 * abs(R[0, 0])).sum())
    x = np.zeros(W.shape[1])
    x[pivots[:rank]] = scipy.linalg.solve_triangular(
        R[:rank, :rank], Q[:, :rank].T @ tau.ravel())
    inverse = scipy.linalg.inv(R[:rank, :rank])
    np.einsum("ij,ij->i", inverse, inverse)  # variances, but for the noise
    stages.took("solve")
    values["Scipy/base_parameters"] = rank

    _, q, qd, qdd, tau = split(np.loadtxt(held_out, delimiter=",", skiprows=1))
    values["Scipy/held_out"] = relative_residual(
        tau.ravel(), stacked_regressor(model, q, qd, qdd) @ x)
    print(json.dumps({"values": values}))


if __name__ == "__main__":
    main()
