"""Prints the torques of a few steps beside a robot file; fails where these and what the file holds
(friction, springs, ripple, and what effects.json says stands in for other laws) leave something of the
torques with nothing beside. A delay that the file holds is not the module's."""
import json
import math
import sys

sys.path.insert(0, sys.argv[1])
import effects  # noqa: E402

FILE = sys.argv[1] + "/effects.json"
beside, alone = effects.Effects(FILE, beside=sys.argv[2]), effects.Effects(FILE)
with open(FILE, encoding="utf-8") as text:
    data = json.load(text)


def stand_in(j, v):
    """The torque that the robot file has in the stead of laws that it lacks, against joint j."""
    torque = 0.
    for effect in data["effects"]:
        if effect["joint_index"] != j + 1 or sys.argv[2] in effect["in"] or "share" not in effect:
            continue
        share = effect["share"]
        torque += share["viscous"] * v + share["coulomb"] * math.tanh(v / share["width"])
        if sys.argv[2] in data["joints"][j]["offset_in"]:
            torque += share["offset"]
    return torque


left = 0.
for k in range(20):
    q = [.1 * math.sin(.3 * k + j) for j in range(beside.n)]
    qd = [3 * math.cos(.3 * k + j) for j in range(beside.n)]
    u = [5 * math.sin(.2 * k + 2 * j) for j in range(beside.n)]
    for module in (beside, alone):
        module.sense(.01, q, qd)
    for j, (torque, whole) in enumerate(zip(beside.act(u), alone.act(u))):
        print(f"{torque:.9g} {beside.damping[j]:.9g}")
        if any(at == j and held for _, at, _, held in beside._commands):
            continue  # a motor's gain, which the file has
        held = sum(law.at(beside) for law in beside._held[j])
        left = max(left, abs(torque - stand_in(j, qd[j]) + held - whole))


class OfLaws:
    """A model with a joint more than the arm has, as robot.xml may have."""
    nv, nu, ntendon = beside.n + 1, beside.n, 0


try:
    alone.take_over(OfLaws)
    sys.exit("a model that has laws of its own is not to be taken over")
except ValueError:
    pass
if alone._lag_time:
    sys.exit(beside._lag_time != 0)
sys.exit(not left < 1e-9)
