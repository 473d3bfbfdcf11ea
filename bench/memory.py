#!/usr/bin/env python3
"""Peak memory and CPU time of every program with its default options, as a table.

usage: bench/memory.py [BUILD FOLDER, default build/release]
"""
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/release").resolve()

# Programs that want to be told what to do.
ARGUMENTS = {
    "cardan": [["campbell", "nrel5mw"], ["simulate", "nrel5mw"], ["linearise", "nrel5mw"], ["steady", "nrel5mw"]],
    "nrel5mw_floating": [["decay", "--from", "pitch=3"]],
    "urdf_inspect": [[str(ROOT / "examples/data/arm6.urdf")]],
}


def run(command, folder):
    """Peak memory in MiB and CPU time in s of a command; None if it failed."""
    with open(os.devnull, "wb") as nothing:
        process = subprocess.Popen(command, cwd=folder, stdin=nothing, stdout=nothing, stderr=nothing)
        _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        return None
    return usage.ru_maxrss / 1024, usage.ru_utime + usage.ru_stime


def main():
    names = ["cardan"] + sorted(p.stem for p in (ROOT / "examples/studies").glob("*.cpp"))
    print("| Program | peak, MiB | CPU, s |\n|---|---|---|")
    for name in names:
        for arguments in ARGUMENTS.get(name, [[]]):
            with tempfile.TemporaryDirectory() as folder:
                result = run([str(BUILD / ("programs" if name == "cardan" else "examples") / name), *arguments], folder)
            shown = " ".join([name, *(pathlib.Path(a).name for a in arguments)])
            print(f"| `{shown}` | " + ("failed | |" if result is None else f"{result[0]:.0f} | {result[1]:.1f} |"),
                  flush=True)


if __name__ == "__main__":
    main()
