#!/usr/bin/env python3
"""Campbell diagrams of all models in a folder with default options, as a table.

usage: CARDAN_MODELS=FOLDER tests/models.py [--refined] [--cardan PROGRAM] [--timeout SECONDS]

Every .fst file of OpenFAST and every .yaml of windIO below the folder is tried. The table says whether the model was read
(or why not), the CPU time of the diagram, how many modes it has, the estimated error of the mesh and, with --refined, the
largest difference of the first ten frequencies at rest from those of twice as many elements, and which names are not those
of the refined mesh. Exit code 1 if a model that was read has no diagram, or if the refined frequencies differ by more than
0.3 %.
"""
import argparse
import csv
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
ALLOWED = 0.3  # per cent
COMPARED = 10  # modes


def models(folder):
    """Main files of OpenFAST, and YAML files that describe a turbine."""
    for path in sorted(folder.rglob("*")):
        if not path.is_file():
            continue
        if path.suffix.lower() == ".fst":
            yield path
        elif path.suffix.lower() in (".yaml", ".yml"):
            text = path.read_text(errors="replace")
            if re.search(r"^components:", text, re.M) and re.search(r"^assembly:", text, re.M):
                yield path


def run(program, arguments, folder, timeout):
    """Exit code, what was said, and CPU time in s."""
    before = os.times()
    try:
        done = subprocess.run([program, *arguments], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, timeout=timeout, text=True, errors="replace")
        code, said = done.returncode, done.stdout
    except subprocess.TimeoutExpired:
        code, said = None, f"not within {timeout} s"
    after = os.times()
    cpu = after.children_user + after.children_system - before.children_user - before.children_system
    return code, said, cpu


def frequencies(table):
    """The first natural frequencies of a table of one rotor speed, and the names of the modes."""
    with open(table, encoding="utf-8") as lines:
        rows = csv.DictReader(line for line in lines if not line.startswith("#"))
        return sorted((float(row["natural_frequency[Hz]"]), row["mode[-]"]) for row in rows)[:COMPARED]


def elements(said):
    """Numbers of elements that were chosen, and the estimated error in per cent."""
    found = re.search(r"mesh: (\d+) elements per blade, (\d+) in the tower; .* more than ([0-9.]+) %", said)
    return (int(found[1]), int(found[2]), found[3]) if found else None


def difference(program, model, mesh, folder, timeout):
    """Largest difference of the first frequencies at rest from those with twice as many elements, per cent."""
    all_hz = []
    for times in (1, 2):
        arguments = ["modes", str(model), f"--blade-elements={times * mesh[0]}", f"--tower-elements={times * mesh[1]}",
                     f"--out=refined{times}"]
        code, said, _ = run(program, arguments, folder, timeout)
        if code != 0:
            return None, said.strip().splitlines()[-1]
        all_hz.append(frequencies(pathlib.Path(folder) / f"refined{times}.csv"))
    pairs = list(zip(*all_hz))
    renamed = [f"{b[1]}: {a[1]}" for a, b in pairs if a[1] != b[1]]
    return max((100 * abs(a[0] / b[0] - 1) for a, b in pairs if b[0] > 0), default=0.0), ", ".join(renamed)


def row(program, model, refined, timeout):
    """A line of the table, and whether all is well."""
    with tempfile.TemporaryDirectory() as folder:
        code, said, cpu = run(program, ["campbell", str(model), "--out", "diagram"], folder, timeout)
        last = said.strip().splitlines()[-1] if said.strip() else ""
        if code != 0:
            refused = code == 1 and "unexpected" not in last
            return f"{'refused' if refused else 'FAILED'} | | | | | {last[-160:]}", refused
        modes = len({r["mode[-]"] for r in csv.DictReader(
            line for line in open(pathlib.Path(folder) / "diagram.csv", encoding="utf-8") if not line.startswith("#"))})
        mesh = elements(said)
        change, why, good = "", "", True
        if refined and mesh:
            value, why = difference(program, model, mesh, folder, timeout)
            good = value is not None and value <= ALLOWED
            change = "FAILED" if value is None else f"{value:.2f}"
        shown = f"{mesh[0]}/{mesh[1]} | {mesh[2]}" if mesh else " | "
        return f"read | {cpu:.1f} | {modes} | {shown} | {change} | {why}", good


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--refined", action="store_true", help="compare the first ten modes with a refined mesh")
    parser.add_argument("--cardan", default=str(ROOT / "build/release/programs/cardan"))
    parser.add_argument("--timeout", type=float, default=300)
    options = parser.parse_args()
    options.cardan = str(pathlib.Path(options.cardan).resolve())  # it runs in another folder
    folder = os.environ.get("CARDAN_MODELS")
    if not folder or not pathlib.Path(folder).is_dir():
        sys.exit("CARDAN_MODELS is not the name of a folder with models")
    print("| model | | CPU, s | modes | elements, blade/tower | error of the mesh, % | refined, % | |\n"
          "|---|---|---|---|---|---|---|---|")
    start, all_good, count = time.monotonic(), True, 0
    for model in models(pathlib.Path(folder).resolve()):
        line, good = row(options.cardan, model, options.refined, options.timeout)
        print(f"| {model.relative_to(pathlib.Path(folder).resolve())} | {line} |", flush=True)
        all_good, count = all_good and good, count + 1
    print(f"\n{count} models in {time.monotonic() - start:.0f} s")
    sys.exit(0 if all_good and count > 0 else 1)


if __name__ == "__main__":
    main()
