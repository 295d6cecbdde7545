"""A robot file in MuJoCo, and armcal's logs for it."""

import csv
import gzip

import mujoco
import numpy as np


class Log:
    """q, qd, tau (samples x joints, SI units) at times t of an armcal CSV."""

    def __init__(self, path, half_window=0.02):
        opener = gzip.open if path.endswith(".gz") else open
        with opener(path, "rt") as file:
            rows = csv.reader(file)
            names = [name.strip() for name in next(rows)]
            table = np.array([[float(x) for x in row] for row in rows if row])
        n = sum(name.startswith("tau") for name in names)
        of = {name: table[:, i] for i, name in enumerate(names)}

        def columns(kind):
            return np.stack([of[f"{kind}{j + 1}"] for j in range(n)], axis=1)

        self.t = of["t"]
        keep = np.concatenate([[True], np.diff(self.t) > 0])
        self.t = self.t[keep]
        self.q = columns("q")[keep]
        self.tau = columns("tau")[keep]
        self.smooth(half_window)

    def smooth(self, half_window):
        """Position, velocity and acceleration by a local cubic, from q alone:
        the same for every robot that is compared."""
        step = np.median(np.diff(self.t))
        uniform = np.arange(self.t[0], self.t[-1], step)
        h = max(3, int(round(half_window / step)))
        powers = np.arange(-h, h + 1)[:, None] * step
        fit = np.linalg.pinv(powers ** np.arange(4))
        n = self.q.shape[1]
        q = np.stack([np.interp(uniform, self.t, self.q[:, j]) for j in range(n)], 1)
        kernel = lambda row: np.stack(
            [np.convolve(q[:, j], fit[row][::-1], "valid") for j in range(n)], 1)
        self.tau_at = lambda t: np.array(
            [np.interp(t, self.t, self.tau[:, j]) for j in range(n)]).T
        self.grid = uniform[h:-h]
        self.grid_q, self.grid_qd, self.grid_qdd = (
            kernel(0), kernel(1), 2 * kernel(2))
        self.step = step


class Arm:
    """A robot file, its joints in the file's order, driven by joint torques.

    Actuators of the file are used where there is one per joint (they hold a
    joint's constant torque and gain); else torques are applied to the joints.
    """

    def __init__(self, path, timestep=5e-4):
        self.model = mujoco.MjModel.from_xml_path(path)
        self.model.opt.timestep = timestep
        self.model.opt.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        self.model.opt.disableflags |= (
            mujoco.mjtDisableBit.mjDSBL_CONTACT | mujoco.mjtDisableBit.mjDSBL_LIMIT)
        self.data = mujoco.MjData(self.model)
        self.by_actuators = self.model.nu == self.model.nv

    @property
    def n(self):
        return self.model.nv

    def inverse(self, q, qd, qdd):
        """mj_inverse, friction and all, N m."""
        d = self.data
        d.qpos[:], d.qvel[:], d.qacc[:] = q, qd, qdd
        mujoco.mj_inverse(self.model, d)
        return d.qfrc_inverse.copy()

    def saturated(self):
        """Per joint: whether dry friction gives all of frictionloss."""
        d, m = self.data, self.model
        result = np.ones(self.n, bool)
        for i in range(d.nefc):
            if d.efc_type[i] == mujoco.mjtConstraint.mjCNSTR_FRICTION_DOF:
                quadratic = mujoco.mjtConstraintState.mjCNSTRSTATE_QUADRATIC
                result[d.efc_id[i]] = d.efc_state[i] != quadratic
        return result

    def replay(self, log, begin, end):
        """Positions at log.grid[begin:end], open loop from the state there."""
        m, d = self.model, self.data
        mujoco.mj_resetData(m, d)
        d.qpos[:], d.qvel[:] = log.grid_q[begin], log.grid_qd[begin]
        t0 = log.grid[begin]
        times = log.grid[begin:end]
        steps = int(np.ceil((times[-1] - t0) / m.opt.timestep))
        middles = t0 + (np.arange(steps) + 0.5) * m.opt.timestep
        torques = log.tau_at(middles)
        path = np.empty((steps + 1, self.n))
        path[0] = d.qpos
        for k in range(steps):
            if self.by_actuators:
                d.ctrl[:] = torques[k]
            else:
                d.qfrc_applied[:] = torques[k]
            mujoco.mj_step(m, d)
            path[k + 1] = d.qpos
        at = t0 + np.arange(steps + 1) * m.opt.timestep
        return np.stack([np.interp(times, at, path[:, j]) for j in range(self.n)], 1)

    def fit_friction(self, log, lowpass=5e-2):
        """Viscous and Coulomb friction of every joint by least squares on the
        log, with a constant torque beside them so that none of it is taken for
        friction; negative ones are 0. What else the file has stays."""
        m = self.model
        m.dof_damping[:], m.dof_frictionloss[:] = 0, 0
        if hasattr(m, "dof_dampingpoly"):
            m.dof_dampingpoly[:] = 0
        tau = log.tau_at(log.grid)
        rigid = np.array([self.inverse(*x) for x in
                          zip(log.grid_q, log.grid_qd, log.grid_qdd)])
        width = max(1, int(lowpass / log.step))
        low = lambda x: np.convolve(x, np.ones(width) / width, "valid")
        for j in range(self.n):
            v = log.grid_qd[:, j]
            columns = [low(v), low(np.sign(v)), low(np.ones_like(v))]
            rest = low(tau[:, j] - rigid[:, j])
            x = np.linalg.lstsq(np.stack(columns, 1), rest, rcond=None)[0]
            m.dof_damping[j] = max(0, x[0])
            m.dof_frictionloss[j] = max(0, x[1])
        return m.dof_damping.copy(), m.dof_frictionloss.copy()
