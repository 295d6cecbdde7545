"""Double pendulum, sysid runs of one robot and day (SOURCE.md): nothing changes."""
from reading import claims, told

PART = "evaluation"
LATER = [f"C1_sysid_{k:02}" for k in range(6, 11)]
REFERENCE = ",".join(f"C1_sysid_{k:02}.csv" for k in range(1, 6))
RUNS = {log: ("diagnose", ["--robot=robot_C.urdf", f"--reference={REFERENCE}",
                           f"--log={log}.csv"], "diagnosis.json") for log in LATER}


def control_of(log):
    def check(runs):
        return not claims(runs[log]), told(runs[log])
    check.__doc__ = f"{log}: nothing is named"
    return check


CHECKS = [control_of(log) for log in LATER]
