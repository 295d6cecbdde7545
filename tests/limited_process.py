"""Processes and what they took; one under limits."""

import os
import resource
import subprocess
import threading


def wait_for(process):
    """Waits for a subprocess.Popen, whose returncode is set; its CPU time in seconds and
    the most memory that it had in bytes."""
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss << 10


class LimitedProcess:
    """Ran to its end: exit code (minus the signal that ended it), `out` and `err`, the most
    memory in bytes, and its CPU time in seconds."""

    def __init__(self, command, folder, streams, limits, hangs, environment=None):
        """`streams`: files for stdout and stderr. `limits`: {resource: most}. Killed after
        `hangs` seconds by the clock."""
        with open(streams[0], "wb") as out, open(streams[1], "wb") as err:
            process = subprocess.Popen(command, cwd=folder, stdout=out, stderr=err,
                                       stdin=subprocess.DEVNULL, env=environment)
            for kind, most in limits.items():
                # The address sanitizer's own take terabytes.
                if kind == resource.RLIMIT_AS and "ASAN_OPTIONS" in os.environ:
                    continue
                resource.prlimit(process.pid, kind, (most, most))
            timer = threading.Timer(hangs, process.kill)
            timer.start()
            self.seconds, self.bytes = wait_for(process)
            timer.cancel()
        self.code = process.returncode
        self.out, self.err = (s.read_text(errors="replace") for s in streams)
