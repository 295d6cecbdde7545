"""Double pendulum, sysid runs of one robot and day (SOURCE.md): nothing changes."""
from checks import names_only
from runs import diagnose

PART = "evaluation"
LATER = [f"C1_sysid_{k:02}" for k in range(6, 11)]
REFERENCE = ",".join(f"C1_sysid_{k:02}.csv" for k in range(1, 6))
RUNS = {log: diagnose("--robot=robot_C.urdf", f"--reference={REFERENCE}",
                      f"--log={log}.csv") for log in LATER}


CHECKS = [names_only(log) for log in LATER]
