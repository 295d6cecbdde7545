"""Bare systems as folders: a Debian with Python and nothing of armcal."""

import os
import pathlib
import shutil
import subprocess

# Of this machine, so that pip and apt of the bare one reach the network.
NETWORK = ("/etc/resolv.conf", "/etc/ssl/certs/ca-certificates.crt")
PASSED_ON = ("http_proxy", "https_proxy", "no_proxy", "PIP_INDEX_URL")


def kept(suite, folder):
    """The untouched system, which is made where it is not kept in `folder`."""
    root = folder / suite
    if not root.exists():
        print(f"{suite}: debootstrap, once", flush=True)
        folder.mkdir(parents=True, exist_ok=True)
        made = folder / (suite + ".made")
        shutil.rmtree(made, ignore_errors=True)
        subprocess.run(["debootstrap", "--variant=minbase",
                        "--include=python3,python3-venv", suite, made,
                        "http://deb.debian.org/debian"],
                       check=True, stdout=subprocess.DEVNULL)
        made.rename(root)
    return root


class BareRoot:
    """A copy of such a system, which `with` removes again."""

    def __init__(self, suite, folder):
        self.root = folder / (suite + ".used")
        shutil.rmtree(self.root, ignore_errors=True)
        subprocess.run(["cp", "-a", kept(suite, folder), self.root], check=True)
        for file in NETWORK:
            (self.root / file[1:]).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, self.root / file[1:])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        shutil.rmtree(self.root)

    def path(self, path):
        return self.root / pathlib.Path(path).relative_to("/")

    def run(self, command, check=True):
        """A line of sh in /root, in the system; returns what it prints."""
        environment = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root",
                       "LANG": "C.UTF-8", "DEBIAN_FRONTEND": "noninteractive",
                       "PIP_CERT": NETWORK[1], "PIP_ROOT_USER_ACTION": "ignore"}
        environment.update((name, os.environ[name]) for name in PASSED_ON
                           if name in os.environ)
        # Its own /proc, which goes when the command ends.
        done = subprocess.run(
            ["unshare", "--mount", "--pid", "--fork", "sh", "-ec",
             'mount -t proc proc "$0/proc"; exec chroot "$0" sh -ec "cd /root; $1"',
             self.root, command],
            env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            text=True)
        if check and done.returncode != 0:
            raise SystemExit(f"{self.root.name}: {command}\n{done.stdout}"
                             f"exit code {done.returncode}")
        return done.stdout
