"""Same input, same bytes: one hash a scene over compilers, optimisation levels, thread counts and machines.

Builds `determinism_driver` with each preset below, runs it, with one thread here and two there, and compares what it
prints; with --all on more builds, and with both. The driver compresses generated meshes and hashes the files, the
rebuilt meshes and values of the field.
"""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# preset: the compiler it needs, thread counts to try, with --all also, and the emulator that runs it
PRESETS: dict[str, tuple[str, list[int], list[int], list[str]]] = {
    "release": ("g++", [2], [1], []),
    "gcc-O0": ("g++", [], [2], []),
    "clang-O3": ("clang++", [1], [2], []),
    "aarch64": ("aarch64-linux-gnu-g++", [1], [], ["qemu-aarch64", "-L", "/usr/aarch64-linux-gnu"]),
}


def run(*command: str) -> str:
    """What the command prints; it is shown if the command fails."""
    done = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{done.stdout}\nfailed: {' '.join(command)}")
    return done.stdout


def build(preset: str, jobs: int) -> Path:
    folder = ROOT / "build" / preset
    run("cmake", "--preset", preset)
    run("cmake", "--build", str(folder), "--target", "determinism_driver", "--parallel", str(jobs))
    return folder / "tests" / "determinism" / "determinism_driver"


def hashes(jobs: int, everything: bool) -> Iterator[tuple[str, str, str]]:
    """(build, scene, hash), for every build that can be made here."""
    runs: list[tuple[str, list[str]]] = []
    for preset, (compiler, always, also, emulator) in PRESETS.items():
        thread_counts = always + also if everything else always
        if not thread_counts:
            continue
        if missing := [tool for tool in [compiler, *emulator[:1]] if not shutil.which(tool)]:
            print(f"{preset}: left out, no {missing[0]} here")
            continue
        driver = str(build(preset, jobs))
        for threads in thread_counts:
            name = f"{preset}, {threads} thread{'s' if threads > 1 else ''}"
            runs.append((name, [*emulator, driver, str(threads)]))
    runs.reverse()  # the slow emulator first
    with ThreadPoolExecutor(jobs) as pool:
        outputs = list(pool.map(lambda item: run(*item[1]), runs))
    for (name, _), output in zip(runs, outputs, strict=True):
        for line in output.splitlines():
            scene, digest = line.split()
            yield name, scene, digest


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--all", action="store_true", help="more builds, each with one and with two threads")
    arguments = parser.parse_args()
    seen: dict[str, dict[str, list[str]]] = defaultdict(lambda: defaultdict(list))
    for build_name, scene, digest in hashes(arguments.jobs, arguments.all):
        seen[scene][digest].append(build_name)
    if len(seen) < 6:
        print(f"only {len(seen)} scenes")
        return 1

    for scene, digests in seen.items():
        for digest, builds in digests.items():
            print(f"{scene:12} {digest}  {'; '.join(builds)}")
    differing = [scene for scene, digests in seen.items() if len(digests) > 1]
    print(f"{len(seen) - len(differing)} of {len(seen)} scenes have one hash")
    return 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main())
