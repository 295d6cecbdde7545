"""Draws what each effect leaves in the torque of a small arm, as SVG.

The arm is two links that swing in a vertical plane; both joints follow the same
12 s of motion in every figure. Left: the first joint's residual against what
orders it; right: over time, shaded where the joint moves forwards. The laws
are those of the pages, written once more in plain Python.
"""

import math

N, SECONDS = 1200, 12.0
DT = SECONDS / N
G = 9.81


def sine(t, *terms):
    return sum(a * math.sin(2 * math.pi * f * t + p) for a, f, p in terms)


def joints_at(t):
    """Positions of both joints, rad."""
    return (sine(t, (.75, 1 / 6, .2), (.25, .5, 1.3)) + 1.7,
            sine(t, (.9, .25, 2.1), (.2, 7 / 12, .4)) - .3)


def derivative(x):
    """Of a motion that repeats, by central differences."""
    return [(x[(k + 1) % N] - x[k - 1]) / (2 * DT) for k in range(N)]


class Motion:
    def __init__(self, shift=(0, 0), stretch=1.0):
        self.t = [k * DT for k in range(N)]
        q = [joints_at(t) for t in self.t]
        self.q = [[x[j] + shift[j] for x in q] for j in (0, 1)]
        self.v = [[stretch * x for x in derivative(q)] for q in self.q]
        self.a = [[stretch * x for x in derivative(v)] for v in self.v]

    def moved(self, joint, by):
        """The motion with by(k) added to one position."""
        other = Motion.__new__(Motion)
        other.t, other.q = self.t, [list(x) for x in self.q]
        other.q[joint] = [x + by[k] for k, x in enumerate(self.q[joint])]
        other.v = [derivative(q) for q in other.q]
        other.a = [derivative(v) for v in other.v]
        return other


# Of the arm: link 1's length, masses, centres, inertias, and a body on the tool.
ARM = dict(l1=.4, m1=5., c1=.2, i1=.07, m2=3., c2=.15, i2=.03, tilt=0.)
VISCOUS, COULOMB = (2., 1.), (3., 2.)


def rigid(motion, **changes):
    """Torques of both joints without friction, N m (Craig, planar arm)."""
    p = {**ARM, **changes}
    tau = ([], [])
    for k in range(N):
        (q1, q2), (v1, v2), (a1, a2) = ([x[0][k], x[1][k]] for x in
                                        (motion.q, motion.v, motion.a))
        h = p["m2"] * p["l1"] * p["c2"]
        c, s = math.cos(q2), math.sin(q2)
        j2 = p["i2"] + p["m2"] * p["c2"] ** 2
        j1 = p["i1"] + p["m1"] * p["c1"] ** 2 + p["m2"] * p["l1"] ** 2
        g12 = G * p["m2"] * p["c2"] * math.cos(q1 + q2 + p["tilt"])
        g1 = G * (p["m1"] * p["c1"] + p["m2"] * p["l1"]) * math.cos(
            q1 + p["tilt"])
        tau[0].append((j1 + j2 + 2 * h * c) * a1 + (j2 + h * c) * a2 -
                      h * s * (2 * v1 * v2 + v2 * v2) + g1 + g12)
        tau[1].append((j2 + h * c) * a1 + j2 * a2 + h * s * v1 * v1 + g12)
    return tau


def sign(v, width=.02):
    return math.tanh(v / width)


MOTION = Motion()
LOAD = rigid(MOTION)
TORQUE = [[LOAD[j][k] + VISCOUS[j] * MOTION.v[j][k] +
           COULOMB[j] * sign(MOTION.v[j][k]) for k in range(N)]
          for j in (0, 1)]
Q, V, A, T = MOTION.q[0], MOTION.v[0], MOTION.a[0], MOTION.t
TAU = TORQUE[0]


def each(law):
    return [law(k) for k in range(N)]


def change(motion=MOTION, joint=0, **changes):
    """What the rigid arm's torque differs by."""
    return [a - b for a, b in zip(rigid(motion, **changes)[joint], LOAD[joint])]


def at(series, t):
    x = (t / DT) % N
    k = int(x)
    return series[k] + (x - k) * (series[(k + 1) % N] - series[k])


def bristles(displacement):
    z, out = 0., []
    for _ in range(2):  # the second time round it has settled
        out = []
        for v in V:
            steps = 20
            for _ in range(steps):
                z += DT / steps * (v - abs(v) * z) / displacement
            out.append(z)
    return out


def wound_up(compliance):
    """Position of a link that lags and rings at 4 Hz, damping ratio 0.1."""
    w, zeta, d, rate, out = 2 * math.pi * 4, .1, compliance * LOAD[0][0], 0., []
    for _ in range(2):
        out = []
        for k in range(N):
            for _ in range(10):
                rate += DT / 10 * (w * w * (compliance * LOAD[0][k] - d) -
                                   2 * zeta * w * rate)
                d += DT / 10 * rate
            out.append(-d)
    return out


BEAD = [sign(x, 1.5) for x in LOAD[0]]
RESIDUALS = {  # name: (residual of joint 1, N m; what orders it; its label)
    "viscous_friction": (each(lambda k: .5 * V[k]), V, "v, rad/s"),
    "coulomb_friction": (each(lambda k: sign(V[k])), V, "v, rad/s"),
    "torque_offset": (each(lambda k: 1.), TAU, "torque, N m"),
    "asymmetric_friction": (each(lambda k: .5 * abs(V[k])), V, "v, rad/s"),
    "quadratic_friction": (each(lambda k: .4 * V[k] * abs(V[k])), V,
                           "v, rad/s"),
    "stribeck": (each(lambda k: math.exp(-(V[k] / .15) ** 2) * sign(V[k])), V,
                 "v, rad/s"),
    "load_friction": (each(lambda k: .06 * abs(LOAD[0][k]) * sign(V[k])),
                      LOAD[0], "load, N m"),
    "position_friction": (each(lambda k: math.sin(4 * Q[k]) * sign(V[k])), Q,
                          "q, rad"),
    "coupled_friction": (each(lambda k: .7 * sign(V[k] - MOTION.v[1][k]) +
                              .3 * (V[k] - MOTION.v[1][k])),
                         [a - b for a, b in zip(V, MOTION.v[1])],
                         "v - neighbour's"),
    "presliding": ([z - sign(v) for z, v in zip(bristles(.08), V)], V,
                   "v, rad/s"),
    "armature": (each(lambda k: .2 * A[k]), A, "qdd, rad/s²"),
    "elasticity": (change(MOTION.moved(0, wound_up(5e-4))), A, "qdd, rad/s²"),
    "backlash": (change(MOTION.moved(0, [-.003 * b for b in BEAD])), LOAD[0],
                 "load, N m"),
    "spring": (each(lambda k: 1.5 * (Q[k] - 1.6)), Q, "q, rad"),
    "cable": (each(lambda k: math.tanh((Q[k] - 1.6) / .15)), Q, "q, rad"),
    "torque_ripple": (each(lambda k: math.sin(12 * Q[k])), Q, "q, rad"),
    "torque_gain": (each(lambda k: .06 * TAU[k]), TAU, "torque, N m"),
    "torque_gain_of_all_joints": (each(lambda k: .06 * TAU[k]), TAU, "torque, N m"),
    "torque_nonlinearity": (each(lambda k: .1 * TAU[k] ** 3 / 15 ** 2), TAU,
                            "torque, N m"),
    "torque_saturation": (each(lambda k: TAU[k] - max(-12., min(12., TAU[k]))),
                          TAU, "torque, N m"),
    "torque_deadband": (each(lambda k: math.tanh(TAU[k] / 1.)), TAU,
                        "torque, N m"),
    "torque_crosstalk": (each(lambda k: .15 * TORQUE[1][k]), TORQUE[1],
                         "neighbour's, N m"),
    "delay": (each(lambda k: at(TAU, T[k] + .02) - TAU[k]), derivative(TAU),
              "d torque / dt, N m/s"),
    "encoder_offset": (change(MOTION.moved(0, [-.05] * N)), Q, "q, rad"),
    "link_length": (change(l1=.43), Q, "q, rad"),
    "base_tilt": (change(tilt=.05), Q, "q, rad"),
    "payload": (change(m2=3.4, c2=(3 * .15 + .4 * .3) / 3.4), Q, "q, rad"),
    "added_mass": (change(m1=5.5, c1=1.2 / 5.5, i1=.35 - 1.2 ** 2 / 5.5), Q, "q, rad"),
    "link_inertia": (change(m2=3.3, i2=.033), Q, "q, rad"),
    "thermal_friction": (each(lambda k: -(.5 * V[k] + .8 * sign(V[k])) *
                              (1 - math.exp(-T[k] / 5))), T, "t, s"),
    "viscous_friction_of_all_joints": (each(lambda k: -.2 * VISCOUS[0] * V[k]), V, "v, rad/s"),
    "time_drift": (each(lambda k: (1 - math.exp(-T[k] / 4)) /
                        (1 - math.exp(-3))), T, "t, s"),
    "external_contact": (each(lambda k: -2 * math.exp(-((T[k] - 7) / .4) ** 2)
                              * math.sin(Q[k])), T, "t, s"),
    "vibration": (each(lambda k: math.sin(2 * math.pi * 2.5 * T[k])), T,
                  "t, s"),
    "time_base": ([a + VISCOUS[0] * .05 * v - b for a, v, b in
                   zip(rigid(Motion(stretch=1.05))[0], V, LOAD[0])], V,
                  "v, rad/s"),
}

INK, SHADE, CURVE = "#808080", "#808080", "#3080d0"  # on light and on dark


def panel(x0, width, xs, ys, top, label, line):
    """A plot of ys, -top to top, over xs at x0."""
    height, middle = 150, 90
    low, high = min(xs), max(xs)
    if high - low < 1e-9:
        low, high = low - 1, high + 1
    fx = [x0 + width * (x - low) / (high - low) for x in xs]
    fy = [middle - height / 2 * y / top for y in ys]
    out = [f'<path d="M{x0} {middle}h{width}M{x0} 15v{height}" stroke="{INK}" '
           'fill="none"/>']
    if line:
        points = "".join(f"{'L' if k else 'M'}{x:.1f} {y:.1f}"
                         for k, (x, y) in enumerate(zip(fx[::3], fy[::3])))
        out.append(f'<path d="{points}" stroke="{CURVE}" stroke-width="1.5" '
                   'fill="none" stroke-linejoin="round"/>')
    else:
        points = "".join(f"M{x:.0f} {y:.0f}h0"
                         for x, y in zip(fx[::6], fy[::6]))
        out.append(f'<path d="{points}" stroke="{CURVE}" stroke-width="2.5" '
                   'stroke-linecap="round"/>')
    out += [f'<text x="{x0}" y="182">{low:.3g}</text>',
            f'<text x="{x0 + width}" y="182" text-anchor="end">{high:.3g}'
            "</text>",
            f'<text x="{x0 + width / 2}" y="182" text-anchor="middle">{label}'
            "</text>"]
    return out


def forwards(x0, width):
    """Rectangles where joint 1 moves forwards."""
    out, begin = [], None
    for k in range(N + 1):
        ahead = k < N and V[k] > 0
        if ahead and begin is None:
            begin = k
        elif not ahead and begin is not None:
            out.append(f'<rect x="{x0 + width * begin / N:.1f}" y="15" width="'
                       f'{width * (k - begin) / N:.1f}" height="150" '
                       f'fill="{SHADE}" fill-opacity=".13"/>')
            begin = None
    return out


def draw(name):
    ys, order, label = RESIDUALS[name]
    top = 1.1 * max(abs(y) for y in ys)
    lines = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 640 192" '
             f'font-family="sans-serif" font-size="12" fill="{INK}">',
             f"<title>{name}: residual of joint 1</title>"]
    lines += forwards(290, 330)
    lines += panel(45, 190, order, ys, top, label, False)
    lines += panel(290, 330, T, ys, top, "t, s", True)
    lines += [f'<text x="{x}" y="24" text-anchor="end">{top:.2g}</text>'
              for x in (42, 287)]
    lines += ['<text x="42" y="94" text-anchor="end">0</text>',
              '<text x="42" y="38" text-anchor="end">N m</text>', "</svg>", ""]
    return "\n".join(lines)
