"""Builds the module and the program of the Python package with CMake."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent
MODULE = "_armcal" + sysconfig.get_config_var("EXT_SUFFIX")
BUILD = pathlib.Path(os.environ.get("ARMCAL_BUILD", ROOT / "build" / "pip"))


class CMakeBuild(build_ext):
    """In build/pip, or the build folder ARMCAL_BUILD, which may be there."""

    def build_extension(self, ext):
        module = BUILD / "python" / "armcal" / MODULE
        if not module.exists():  # else that build is of this Python already
            self.configure()
        subprocess.run(["cmake", "--build", BUILD, "--target", "python_module",
                        "armcal", "--parallel", str(os.cpu_count() or 1)],
                       check=True)
        target = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve()
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(module, target)
        program = target.parent.parent / "armcal_program"
        if program.exists():  # not in an editable install
            shutil.copy2(BUILD / "armcal", program / "armcal")

    def configure(self):
        configure = ["cmake", "-S", ROOT, "-B", BUILD, "-DPYTHON=ON",
                     f"-DPython_EXECUTABLE={sys.executable}"]
        if not (BUILD / "CMakeCache.txt").exists():
            configure += ["-DBUILD_TESTING=OFF"]
            if shutil.which("ninja"):
                configure += ["-G", "Ninja"]
            if shutil.which("ccache"):
                configure += ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"]
        subprocess.run(configure, check=True)


VERSION = re.search(r"project\(armcal VERSION (\S+)",
                    (ROOT / "CMakeLists.txt").read_text()).group(1)

setup(version=VERSION, ext_modules=[Extension("armcal._armcal", sources=[])],
      cmdclass={"build_ext": CMakeBuild},
      options={"build": {"build_base": str(BUILD / "wheel_files")}})
