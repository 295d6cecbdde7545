"""Prints the torques of a few steps beside robot_plain.xml, and what these and the file's friction
(viscous, dry, constant, spring) leave of the torques with nothing beside."""
import math
import sys

sys.path.insert(0, sys.argv[1])
import effects  # noqa: E402

FILE = sys.argv[1] + "/effects.json"
beside, alone = effects.Effects(FILE, beside="mjcf_plain"), effects.Effects(FILE)
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
        share = sum(law.at(beside) for law in beside._shares[j])
        left = max(left, abs(torque - share + held - whole))
sys.exit(not left < 1e-9)
