"""Builds the module of the Python package with CMake."""

import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    """In build/pip, or the build folder ARMCAL_BUILD, which may be there."""

    def build_extension(self, ext):
        build = os.environ.get("ARMCAL_BUILD", str(ROOT / "build" / "pip"))
        configure = ["cmake", "-S", str(ROOT), "-B", build, "-DPYTHON=ON",
                     f"-DPython_EXECUTABLE={sys.executable}"]
        if not os.path.exists(os.path.join(build, "CMakeCache.txt")):
            configure += ["-DBUILD_TESTING=OFF"]
            if shutil.which("ninja"):
                configure += ["-G", "Ninja"]
            if shutil.which("ccache"):
                configure += ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"]
        subprocess.run(configure, check=True)
        subprocess.run(["cmake", "--build", build, "--target", "python_module",
                        "--parallel", str(os.cpu_count() or 1)], check=True)
        built = next(pathlib.Path(build, "python", "armcal").glob("_armcal*.so"))
        target = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve()
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(built, target)


VERSION = re.search(r"project\(armcal VERSION (\S+)",
                    (ROOT / "CMakeLists.txt").read_text()).group(1)

setup(version=VERSION, ext_modules=[Extension("armcal._armcal", sources=[])],
      cmdclass={"build_ext": CMakeBuild})
