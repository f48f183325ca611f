# SPDX-License-Identifier: MIT
"""The promise: `pip install` builds and installs the package without a network, with the system's own packages, from a source
distribution that holds all it needs, and links an installed swivel where there is one. The module is guarded as a released one.

    test_package.py BUILD FOLDER    BUILD: a build of swivel to install; FOLDER: an own folder, emptied first
"""
import os
import shutil
import subprocess
import sys
import tarfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
SOURCES = ("CHANGELOG.md", "CMakeLists.txt", "LICENSE", "MANIFEST.in", "README.md", "SECURITY.md", "pyproject.toml", "setup.py",
           "batch", "cmake", "core", "include", "simd", "tools/cache", "tools/crowd", "tools/formats", "tools/headers", "tools/python")
USE = """
import sys, pathlib, importlib.metadata, swivel
folder = pathlib.Path(swivel.__file__).parent
assert folder.is_relative_to(sys.prefix), folder
assert importlib.metadata.version("swivel") == swivel.__version__
assert (folder / "py.typed").exists() and "class Field(enum.IntEnum):" in (folder / "_core.pyi").read_text()
arms = swivel.solve([[0.3, 0.1, 0.3], [0, 0.2, 9]], (0, -1, 0), (0.30, 0.26))
assert [swivel.Flag(int(bits)) for bits in arms.flags] == [swivel.Flag.REACHED, swivel.Flag.CLAMPED_FAR]
"""


def run(*command, **environment):
    clean = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "PIP_", "CMAKE_"))}
    offline = {"PIP_NO_INDEX": "1", "PIP_DISABLE_PIP_VERSION_CHECK": "1", "PIP_CONFIG_FILE": os.devnull}
    done = subprocess.run([str(each) for each in command], env={**clean, **offline, **environment}, cwd=FOLDER, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}\nfailed: {done.returncode}")
    return done.stdout


def source_distribution():
    """Built from a copy, since setuptools writes beside its sources; with every file that compiles."""
    copy = FOLDER / "source"
    for name in SOURCES:
        (copy / name).parent.mkdir(parents=True, exist_ok=True)
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, copy / name, ignore=shutil.ignore_patterns("__pycache__", "*.egg-info"))
        else:
            shutil.copy2(ROOT / name, copy / name)
    build = "import os, sys; os.chdir(sys.argv[1]); from setuptools import build_meta; build_meta.build_sdist(sys.argv[2])"
    run(sys.executable, "-c", build, copy, FOLDER)
    [archive] = FOLDER.glob("swivel-*.tar.gz")
    with tarfile.open(archive) as files:
        held = {name.partition("/")[2] for name in files.getnames()}
    if "SECURITY.md" not in held:
        sys.exit("the source distribution lacks SECURITY.md")
    for folder in ("batch", "cmake", "core", "include", "simd", "tools/cache", "tools/python"):
        files = {str(path.relative_to(ROOT)) for path in (ROOT / folder).rglob("*.*") if path.suffix != ".pyc" and path.is_file()}
        if files - held:
            sys.exit(f"the source distribution lacks {sorted(files - held)}")
    return archive


def main():
    archive = source_distribution()
    run("cmake", "--install", BUILD, "--prefix", FOLDER / "installed")
    run(sys.executable, "-m", "venv", "--system-site-packages", "--without-pip", FOLDER / "env")
    python = FOLDER / "env" / "bin" / "python"
    said = run(python, "-m", "pip", "install", "--verbose", "--no-build-isolation", archive, CMAKE_PREFIX_PATH=str(FOLDER / "installed"),
               CMAKE_ARGS="-DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS=-O1")  # most of the time here is the compiler's
    if f": installed, {FOLDER / 'installed'}" not in said:
        sys.exit(f"{said}\nthe installed swivel was not linked")
    run(python, "-c", USE)
    [module] = (FOLDER / "env").rglob("_core*.so")
    run(ROOT / "tools/release/hardened", module)
    run(python, "-m", "pip", "uninstall", "--yes", "swivel")
    left = [str(path) for path in (FOLDER / "env").rglob("*swivel*")]
    if left:
        sys.exit(f"pip uninstall left {left}")


if __name__ == "__main__":
    BUILD, FOLDER = (Path(argument).resolve() for argument in sys.argv[1:])
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    main()
