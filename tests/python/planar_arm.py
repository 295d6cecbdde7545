"""A planar arm of two links in closed form (any textbook, such as Craig 6.7),
which swings in a vertical plane."""

import numpy as np

L1, L2 = 0.4, 0.3
M1, M2 = 5.0, 3.0
R1, R2 = 0.2, 0.15  # of the centres of mass from the joints, m
I1, I2 = 0.07, 0.03  # about them, kg m^2
G = 9.81

YAML = """name: planar
gravity: [0, -9.81, 0]
convention: standard
links:
  - {joint: revolute, a: .4, mass: 5, com: [-.2, 0, 0],
     inertia: [.01, .07, .07], viscous: 2, coulomb: 3, armature: .3}
  - {joint: revolute, a: .3, mass: 3, com: [-.15, 0, 0],
     inertia: [.01, .03, .03], viscous: 1, coulomb: 2, armature: .2}
"""


def mass_matrix(q):
    c2 = np.cos(q[:, 1])
    m12 = M2 * (R2**2 + L1 * R2 * c2) + I2
    m11 = M1 * R1**2 + I1 + M2 * (L1**2 + R2**2 + 2 * L1 * R2 * c2) + I2
    m22 = np.full_like(c2, M2 * R2**2 + I2)
    return np.stack([np.stack([m11, m12], -1), np.stack([m12, m22], -1)], -2)


def gravity_torque(q):
    c1, c12 = np.cos(q[:, 0]), np.cos(q[:, 0] + q[:, 1])
    second = M2 * R2 * G * c12
    return np.stack([(M1 * R1 + M2 * L1) * G * c1 + second, second], -1)


def inverse_dynamics(q, qd, qdd):
    h = M2 * L1 * R2 * np.sin(q[:, 1])
    velocity = np.stack([-h * (2 * qd[:, 0] * qd[:, 1] + qd[:, 1]**2),
                         h * qd[:, 0]**2], -1)
    return (np.einsum("kij,kj->ki", mass_matrix(q), qdd) + velocity +
            gravity_torque(q))


def tip(q):
    a, b = q[:, 0], q[:, 0] + q[:, 1]
    return np.stack([L1 * np.cos(a) + L2 * np.cos(b),
                     L1 * np.sin(a) + L2 * np.sin(b)], -1)
