"""Puts the licences of what a wheel holds of others beside armcal's own.

In licenses/ of its .dist-info: Debian's file `copyright` of every package that a
library came from, the licences that these name, and LIBRARIES.txt, which says
which library is of which package and version, and so where its source is.
"""

import pathlib
import re
import shutil
import subprocess
from importlib import metadata

# What is compiled in, which no file of the wheel shows; pybind11's version is that
# of requirements.txt.
COMPILED_IN = ("libceres-dev", "libeigen3-dev", "nlohmann-json3-dev",
               "libjs-dygraphs", "pybind11-dev")
COMMON = pathlib.Path("/usr/share/common-licenses")

HEADER = """\
armcal's own licence is Apache-2.0 (LICENSE). This wheel also holds libraries as
Debian has built them, changed in nothing but the names by which they find each
other; the licence of each is in PACKAGE.txt. SuiteSparse's SPQR and parts of its
CHOLMOD are under the GPL, so that the wheel as a whole may be passed on under the
GPL, version 3. The source of each is Debian's source package of that version:
`apt-get source PACKAGE=VERSION`, or https://snapshot.debian.org.

"""


def package_of(library):
    """Debian's package of the file that auditwheel copied: it renames
    libz.so.1.2 to libz-0123abcd.so.1.2."""
    name = re.sub(r"-[0-9a-f]{8}(?=\.)", "", library.name)
    found = subprocess.run(["dpkg-query", "--search", "*/" + name], check=True,
                           stdout=subprocess.PIPE, text=True).stdout
    return found.split(":")[0]


def version_of(package):
    return subprocess.run(
        ["dpkg-query", "--show", "--showformat=${Version}", package],
        check=True, stdout=subprocess.PIPE, text=True).stdout


def write(tree):
    """Into the unpacked wheel `tree`."""
    info, = tree.glob("*.dist-info")
    folder = info / "licenses"
    folder.mkdir(exist_ok=True)
    lines, packages = [], set(COMPILED_IN)
    for library in sorted(tree.glob("*.libs/*")):
        package = package_of(library)
        packages.add(package)
        lines.append(f"{library.name}  {package} {version_of(package)}")
    for package in COMPILED_IN:
        version = (f"{metadata.version('pybind11')} of PyPI"
                   if package == "pybind11-dev" else version_of(package))
        lines.append(f"(compiled in)  {package} {version}")
    (folder / "LIBRARIES.txt").write_text(HEADER + "\n".join(lines) + "\n")
    named = set()
    for package in packages:
        file = pathlib.Path("/usr/share/doc", package, "copyright")
        text = file.read_text(errors="replace")
        named |= set(re.findall(rf"{COMMON}/([\w.-]*\w)", text))
        shutil.copy(file, folder / f"{package}.txt")
    for name in sorted(named):
        if (COMMON / name).exists():
            shutil.copy(COMMON / name, folder / name)
