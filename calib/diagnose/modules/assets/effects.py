"""The laws of effects.json in the loop of a simulator of rigid bodies. Written by armcal.

    effects = Effects("effects.json")
    # each step of dt:
    positions = effects.sense(dt, q, qd)  # of the simulator's joints; what encoders say
    torque = effects.act(commanded)       # what the simulator is to give its joints

The module holds all of the joints' friction, their constant torques and the effects: the
simulator's joints have none of their own, and as rotor inertia (armature) `effects.armature`.
With beside="mjcf" (mjcf_plain, urdf, sdf, yaml) it holds what that robot file lacks, and the simulator the rest.

    python3 effects.py --test      compares with effects_test.json, which armcal's own laws made

Standard library only. SI units; lists have an entry per joint, from the base on.
"""

import json
import math
import os
import sys

VELOCITY_STEP, DEFLECTION_STEP = 1e-4, 1e-6  # of differences for slopes
PHASE_PER_SUBSTEP, MOST_SUBSTEPS = .05, 100  # of a motor on its spring

# What a motor gives of its command: (torques, joint, numbers, velocities), in place.


def _gain(u, j, p, _):
    u[j] /= 1 + p["gain"]


def _offset(u, j, p, _):
    u[j] -= p["offset"]


def _nonlinearity(u, j, p, _):
    """x + fall x^3 = y has one real root."""
    if p["fall"] <= 0:
        return
    a, peak = math.sqrt(3 * p["fall"]), p["fall_torque"]
    u[j] = peak * 2 / a * math.sinh(math.asinh(1.5 * a * u[j] / peak) / 3)


def _softplus(x):
    if abs(x) > 25:
        return max(x, 0.)
    return math.log1p(math.exp(x))


def _saturation(u, j, p, v):
    """A limit of current, or of voltage, which falls with the speed along the torque."""
    limit = max(p["least"], p["limit"] - p["slope"] * math.copysign(v[j], v[j] * u[j]))
    w = p["knee"] * limit
    passed = w * (_softplus(1 / p["knee"]) - _softplus((limit - abs(u[j])) / w))
    u[j] -= p["share"] * (u[j] - math.copysign(passed, u[j]))


def _deadband(u, j, p, _):
    """x + d tanh(x / s) = y by Newton's steps, which rise to x."""
    d, s, y = p["deadband"], p["softness"], abs(u[j])
    if d <= 0:
        return
    x = max(0., y - d)
    for _ in range(20):
        t = math.tanh(x / s)
        step = (y - x - d * t) / (1 + d / s * (1 - t * t))
        x += step
        if abs(step) <= 1e-12 * (x + s):
            break
    u[j] = math.copysign(x, u[j])


def _crosstalk(u, j, p, _):
    u[j] -= p["gain"] * u[int(p["neighbour"]) - 1]


COMMANDS = {"torque_gain": _gain, "torque_offset": _offset,
            "torque_nonlinearity": _nonlinearity, "torque_saturation": _saturation,
            "torque_deadband": _deadband, "torque_crosstalk": _crosstalk}

# Torques on a joint: (what laws see, joint, numbers, own state), N m or N.


def _wave(p, x):
    return p["sine"] * math.sin(x) + p["cosine"] * math.cos(x)


def _dry(see, j, p):
    return math.tanh(see.velocity[j] / p["width"])


def _stribeck(see, j, p, _):
    v = see.velocity[j]
    return -p["stribeck"] * math.exp(-v * v / p["stribeck_velocity"] ** 2) * _dry(see, j, p)


def _coupled(see, j, p, _):
    u = see.velocity[j] + p["ratio"] * see.velocity[int(p["neighbour"]) - 1]
    return -(p["friction"] * math.tanh(u / p["width"]) + p["viscous"] * u)


def _coupled_neighbour(see, _, p, state):
    """The same bearing on the other joint, which is where it is listed a second time."""
    return p["ratio"] * _coupled(see, p["joint"], p, state)


FRICTION = {
    "viscous_friction": lambda see, j, p, z: -p["viscous"] * see.velocity[j],
    "coulomb_friction": lambda see, j, p, z: -p["coulomb"] * _dry(see, j, p),
    "asymmetric_friction": lambda see, j, p, z: -p["asymmetric"] * abs(see.velocity[j]),
    "quadratic_friction": lambda see, j, p, z:
        -p["quadratic"] * see.velocity[j] * abs(see.velocity[j]),
    "stribeck": _stribeck,
    "load_friction": lambda see, j, p, z:
        -p["load_friction"] * abs(see.load[j]) * _dry(see, j, p),
    "position_friction": lambda see, j, p, z:
        -_wave(p, p["harmonic"] * see.position[j]) * _dry(see, j, p),
    "coupled_friction": _coupled,
    "presliding": lambda see, j, p, z: -p["coulomb"] * z,
    "thermal_friction": lambda see, j, p, z:
        -p["cold_viscous"] * see.velocity[j] * math.expm1(-p["beta"] * see.warmth[j])
        - p["cold_coulomb"] * _dry(see, j, p) * math.expm1(-p["coulomb_beta"] * see.warmth[j]),
}
TORQUES = {
    "spring": lambda see, j, p, z: p["preload"] - p["stiffness"] * see.position[j],
    "cable": lambda see, j, p, z:
        -p["cable"] * math.tanh((see.position[j] - p["centre"]) / p["softness"]),
    "torque_ripple": lambda see, j, p, z: -_wave(p, p["harmonic"] * see.position[j]),
    "vibration": lambda see, j, p, z: _wave(p, 2 * math.pi * p["frequency"] * see.t),
    "time_drift": lambda see, j, p, z:
        p["drift"] * math.expm1(-(see.t - p["begin"]) / p["time_constant"]),
}

# Between a motor and its link: the torque on the link.


def _elasticity(d, rate, p):
    return p["stiffness"] * d * (1 + p["stiffening"] * d * d) + p["damping"] * rate


def _backlash(d, rate, p):
    """Flanks that press and never pull; the corner of a ramp is a parabola from -1 to 1."""
    side, w = math.copysign(1, d), .005 * p["gap"]
    x = (abs(d) - p["gap"] / 2) / w
    slope = min(1., max(0., (1 + x) / 2))
    ramp = x if x > 1 else slope * slope
    return side * max(0., p["stiffness"] * w * ramp + p["damping"] * slope * side * rate)


TRANSMISSIONS = {"elasticity": _elasticity, "backlash": _backlash}
ELSEWHERE = {"delay", "encoder_offset"}  # delay_s; sense()


class Law:
    """A torque on a joint with its numbers and its state (bristles, asperities)."""

    def __init__(self, joint, numbers, torque, heats=False):
        self.joint, self.numbers, self.torque, self.heats = joint, numbers, torque, heats
        self.state = 0.

    def at(self, see):
        return self.torque(see, self.joint, self.numbers, self.state)

    def follow(self, move):
        """Moves the state along with the joint, by `move` rad or m."""
        if "displacement" in self.numbers and move != 0:  # z' = v/displacement (1 - z sign(v))
            end = math.copysign(1, move)
            end_share = math.exp(-abs(move) / self.numbers["displacement"])
            self.state = end + (self.state - end) * end_share
        if "travel" in self.numbers:  # a spring that yields
            self.state = min(1., max(-1., self.state + move / self.numbers["travel"]))


def _own_friction(joint, j):
    """Viscous and Coulomb friction that every robot file has."""
    yield Law(j, joint, lambda see, j, p, z: -p["viscous"] * see.velocity[j], True)
    for part in joint["coulomb"]:
        if part["law"] == "velocity":
            yield Law(j, part, lambda see, j, p, z: -p["force"] * _dry(see, j, p), True)
        else:
            yield Law(j, {"force": part["force"], "travel": part["width"]},
                      lambda see, j, p, z: -p["force"] * z, True)


class Effects:
    """What effects.json says, step by step. Its lists may be read and set between steps:
    `t` (s, of the log that was diagnosed), `warmth` (K above the surroundings)."""

    def __init__(self, file="effects.json", beside=None):
        with open(file, encoding="utf-8") as text:
            data = json.load(text)
        self.n = len(data["joints"])
        self.names = [joint["name"] for joint in data["joints"]]
        # Torque is recorded this much later than it acts, s; below 0 it acts later.
        self.record_delay = max(0., data["delay_s"])
        self._lag_time = 0. if beside in data["delay_in"] else max(0., -data["delay_s"])
        # Each joint's laws; those of them that the simulator holds; what it has instead.
        joints = data["joints"]
        self._laws, self._held, self._shares = ([[] for _ in joints] for _ in range(3))
        self._commands, self._encoders, self._thermal = [], [], []
        self._springs = {}
        self._offset_in = [joint["offset_in"] for joint in joints]
        for j, joint in enumerate(joints):
            self._add_joint(j, joint, beside)
        for effect in data["effects"]:
            self._add(effect, effect["joint_index"] - 1, beside)
        if beside and self._springs:
            raise ValueError("a joint that yields has its friction at the motor: set the "
                             "simulator's friction to 0 and leave `beside` out")
        self._motor_inertia = [joint["armature"] for joint in joints]
        # What the simulator's joints are to have: of a motor on a spring nothing.
        self.armature = [0. if j in self._springs else inertia
                         for j, inertia in enumerate(self._motor_inertia)]
        self.reset()

    def _add_joint(self, j, joint, beside):
        (self._held if beside else self._laws)[j].extend(_own_friction(joint, j))
        offset = Law(j, joint, lambda see, j, p, z: -p["offset"])
        (self._held if beside in joint["offset_in"] else self._laws)[j].append(offset)

    def _add(self, effect, j, beside):
        name, p = effect["effect"], dict(effect["numbers"], joint=j)
        held = beside in effect["in"]
        laws = self._held if held else self._laws
        if name in COMMANDS:
            self._commands.append((COMMANDS[name], j, p, held))
        elif name in TRANSMISSIONS:
            self._springs[j] = (TRANSMISSIONS[name], p)
        elif name == "encoder_offset":
            self._encoders.append((j, p["offset"]))
        elif name in FRICTION:
            laws[j].append(Law(j, p, FRICTION[name], True))
            if "neighbour" in p:
                k = int(p["neighbour"]) - 1
                laws[k].append(Law(k, p, _coupled_neighbour, True))
        elif name in TORQUES:
            laws[j].append(Law(j, p, TORQUES[name]))
        if "resistance" in p:
            self._thermal.append((j, p))
        if beside and not held and "share" in effect:  # what stands in the file in its stead
            share = dict(effect["share"])
            share["offset"] *= beside in self._offset_in[j]
            self._shares[j].append(Law(
                j, share, lambda see, j, p, z: p["viscous"] * see.velocity[j]
                + p["coulomb"] * _dry(see, j, p) + p["offset"]))

    def reset(self, load=None):
        """To the begin, cold. `load`: what joints hold at rest, which winds up springs."""
        zero = [0.] * self.n
        self.t = 0.
        self.position, self.velocity = zero[:], zero[:]  # of the motors
        self.link_position, self.link_velocity = zero[:], zero[:]
        self.load, self._load_known = zero[:], load is not None
        if load is not None:
            self.load = [float(x) for x in load]
        self.warmth, self._heat, self.damping = zero[:], zero[:], zero[:]
        self._change = zero[:]  # of links' velocities, in the last step
        self._missing = zero[:]  # what springs gave motors in it and not links, mean
        self._ends = zero[:]  # torques of springs at the call before
        self._lag = self._given = self._commanded = self._drive = None
        self._started = False
        for laws in self._laws + self._held:
            for law in laws:
                law.state = 0.

    def sense(self, dt, q, qd):
        """The simulator's joints are at q, qd, dt after the call before. What encoders say,
        which sit on the motors."""
        q, qd = [float(x) for x in q], [float(x) for x in qd]
        if self._started:
            self._advance(dt, q, qd)
        else:
            self._start(q, qd)
        reading = self.position[:]
        for j, offset in self._encoders:
            reading[j] += offset
        return reading

    def act(self, commanded, load=None):
        """The torques that the simulator is to give its joints for those commanded, held until
        the next call. `load`: what joints hand to their links, if the simulator knows it.
        Sets `damping` (N m s/rad or N s/m, >= 0), how fast the torque falls with velocity,
        and `undamped`: a simulator whose joints are implicit in their damping is given both,
        and steps through standstill without chatter."""
        commanded = [float(x) for x in commanded]
        if self._commanded is None:
            self._lag = commanded[:]
            self.load = self.load if self._load_known else commanded[:]
        if load is not None:
            self.load = [float(x) for x in load]
        self._commanded = commanded
        given = self._lag[:] if self._lag_time else commanded[:]
        own = given[:]  # without what the simulator holds
        for command, j, p, held in self._commands:
            command(given, j, p, self.velocity)
            if not held:
                command(own, j, p, self.velocity)
        self._given = given
        self._drive = given[:]
        for j in range(self.n):
            self._add_laws(j, own)
        # A motor that yields goes along with its link, about as that went before.
        self.undamped = [f + d * (v + (change if j in self._springs else 0))
                         for j, (f, d, v, change) in enumerate(zip(
                             own, self.damping, self.link_velocity, self._change))]
        return own

    def take_over(self, model):
        """Sets to 0 what a MuJoCo model of the robot (robot_plain.xml) has of all this."""
        if (model.nv, model.nu, model.ntendon) != (self.n, self.n, 0):
            raise ValueError("this model has laws of its own, as robot.xml has: take "
                             "robot_plain.xml, the export mjcf_plain")
        for values in (model.dof_damping, model.dof_frictionloss, model.jnt_stiffness,
                       model.actuator_gainprm, model.actuator_biasprm):
            values[:] = 0
        model.dof_armature[:] = self.armature

    def _start(self, q, qd):
        self._started = True
        self.link_position, self.link_velocity = q, qd
        self.position, self.velocity = q[:], qd[:]
        for j, (_, p) in self._springs.items():
            load = self.load[j]
            gap = p.get("gap", 0) / 2 if load else 0
            self.position[j] += math.copysign(gap, load) + load / p["stiffness"]

    def _advance(self, dt, q, qd):
        self._advance_slow_states(dt, qd)
        self._change = [new - old for new, old in zip(qd, self.link_velocity)]
        before, self.link_position, self.link_velocity = self.link_position, q, qd
        for j in range(self.n):
            if j in self._springs:
                continue
            self._follow(j, q[j] - before[j])
            self.position[j], self.velocity[j] = q[j], qd[j]
        for j in self._springs:
            self._advance_motor(j, dt, before[j])
        self.t += dt

    def _advance_slow_states(self, dt, qd):
        """Lags of commands, warmth and loads until now."""
        if self._commanded is None:
            return
        if self._lag_time:
            share = -math.expm1(-dt / self._lag_time)
            self._lag = [x + share * (u - x) for x, u in zip(self._lag, self._commanded)]
        for j, thermal in self._thermal:
            R = thermal["resistance"]
            kept = math.exp(-dt / (R * thermal["capacity"]))
            self.warmth[j] = kept * self.warmth[j] + R * self._heat[j] * (1 - kept)
        for j in range(self.n):
            moves = self.armature[j] * (qd[j] - self.link_velocity[j]) / dt
            self.load[j] = self._drive[j] - moves

    def _follow(self, j, move):
        for law in self._laws[j] + self._held[j]:
            law.follow(move)

    def _on_motor(self, j):
        """Of all laws that the simulator does not hold, N m or N."""
        torque = 0.
        for law in self._laws[j]:
            torque += law.at(self)
        for law in self._shares[j]:
            torque += law.at(self)
        return torque

    def _spring(self, j, more, faster):
        law, p = self._springs[j]
        return law(self.position[j] - self.link_position[j] + more,
                   self.velocity[j] - self.link_velocity[j] + faster, p)

    def _slope(self, of, step):
        return (of(step) - of(-step)) / (2 * step)

    def _friction_slope(self, j):
        """Of the torque on motor j over its velocity."""
        v = self.velocity[j]

        def at(faster):
            self.velocity[j] = v + faster
            return self._on_motor(j)

        slope = self._slope(at, VELOCITY_STEP)
        self.velocity[j] = v
        return slope

    def _advance_motor(self, j, dt, link_before):
        """A motor on its spring, by implicit midpoint steps of a linearised law; its link
        moves evenly."""
        if self._given is None:
            return
        inertia, p = self._motor_inertia[j], self._springs[j][1]
        phase = dt * math.sqrt(p["stiffness"] / inertia)
        count = min(MOST_SUBSTEPS, max(1, math.ceil(phase / PHASE_PER_SUBSTEP)))
        h, spring = dt / count, 0.
        end, end_velocity = self.link_position[j], self.link_velocity[j]
        self.link_velocity[j] = (end - link_before) / dt
        for k in range(count):
            self.link_position[j] = link_before + (end - link_before) * (k + .5) / count
            force = self._given[j] + self._on_motor(j) - self._spring(j, 0, 0)
            by_q = -self._slope(lambda d: self._spring(j, d, 0), DEFLECTION_STEP)
            friction_by_v = self._friction_slope(j)
            by_v = friction_by_v - self._slope(lambda r: self._spring(j, 0, r), VELOCITY_STEP)
            v = self.velocity[j]
            rate = (force + h / 2 * by_q * v) / (inertia - h / 2 * by_v - h * h / 4 * by_q)
            move = h * (v + h / 2 * rate)
            spring += (self._given[j] + self._on_motor(j)
                       + (h / 2 * friction_by_v - inertia) * rate)
            self._follow(j, move)
            self.position[j] += move
            self.velocity[j] += h * rate
        self.link_position[j], self.link_velocity[j] = end, end_velocity
        self._missing[j] = spring / count - (self._ends[j] + self._spring(j, 0, 0)) / 2

    def _add_laws(self, j, own):
        """The laws of joint j to what is given, and what warms it."""
        heat = 0.
        for law in self._laws[j] + self._held[j]:
            torque = law.at(self)
            self._drive[j] += torque
            if law.heats:
                heat -= torque * self.velocity[j]
        self._heat[j] = heat
        if j in self._springs:
            self._ends[j] = self._spring(j, 0, 0)
            self._drive[j] = own[j] = self._ends[j] + self._missing[j]
            slope = self._slope(lambda r: self._spring(j, 0, r), VELOCITY_STEP)
        else:
            own[j] += self._on_motor(j)
            slope = -self._friction_slope(j)
        self.damping[j] = max(0., slope)


def test(folder):
    """The largest difference from armcal's torques, readings and slopes, of the largest."""
    effects = Effects(os.path.join(folder, "effects.json"))
    with open(os.path.join(folder, "effects_test.json"), encoding="utf-8") as text:
        data = json.load(text)
    effects.reset(data["load"])
    effects.t, effects.warmth = data["t"], data["warmth"]
    worst = 0.
    for step in data["steps"]:
        found = {"reading": effects.sense(data["dt"], step["q"], step["qd"]),
                 "torque": effects.act(step["commanded"], step["load"])}
        found.update(damping=effects.damping, undamped=effects.undamped)
        for name, values in found.items():
            for value, expected in zip(values, step[name]):
                worst = max(worst, abs(value - expected) / data["largest"][name])
    return worst


def main():
    if sys.argv[1:2] != ["--test"]:
        sys.exit(__doc__)
    here = os.path.dirname(os.path.abspath(__file__))
    failed = False
    for folder in sys.argv[2:] or [here]:
        worst = test(folder)
        failed = failed or not worst <= 1e-9
        print(f"{folder}: {'FAILED' if not worst <= 1e-9 else 'ok'}: differs by {worst:.1e}")
    sys.exit(failed)


if __name__ == "__main__":
    main()
