#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Puts faults into copies of kernels/, one at a time, and says which tests notice; fails where none does. README.md
says more."""
import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple


class Fault(NamedTuple):
    """One of faults.json, which README.md describes."""

    name: str
    file: str
    right: str
    wrong: str
    check: str | None = None


FAULTS_FILE = Path(__file__).with_name("faults.json")
KERNELS = Path(__file__).resolve().parents[2] / "kernels"
# Suites whose tests take their kernels from NEPHROID_TEST_KERNELS, as GROUP.SUITE[:SUITE...], the quick ones first.
SUITES = [
    "kernels.Emission",
    "kernels.AreaPoint:CameraJitter:ReflectOrRefract:Uniforms:ClusterChoice", "kernels.EmissionSamplers",
    "kernels.LowDiscrepancy",
    "kernels.Guide", "kernels.PhotonMapTest", "kernels.Receivers", "kernels.Differential:PrismDifferential",
    "images.StoredPicture", "physics.RadianceInGlass",
    "physics.AreaLight", "physics.AbsorbingPlate:Contact:Nested:TotalReflection",
    "physics.Radiometry:Photons",
    "kernels.Trace:AgainstEmbree", "images.ErrorEstimate", "kernels.PhotonKernel",
    "physics.Background:BackgroundFurnace",
    "physics.Indirect:DiffuseFurnace", "physics.HalvesOfTheFilm:LowDiscrepancy:WholeClusters:WavelengthJitter",
    "physics.PhotonMaps:MapEstimators:ReceiverLight", "physics.MapBands", "physics.SmoothReceiver",
    "physics.SpectralDifferentials:Sweep",
    "physics.NormalMaps:RoughnessTextures:TintTextures",
    "kernels.Relighting", "physics.EnvironmentLight:HotTexel", "environment.Bake:Caustics",
    "inverse.DeviceFacetsTest:Judge:Colours:Assignment",
]


def command_of(build: Path, suites: str) -> list[str]:
    """What runs GROUP.SUITE[:SUITE...] of a build folder."""
    group, _, names = suites.partition(".")
    command = [str(build / f"tests/{group}/{group}_tests"),
               "--gtest_filter=" + ":".join(f"{name}.*:*/{name}.*" for name in names.split(":"))]
    try:
        if "\n  " in subprocess.run([*command, "--gtest_list_tests"], capture_output=True, text=True,
                                    check=True).stdout:
            return command
    except FileNotFoundError:
        pass
    sys.exit(f"run.py: {build}: there is no test {suites}; build the tests first")


def places(fault: Fault, folder: Path) -> int:
    """How often a kernel has the text that a fault replaces."""
    file = folder / fault.file
    return file.read_text().count(fault.right) if file.is_file() else 0


def check_texts(faults: list[Fault], kernels: Path) -> int:
    """Says which faults cannot be put in, because their kernel has changed; 1 where there are such."""
    stale = [f for f in faults if places(f, kernels) != 1 or f.wrong == f.right]
    for fault in stale:
        print(f"run.py: {FAULTS_FILE.name}, {fault.name!r}: {places(fault, kernels)} places in {fault.file} read "
              f"{fault.right!r}; one is expected")
    return 1 if stale else 0


def put_in(fault: Fault, folder: Path) -> None:
    """Changes the one place in a copy of the kernels."""
    if check_texts([fault], folder):
        sys.exit(1)
    file = folder / fault.file
    file.write_text(file.read_text().replace(fault.right, fault.wrong))


def failed_tests(command: list[str], kernels: Path, timeout_s: int) -> list[str]:
    """Names of the tests of a program that fail with these kernels. A crash or a hang counts, by the command."""
    environment = dict(os.environ, NEPHROID_TEST_KERNELS=str(kernels), POCL_CACHE_DIR=str(kernels.parent / "cache"))
    name = " ".join([Path(command[0]).name, *command[1:]])
    try:
        ended = subprocess.run(command, env=environment, cwd=kernels.parent, capture_output=True, text=True,
                               errors="replace", timeout=timeout_s)
    except subprocess.TimeoutExpired:
        return [f"{name} hangs"]
    failed = sorted(set(re.findall(r"^\[  FAILED  \] ([\w/]+\.[\w/]+)", ended.stdout, re.MULTILINE)))
    if ended.returncode != 0 and not failed:
        return [f"{name} exits with {ended.returncode}"]
    return failed


def run(commands: list[list[str]], fault: Fault | None, arguments: argparse.Namespace) -> list[str]:
    """The tests that fail with a fault, or with none."""
    with tempfile.TemporaryDirectory(prefix="nephroid-fault-") as folder:
        kernels = Path(folder) / "kernels"
        shutil.copytree(arguments.kernels, kernels)
        (Path(folder) / "cache").mkdir()
        if fault:
            put_in(fault, kernels)
        caught = []
        for command in commands:
            caught += failed_tests([part.replace("{kernels}", str(kernels)) for part in command], kernels,
                                   arguments.timeout)
            if caught and fault and not arguments.all:
                break
        return caught


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--build", type=Path, help="a build folder with its tests built")
    what.add_argument("--check-texts", action="store_true",
                      help="only see that every fault still finds its place in the kernels")
    parser.add_argument("--kernels", type=Path, default=KERNELS, help="the right kernels (default: kernels/)")
    parser.add_argument("--only", metavar="TEXT", action="append",
                        help="faults whose name contains this; may be given again")
    parser.add_argument("--suites", metavar="GROUP.SUITE", nargs="+", default=SUITES,
                        help="suites of tests, by name or pattern")
    parser.add_argument("--all", action="store_true",
                        help="run every test for every fault, rather than until one fails")
    parser.add_argument("--timeout", type=int, default=600,
                        help="seconds after which a suite hangs (default: %(default)s)")
    arguments = parser.parse_args()

    all_faults = [Fault(**f) for group in json.loads(FAULTS_FILE.read_text()).values() for f in group]
    faults = [f for f in all_faults if not arguments.only or any(text in f.name for text in arguments.only)]
    if not faults:
        sys.exit(f"run.py: --only: no fault has such a name; see {FAULTS_FILE.name}")
    if arguments.check_texts:
        return check_texts(faults, arguments.kernels)

    arguments.build = arguments.build.resolve()
    commands = [command_of(arguments.build, suites) for suites in arguments.suites]
    if arguments.suites == SUITES:
        commands.append([str(arguments.build / "bin/nephroid"), "check", "--kernels", "{kernels}"])
    # One state of the kernels for all faults, whatever happens to the folder meanwhile.
    with tempfile.TemporaryDirectory(prefix="nephroid-right-") as folder:
        arguments.kernels = shutil.copytree(arguments.kernels, Path(folder) / "kernels")
        return report(faults, commands, arguments)


def report(faults: list[Fault], commands: list[list[str]], arguments: argparse.Namespace) -> int:
    """Prints the table; 1 where a fault was noticed by no test."""
    wrongly = run(commands, None, arguments)
    if wrongly:
        sys.exit("run.py: without a fault there already fail: " + ", ".join(wrongly))

    print("| fault | in | caught by |\n|---|---|---|", flush=True)
    missed = 0
    for fault in faults:
        caught = run(commands, fault, arguments)
        missed += not caught
        print(f"| {fault.name} | {fault.file} | {', '.join(caught) or '**nothing**'} |", flush=True)
    print(f"{len(faults) - missed} of {len(faults)} faults caught", file=sys.stderr)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
