"""Chains and inverse dynamics of robot files by MuJoCo and by Pinocchio."""

import dataclasses
import pathlib
from xml.etree import ElementTree

import numpy as np


@dataclasses.dataclass
class Chain:
    """Joints from a base to a tip. `base` is empty where it is the file's
    root; `coupled` are those of its joints that something beside the chain ties
    to others, in the file's words."""
    base: str
    tip: str
    joints: list  # numbers in the reference's model
    coupled: dict  # of those, why


class MujocoFile:
    """An MJCF file (or URDF) as MuJoCo compiles it."""

    def __init__(self, path):
        import mujoco
        self.mj = mujoco
        self.model = mujoco.MjModel.from_xml_path(str(path))
        self.data = mujoco.MjData(self.model)

    def name(self, kind, number):
        return self.mj.mj_id2name(
            self.model, getattr(self.mj.mjtObj, "mjOBJ_" + kind), number) or ""

    def joint_name(self, j):
        return self.name("JOINT", j)

    def joints_above(self, body):
        """From the world to `body`."""
        m, joints = self.model, []
        while body > 0:
            first = m.body_jntadr[body]
            joints = list(range(first, first + m.body_jntnum[body])) + joints
            body = m.body_parentid[body]
        return joints

    def is_plain(self, j):
        return int(self.model.jnt_type[j]) in (
            int(self.mj.mjtJoint.mjJNT_HINGE), int(self.mj.mjtJoint.mjJNT_SLIDE))

    def couplings(self):
        """{joint: what ties it to others}. A connection of two bodies couples
        the joints on the way from one to the other."""
        m, mj, coupled = self.model, self.mj, {}
        for e in range(m.neq):
            if not m.eq_active0[e]:
                continue
            kind, a, b = (int(x[e]) for x in
                          (m.eq_type, m.eq_obj1id, m.eq_obj2id))
            if kind == int(mj.mjtEq.mjEQ_JOINT):
                tied = [j for j in (a, b) if j >= 0]
            elif kind in (int(mj.mjtEq.mjEQ_CONNECT), int(mj.mjtEq.mjEQ_WELD)):
                if int(m.eq_objtype[e]) == int(mj.mjtObj.mjOBJ_SITE):
                    a, b = m.site_bodyid[a], m.site_bodyid[b]
                if max(m.body_mocapid[a], m.body_mocapid[b]) >= 0:
                    continue  # a handle of the simulation, not of the robot
                tied = set(self.joints_above(a)) ^ set(self.joints_above(b))
            elif kind == int(mj.mjtEq.mjEQ_TENDON):
                tied = self.tendon_joints(a) | (
                    self.tendon_joints(b) if b >= 0 else set())
            else:
                continue
            for j in tied:
                coupled.setdefault(j, f"equality {e} {self.name('EQUALITY', e)}")
        for t in range(m.ntendon):
            joints = self.tendon_joints(t)
            # An actuator of one joint's tendon is that joint's own.
            acts = (m.tendon_stiffness[t] or m.tendon_damping[t] or
                    m.tendon_frictionloss[t] or m.tendon_armature[t] or
                    len(joints) > 1 and any(
                        int(m.actuator_trntype[k]) ==
                        int(mj.mjtTrn.mjTRN_TENDON) and
                        m.actuator_trnid[k, 0] == t
                        for k in range(m.nactuator)))
            for j in joints if acts else ():
                coupled.setdefault(j, f"tendon {self.name('TENDON', t)}")
        return coupled

    def tendon_joints(self, t):
        m, mj = self.model, self.mj
        first, joints, bodies = m.tendon_adr[t], set(), []
        for w in range(first, first + m.tendon_num[t]):
            kind, number = int(m.wrap_type[w]), int(m.wrap_objid[w])
            if kind == int(mj.mjtWrap.mjWRAP_JOINT):
                joints.add(number)
            elif kind == int(mj.mjtWrap.mjWRAP_SITE):
                bodies.append(m.site_bodyid[number])
            elif kind in (int(mj.mjtWrap.mjWRAP_SPHERE),
                          int(mj.mjtWrap.mjWRAP_CYLINDER)):
                bodies.append(m.geom_bodyid[number])
        for a, b in zip(bodies, bodies[1:]):
            joints |= set(self.joints_above(a)) ^ set(self.joints_above(b))
        return joints

    def chains(self):
        """One per named body: from the world, or from behind the last free or
        ball joint."""
        m, coupled = self.model, self.couplings()
        for body in range(1, m.nbody):
            joints = self.joints_above(body)
            if not self.name("BODY", body):
                continue
            base = 0
            for i in reversed(range(len(joints))):
                if not self.is_plain(joints[i]):
                    base = m.jnt_bodyid[joints[i]]
                    joints = joints[i + 1:]
                    break
            if joints and (base == 0 or self.name("BODY", base)):
                yield Chain(self.name("BODY", base) if base else "",
                            self.name("BODY", body), joints,
                            {j: coupled[j] for j in joints if j in coupled})

    def gravity(self, base):
        """In the frame of the body `base`, where every joint is at zero."""
        m, d = self.model, self.data
        self.mj.mj_resetData(m, d)
        d.qpos[:] = m.qpos0
        self.mj.mj_kinematics(m, d)
        number = self.mj.mj_name2id(m, self.mj.mjtObj.mjOBJ_BODY,
                                    base) if base else 0
        g = m.opt.gravity * (
            not m.opt.disableflags & self.mj.mjtDisableBit.mjDSBL_GRAVITY)
        return d.xmat[number].reshape(3, 3).T @ g

    def drop_beside(self, chain):
        """Bodies beyond balls and the like beside the chain weigh nothing."""
        m = self.model
        base = set(self.joints_above(m.jnt_bodyid[chain.joints[0]])) - set(
            chain.joints)
        for body in range(1, m.nbody):
            others = set(self.joints_above(body)) - set(chain.joints) - base
            if not all(map(self.is_plain, others)):
                m.body_mass[body] = 0
                m.body_inertia[body] = 0

    def held(self, chain):
        """Positions with every joint next to 0, but for those before the
        chain."""
        m = self.model
        q = m.qpos0.copy()
        before = set(self.joints_above(m.jnt_bodyid[chain.joints[0]])) - set(
            chain.joints)
        for j in set(filter(self.is_plain, range(m.njnt))) - before:
            q[m.jnt_qposadr[j]] = np.clip(0, *m.jnt_range[j]) if (
                m.jnt_limited[j]) else 0
        return q

    def torques(self, chain, q, qd, qdd):
        m, d, mj = self.model, self.data, self.mj
        self.drop_beside(chain)
        held = self.held(chain)
        at = m.jnt_qposadr[chain.joints]
        dof = m.jnt_dofadr[chain.joints]
        found = []
        for k in range(len(q)):
            mj.mj_resetData(m, d)
            d.qpos[:] = held
            d.qpos[at], d.qvel[dof], d.qacc[dof] = q[k], qd[k], qdd[k]
            mj.mj_fwdPosition(m, d)
            mj.mj_fwdVelocity(m, d)
            result = np.zeros(m.nv)
            mj.mj_rne(m, d, 1, result)
            found.append(result[dof])
        return np.array(found)

    def joint_terms(self, chain):
        dof = self.model.jnt_dofadr[chain.joints]
        m = self.model
        return {"viscous": m.dof_damping[dof], "coulomb": m.dof_frictionloss[dof],
                "armature": m.dof_armature[dof]}

    version = property(lambda self: "mujoco")


class PinocchioFile:
    """A URDF file as Pinocchio reads it."""

    def __init__(self, path):
        import pinocchio
        self.pin = pinocchio
        # By text, as Pinocchio asks for the ending .urdf.
        text = pathlib.Path(path).read_text(errors="replace")
        self.model = pinocchio.buildModelFromXML(text)
        root = ElementTree.fromstring(text)
        self.child = {j.get("name"): j.find("child").get("link")
                      for j in root.findall("joint")}
        self.coupled, self.mimic = {}, {}
        for joint in root.findall("joint"):
            mimic = joint.find("mimic")
            if mimic is not None:
                self.mimic[joint.get("name")] = (
                    mimic.get("joint"), float(mimic.get("multiplier", 1)),
                    float(mimic.get("offset", 0)))
                why = f"{joint.get('name')} mimics {mimic.get('joint')}"
                self.coupled[joint.get("name")] = why
                # A follower without mass loads its leader with nothing.
                if self.moved_mass(joint.get("name")) > 0:
                    self.coupled.setdefault(mimic.get("joint"), why)

    def moved_mass(self, joint):
        """Of all links beyond it, kg."""
        if not self.model.existJointName(joint):
            return 0
        beyond = self.model.subtrees[self.model.getJointId(joint)]
        return sum(self.model.inertias[j].mass for j in beyond)

    def joint_name(self, j):
        return self.model.names[j]

    def is_plain(self, j):
        return self.model.joints[j].nv == 1

    def chains(self):
        for last in range(1, self.model.njoints):
            if self.joint_name(last) not in self.child:
                continue
            joints, j = [], last
            while j > 0 and self.is_plain(j):
                joints.insert(0, j)
                j = self.model.parents[j]
            if joints:
                yield Chain(self.child[self.joint_name(j)] if j > 0 else "",
                            self.child[self.joint_name(last)], joints,
                            {k: self.coupled[self.joint_name(k)] for k in joints
                             if self.joint_name(k) in self.coupled})

    def gravity(self, base):
        if not base:
            return self.model.gravity.linear
        data = self.model.createData()
        self.pin.framesForwardKinematics(self.model, data,
                                         self.pin.neutral(self.model))
        frame = self.model.getFrameId(base)
        return data.oMf[frame].rotation.T @ self.model.gravity.linear

    def held(self, chain):
        """As MujocoFile.held; joints that follow others are where these put
        them."""
        m, q = self.model, self.pin.neutral(self.model)

        def position(j):
            name = self.joint_name(j)
            if name in self.mimic and self.model.existJointName(
                    self.mimic[name][0]):
                leader, factor, offset = self.mimic[name]
                return factor * position(m.getJointId(leader)) + offset
            at = m.joints[j].idx_q
            return np.clip(0, m.lowerPositionLimit[at],
                           m.upperPositionLimit[at]) if (
                               m.joints[j].nq == 1) else 0

        for j in range(1, m.njoints):
            if not self.is_plain(j) or j in m.supports[chain.joints[0]]:
                continue
            at = m.joints[j].idx_q
            q[at:at + m.joints[j].nq] = position(j) if (
                m.joints[j].nq == 1) else [1, 0]
        return q

    def torques(self, chain, q, qd, qdd):
        pin, m = self.pin, self.model
        before = m.supports[chain.joints[0]]
        for j in range(1, m.njoints):
            beside = [k for k in m.supports[j] if k > 0 and
                      k not in chain.joints and k not in before]
            if not all(map(self.is_plain, beside)):
                m.inertias[j] = pin.Inertia.Zero()
        held = self.held(chain)
        m.armature[:] = 0
        data, found = m.createData(), []
        v_at = [m.joints[j].idx_v for j in chain.joints]
        for k in range(len(q)):
            full_q = held.copy()
            v, a = np.zeros(m.nv), np.zeros(m.nv)
            v[v_at], a[v_at] = qd[k], qdd[k]
            for j, x in zip(chain.joints, q[k]):
                at = m.joints[j].idx_q
                if m.joints[j].nq == 2:  # a continuous joint
                    full_q[at:at + 2] = np.cos(x), np.sin(x)
                else:
                    full_q[at] = x
            found.append(pin.rnea(m, data, full_q, v, a)[v_at])
        return np.array(found)

    def joint_terms(self, chain):
        v_at = [self.model.joints[j].idx_v for j in chain.joints]
        return {"viscous": self.model.damping[v_at]}

    version = property(lambda self: "pin")


def load(kind, path):
    """The reference that loads the file, and why others did not."""
    why = []
    for reader in ((PinocchioFile, MujocoFile) if kind == "URDF" else
                   (MujocoFile,)):
        try:
            return reader(path), why
        except Exception as error:  # whatever a reader says: it is not read
            why.append(f"{reader.__name__}: {' '.join(str(error).split())}")
    return None, why
