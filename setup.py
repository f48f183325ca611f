# SPDX-License-Identifier: MIT
"""Builds swivel._core, the Python package's extension module, by CMake from tools/python. pyproject.toml has the rest.

If CMake finds an installed swivel of the same version (CMAKE_PREFIX_PATH), the module links it. Otherwise CMake builds the library, too.
The environment variable CMAKE_ARGS passes options to CMake, such as "-DSWIVEL_TBB=OFF".
"""
import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent


def pybind11_folder():
    """Tells CMake where a pybind11 is that pip installed. CMake finds that of the system by itself."""
    try:
        import pybind11
    except ImportError:
        return []
    return [f"-Dpybind11_DIR={pybind11.get_cmake_dir()}"]


def generator(build, arguments):
    """Chooses Ninja if it is installed, because a system may have no make. The caller's choice and that of a build folder come first."""
    chosen = ("CMAKE_GENERATOR" in os.environ or any(each.startswith("-G") for each in arguments)
              or (build / "CMakeCache.txt").exists())
    return [] if chosen or not shutil.which("ninja") else ["-G", "Ninja"]


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        folder = Path(self.get_ext_fullpath(ext.name)).resolve().parent
        build = Path(self.build_temp).resolve() / ext.name
        given = shlex.split(os.environ.get("CMAKE_ARGS", ""))
        subprocess.check_call(["cmake", "-S", str(ROOT / "tools" / "python"), "-B", str(build), "-DCMAKE_BUILD_TYPE=Release",
                               "-DSWIVEL_HARDEN=ON", f"-DPython_EXECUTABLE={sys.executable}", f"-DSWIVEL_PYTHON_FOLDER={folder}",
                               *pybind11_folder(), *generator(build, given), *given])
        jobs = str(self.parallel or os.cpu_count() or 1)
        subprocess.check_call(["cmake", "--build", str(build), "--target", "swivel_python", "--parallel", jobs])


version = re.search(r"project\(swivel VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))
setup(version=version[1], ext_modules=[Extension("swivel._core", sources=[])], cmdclass={"build_ext": CMakeBuild})
