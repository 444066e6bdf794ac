"""Builds the package by CMake; everything that is said about it stands in pyproject.toml.

The environment can name LYREFIT_BUILD, a build folder to use again (else one below build-python of the sources),
CMAKE_ARGS, further arguments for CMake, and LYREFIT_LICENCES, a file with the licences of what is linked in.
"""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

import setuptools
from setuptools.command.build_ext import build_ext
from setuptools.command.sdist import sdist

HERE = pathlib.Path(__file__).resolve().parent
# An archive of sources holds the project beside this file; in a checkout this file lies in the project.
SOURCES = HERE / "source" if (HERE / "source").is_dir() else HERE.parents[1]
OUT = SOURCES / "build-python"
# What the build reads of the project.
PARTS = ("CMakeLists.txt", "LICENSE", "README.md", "lib", "apps/lyrefit", "apps/plant", "apps/python", "apps/slurm",
         "cmake", "data/rtc_france", ".github/CHANGELOG.md")


def version():
    """The version that CMakeLists.txt declares."""
    return re.search(r"^project\(lyrefit VERSION ([0-9.]+)", (SOURCES / "CMakeLists.txt").read_text(), re.M)[1]


class BuildByCMake(build_ext):
    """Has CMake build the module and lays it, with its types, into the package."""

    def build_extension(self, extension):
        tag = f"{sys.version_info.major}.{sys.version_info.minor}"
        folder = pathlib.Path(os.environ.get("LYREFIT_BUILD") or OUT / tag).resolve()
        options = ["-DLYREFIT_WHEEL=ON", "-DLYREFIT_BUILD_PYTHON=ON", "-DLYREFIT_INSTALL=OFF",
                   f"-DPython3_EXECUTABLE={sys.executable}", *shlex.split(os.environ.get("CMAKE_ARGS", ""))]
        try:
            import pybind11
            options.append(f"-Dpybind11_ROOT={pybind11.get_cmake_dir()}")
        except ImportError:  # that of the machine, then
            pass
        # The script beside installs the parts of pages where npm is, and chooses the generator.
        subprocess.run(["bash", "-euc", 'source "$1/cmake/setup.sh"; Configure "$2" "${@:3}"; '
                        'Build "$2" --target lyrefit_python_stubs', "build", SOURCES, folder, *options], check=True)
        target = pathlib.Path(self.get_ext_fullpath(extension.name)).parent
        target.mkdir(parents=True, exist_ok=True)
        for built in sorted((folder / "apps/python/lyrefit").glob("_lyrefit.*")):
            shutil.copy2(built, target)
        shutil.copy2(SOURCES / "LICENSE", target)
        if licences := os.environ.get("LYREFIT_LICENCES"):
            shutil.copy2(licences, target / "licences.txt")


class WithSources(sdist):
    """An archive that holds the whole of what the build reads."""

    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        # The archive is gathered in a folder beside this file, which is no part of it.
        ignored = shutil.ignore_patterns("__pycache__", "node_modules", "*.egg-info", pathlib.Path(base_dir).name)
        for part in PARTS:
            to = pathlib.Path(base_dir, "source", part)
            to.parent.mkdir(parents=True, exist_ok=True)
            if (SOURCES / part).is_dir():
                shutil.copytree(SOURCES / part, to, ignore=ignored)
            else:
                shutil.copy2(SOURCES / part, to)


OUT.mkdir(exist_ok=True)
setuptools.setup(
    version=version(),
    packages=["lyrefit"],
    package_data={"lyrefit": ["py.typed"]},
    ext_modules=[setuptools.Extension("lyrefit._lyrefit", [])],
    cmdclass={"build_ext": BuildByCMake, "sdist": WithSources},
    options={"egg_info": {"egg_base": str(OUT)}, "build": {"build_base": str(OUT / "setuptools")}},
)
