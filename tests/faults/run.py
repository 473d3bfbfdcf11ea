#!/usr/bin/env python3
"""Every write, rename, sync and open of a command fails once, and is killed once at exactly that call.

    tests/faults/run.py CARDAN [CASE ...] [--every N] [--jobs N]

strace makes the k-th call on the command's files fail with ENOSPC, EIO or EINTR, or kills the program there. After each
of these faults a result is either not there or it is readable, and what it holds is the beginning of the undisturbed
one, bit for bit; a picture or a table is whole or not there. A run in time then goes on with --resume to the same bits.
A command whose call failed says so, with the file, or its results are whole.

Cases: run (a machine without wind), wind (a machine in the wind under a controller), campbell, convert. --every takes
each N-th call alone. The table of docs/reliability.md has what came."""

import argparse
import collections
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

CALLS = ["openat", "write", "writev", "pwrite64", "rename", "renameat", "renameat2", "fsync", "fdatasync", "ftruncate",
         "unlink", "linkat"]
FAULTS = ["error=ENOSPC", "error=EIO", "error=EINTR", "signal=KILL"]
few = ["--blade-elements", "1", "--tower-elements", "1"]

Case = collections.namedtuple("Case", "words outputs resumes")
CASES = {
    "run": Case(["simulate", "wt600", *few, "--duration", "1", "--step", "0.1", "--out", "{}/x"],
                ["x.h5", "x.svg", "x.png", "x_energy.png"], True),
    "wind": Case(["simulate", "nrel5mw-fast", *few, "--wind", "14", "--controller", "baseline", "--duration", "1",
                  "--step", "0.1", "--out", "{}/x"], ["x.h5", "x.svg", "x.png", "x_energy.png"], True),
    "campbell": Case(["campbell", "wt600", *few, "--rpm", "0,20", "--out", "{}/x"],
                     ["x.h5", "x.csv", "x.svg", "x.png"], False),
    "convert": Case(["convert", "wt600", "{}/x.yaml"], ["x.yaml"], False),
}


def run(words, folder, **more):
    return subprocess.run(words, cwd=folder, capture_output=True, text=True, errors="replace", timeout=300, **more)


def words_in(case, folder):
    """With whole paths, by which strace knows the files."""
    return [word.replace("{}", str(folder)) for word in case.words]


def traced(case, cardan, folder, inject=None):
    """The command under strace, which sees calls on its files alone."""
    words = ["strace", "-f", "-qq", "-o", "trace", "-e", "trace=" + ",".join(CALLS)]
    for name in case.outputs:
        for file in (name, name + ".partial"):
            words += ["-P", str(folder / file)]
    if inject:
        words += ["-e", "inject=" + inject]
    return run([*words, cardan, *words_in(case, folder)], folder)


def calls(folder):
    """How often each was made."""
    count = collections.Counter()
    for line in (folder / "trace").read_text(errors="replace").splitlines():
        found = re.match(r"\d+ +(\w+)\(", line)
        if found:
            count[found[1]] += 1
    return count


def rows(cardan, folder, name):
    """Of a history as text; none if it cannot be read."""
    done = run([cardan, "convert", name, "rows.csv"], folder)
    if done.returncode != 0:
        return None
    text = (folder / "rows.csv").read_text()
    (folder / "rows.csv").unlink()
    return text


class Undisturbed:
    def __init__(self, case, cardan):
        self.case, self.cardan = case, cardan
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            done = traced(case, cardan, folder)
            if done.returncode != 0:
                sys.exit(f"the undisturbed command fails: {done.stderr}")
            self.calls = calls(folder)
            self.bytes = {one: (folder / one).read_bytes() for one in case.outputs}
            self.rows = rows(cardan, folder, "x.h5") if case.resumes else None

    def fault(self, inject):
        """What is wrong after it; empty: nothing. And what came, for the table."""
        case, cardan = self.case, self.cardan
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            done = traced(case, cardan, folder, inject)
            killed = "KILL" in inject
            said = done.stderr.strip().splitlines()
            wrong = []
            if killed and done.returncode == 0:
                return [], "not reached"
            if not killed and done.returncode < 0:
                wrong.append(f"ended by signal {-done.returncode}")
            if not killed and done.returncode != 0 and not any(one in "\n".join(said) for one in ("x.", "x_")):
                wrong.append(f"the error names no file: {said[-1:]}")
            whole = done.returncode == 0
            for one in case.outputs:
                file = folder / one
                if not file.exists():
                    if whole:
                        wrong.append(f"{one} is missing")
                    continue
                if one.endswith(".h5"):
                    wrong += self.look_at(folder, one, whole)
                elif file.read_bytes() != self.bytes[one]:
                    wrong.append(f"{one} is not whole")
            if not killed:
                wrong += [f"{one.name} is left behind" for one in folder.glob("*.partial") if whole]
            came = "whole" if whole else "killed" if killed else "error"
            if case.resumes and not wrong and not whole:
                came += ", " + self.resume(folder, wrong)
            return wrong, came

    def look_at(self, folder, name, whole):
        if not self.case.resumes:
            done = run([self.cardan, "info", name], folder)
            return [] if done.returncode == 0 else [f"{name} cannot be read: {done.stderr.strip()}"]
        text = rows(self.cardan, folder, name)
        if text is None:
            info = run([self.cardan, "info", name], folder)
            return [] if info.returncode == 0 else [f"{name} cannot be read: {info.stderr.strip()}"]
        if whole and text != self.rows:
            return [f"{name} differs"]
        return [] if self.rows.startswith(text) else [f"{name} has other rows"]

    def resume(self, folder, wrong):
        begun = (folder / "x.h5").exists()
        done = run([self.cardan, *words_in(self.case, folder), "--resume"], folder)
        if done.returncode != 0:
            wrong.append(f"--resume fails: {done.stderr.strip()}")
        elif rows(self.cardan, folder, "x.h5") != self.rows:
            wrong.append("--resume comes to other rows")
        return "resumed" if begun else "begun again"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cardan")
    parser.add_argument("cases", nargs="*", default=list(CASES))
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    cardan = os.path.abspath(options.cardan)
    if shutil.which("strace") is None:
        sys.exit("strace is not installed")
    failed = 0
    for name in options.cases:
        plain = Undisturbed(CASES[name], cardan)
        faults = [f"{call}:{fault}:when={k}" for call, count in sorted(plain.calls.items())
                  for k in range(1, count + 1, options.every) for fault in FAULTS]
        came = collections.Counter()
        pool = concurrent.futures.ThreadPoolExecutor(options.jobs)
        stopped = False
        try:
            for inject, (wrong, what) in zip(faults, pool.map(plain.fault, faults)):
                came[what] += 1
                for one in wrong:
                    failed += 1
                    print(f"FAILED: {name}, {inject}: {one}", flush=True)
        except KeyboardInterrupt:
            stopped = True
        pool.shutdown(cancel_futures=True)
        print(f"{name}: {sum(plain.calls.values())} calls, {sum(came.values())} of {len(faults)} faults: "
              + ", ".join(f"{count} {what}" for what, count in sorted(came.items())), flush=True)
        if stopped:
            return 130
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
