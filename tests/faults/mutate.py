#!/usr/bin/env python3
"""Files with one word, one line or one byte changed: what the command says of them.

    tests/faults/mutate.py CARDAN [--count N] [--seed N] [--jobs N] [--show N] [--model FILE ...]

Each of N times one file of a model (those of tests/data and our own YAML; --model: others, with all files in their
folders) is changed at a random place and the command reads the model. A refusal names the file that was changed or one
that leads to it, with a line where a line is at fault; how many do is printed. A crash, a hang, a message "unexpected",
a refusal without a file or with nan in the place of the value at fault, and a number that is not finite in what was
accepted are failures, shown with the change."""

import argparse
import collections
import concurrent.futures
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parents[2]
NUMBERS = ["0", "-1", "1e308", "-1e308", "1e-308", "1e20", "-1e20", "1e9", "1e6", "-5", "nan", "inf", "-inf", "1G",
           "0x1p3", "1,5", "1e", "--1", "3.x", "", "12 13", "true", "\"x\"", "default", "99999999999999999999", "1e400"]
number = re.compile(rb"(?<![\w.])[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?")

Model = collections.namedtuple("Model", "folder main files")


def models(cardan, place):
    """Ours: a copy of each by itself, so that nothing else is read."""
    data = root / "tests" / "data"
    openfast = data / "openfast"
    yaml = place / "yaml"
    yaml.mkdir()
    subprocess.run([cardan, "convert", "nrel5mw-fast", str(yaml / "nrel.yaml")], check=True, capture_output=True)
    subprocess.run([cardan, "convert", str(openfast / "small.fst"), str(yaml / "small.yaml")], check=True,
                   capture_output=True)
    fst = ["small.fst", "small_ElastoDyn.dat", "small_Blade.dat", "small_Tower.dat", "small_ServoDyn.dat"]
    beam = ["small_BeamDyn.fst", "small_BeamDyn.dat", "small_BeamDyn_Blade.dat"]
    return [Model(openfast, "small.fst", fst),
            Model(openfast, "small_BeamDyn.fst", beam),
            Model(data / "windio", "small_v1.yaml", ["small_v1.yaml"]),
            Model(data / "windio", "small_v2.yaml", ["small_v2.yaml"]),
            Model(yaml, "small.yaml", ["small.yaml"]),
            Model(yaml, "nrel.yaml", ["nrel.yaml"])]


def model_with_its_folder(path):
    files = [str(one.relative_to(path.parent)) for one in path.parent.rglob("*")
             if one.is_file() and one.stat().st_size < 1_000_000]
    return Model(path.parent, path.name, files)


def changed(text, dice):
    """And what was done."""
    kind = dice.choice(["number", "number", "number", "line out", "line twice", "byte", "cut", "word"])
    lines = text.split(b"\n")
    if kind == "number":
        found = list(number.finditer(text))
        one = dice.choice(found)
        new = dice.choice(NUMBERS).encode()
        line = text.count(b"\n", 0, one.start()) + 1
        return text[:one.start()] + new + text[one.end():], f"line {line}: {one[0].decode()} -> {new.decode()}"
    k = dice.randrange(len(lines))
    if kind == "line out":
        return b"\n".join(lines[:k] + lines[k + 1:]), f"without line {k + 1}: {lines[k][:60]}"
    if kind == "line twice":
        return b"\n".join(lines[:k] + [lines[k]] + lines[k:]), f"line {k + 1} twice: {lines[k][:60]}"
    at = dice.randrange(len(text))
    if kind == "cut":
        return text[:at], f"cut after byte {at}"
    if kind == "word":
        words = list(re.finditer(rb"[A-Za-z_]+", text))
        one = dice.choice(words)
        return text[:one.start()] + b"qx" + text[one.end():], f"word {one[0].decode()} -> qx"
    return text[:at] + bytes([dice.randrange(256)]) + text[at + 1:], f"byte {at}"


def tried(cardan, model, seed):
    """Class, file, change, message."""
    dice = random.Random(seed)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for one in model.files:
            (folder / one).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(model.folder / one, folder / one)
        target = dice.choice(model.files)
        new, change = changed((folder / target).read_bytes(), dice)
        (folder / target).write_bytes(new)
        try:
            done = subprocess.run([cardan, "convert", model.main, "out.yaml"], cwd=folder, capture_output=True,
                                  text=True, errors="replace", timeout=60)
        except subprocess.TimeoutExpired:
            return "hang", target, change, ""
        said = done.stderr.strip()
        if done.returncode < 0 or done.returncode > 2:
            return "crash", target, change, said
        if "unexpected:" in said:
            return "unexpected", target, change, said
        if done.returncode == 0:
            text = (folder / "out.yaml").read_text()
            for line in text.splitlines():  # what is rigid has no finite stiffness
                may_be_infinite = re.match(r"\s*((source|no_air|EA|GJ|GA_\w+|stiffness\w*):|- \[\[)", line)
                if not may_be_infinite and re.search(r"[-: \[]\.?(nan|inf)\b", line.lower()):
                    return "not finite", target, change, line.strip()
            return "accepted", target, change, ""
        if re.search(r"= -?(nan|inf)\b", said) and not re.search("nan|inf", change):
            return "value hidden", target, change, said
        named = [one for one in (pathlib.Path(file).name for file in model.files) if one in said]
        if not named:
            return "no file", target, change, said
        if re.search("(" + "|".join(re.escape(one) for one in named) + r"):\d+", said):
            return "file and line", target, change, said
        return "file", target, change, said


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cardan")
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--model", type=pathlib.Path, nargs="*")
    parser.add_argument("--show", type=int, default=3, help="examples of each message")
    options = parser.parse_args()
    cardan = os.path.abspath(options.cardan)
    count = collections.Counter()
    examples = collections.defaultdict(list)
    with tempfile.TemporaryDirectory() as name:
        all_models = ([model_with_its_folder(one.resolve()) for one in options.model] if options.model
                      else models(cardan, pathlib.Path(name)))
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            for kind, target, change, said in pool.map(
                    lambda k: tried(cardan, all_models[k % len(all_models)], k),
                    range(options.seed, options.seed + options.count)):
                count[kind] += 1
                if kind not in ("accepted", "file and line"):
                    alike = re.sub(r"[-+]?\d[\d.e+-]*", "N", said.splitlines()[-1] if said else "")
                    examples[kind, target, alike].append((change, said))
    for (kind, target, _), cases in sorted(examples.items(), key=lambda one: (one[0][0], -len(one[1]))):
        print(f"{kind}, {target}: {len(cases)}")
        for change, said in cases[:options.show]:
            print(f"    {change}\n        {said[:300]}")
    print(", ".join(f"{n} {kind}" for kind, n in count.most_common()))
    bad = sum(count[kind] for kind in ("crash", "hang", "unexpected", "no file", "not finite", "value hidden"))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
