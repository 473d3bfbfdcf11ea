#!/usr/bin/env python3
"""What cardan makes of every model below some folders: OpenFAST's main files (.fst) and windIO's (.yaml).

    docs/public_models.py MODELS... [--cardan PATH] [--commands NAME ...] [--limit SECONDS] [--jobs N] [--out TABLE.csv]

For every model it runs, as a user would type it,

    cardan info MODEL                       is it read?
    cardan modes MODEL                      modes at rest
    cardan steady MODEL --wind 8            power in 8 m/s
    cardan simulate MODEL --duration 0.5    its own run

and writes a table: for every command "ok", or the last line it said. Commands run in a folder that goes away."""

import argparse
import concurrent.futures
import csv
import os
import re
import subprocess
import sys
import tempfile

COMMANDS = {
    "info": ["info"],
    "modes": ["modes"],
    "steady": ["steady", "--wind", "8"],
    "simulate": ["simulate", "--duration", "0.5"],
}


def is_windio(path):
    """Has it the components of a turbine?"""
    with open(path, errors="replace") as file:
        text = file.read(4_000_000)
    return re.search(r"^components:", text, re.MULTILINE) and "blade" in text


def models(folder):
    for root, _, files in os.walk(folder, followlinks=True):
        for name in sorted(files):
            path = os.path.join(root, name)
            ending = name.lower().rsplit(".", 1)[-1]
            if ending == "fst" or (ending in ("yaml", "yml") and is_windio(path)):
                yield path


def said(model, command, options, folder):
    """"ok", or why not, in a line."""
    words = [options.cardan, COMMANDS[command][0], model, *COMMANDS[command][1:]]
    try:
        run = subprocess.run(words, capture_output=True, text=True, errors="replace", timeout=options.limit, cwd=folder)
    except subprocess.TimeoutExpired:
        return f"more than {options.limit:g} s"
    if run.returncode == 0:
        return "ok"
    lines = [line for line in run.stderr.splitlines() if line.strip()]
    return lines[-1] if lines else f"exit code {run.returncode}"


def row_of(model, options):
    row = {"model": model}
    with tempfile.TemporaryDirectory() as folder:
        for command in options.commands:
            row[command] = said(os.path.abspath(model), command, options, folder)
            if command == "info" and row[command] != "ok":
                break
    print(" | ".join([model, *(row.get(command, "-") for command in options.commands)]), file=sys.stderr, flush=True)
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="+", help="folders")
    parser.add_argument("--cardan", default="cardan", help="the command")
    parser.add_argument("--commands", nargs="+", choices=COMMANDS, default=list(COMMANDS), help="some of the four")
    parser.add_argument("--limit", type=float, default=120, help="of a command, s")
    parser.add_argument("--jobs", type=int, default=1, help="models at a time")
    parser.add_argument("--out", default="public_models.csv", help="the table")
    options = parser.parse_args()
    options.cardan = os.path.abspath(options.cardan) if os.sep in options.cardan else options.cardan
    found = sorted({model for folder in options.models for model in models(folder)})
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        rows = list(pool.map(lambda model: row_of(model, options), found))
    with open(options.out, "w", newline="") as file:
        table = csv.DictWriter(file, ["model", *options.commands])
        table.writeheader()
        table.writerows(rows)
    for command in options.commands:
        print(f"{command:10} {sum(row.get(command) == 'ok' for row in rows)} of {len(rows)}")


if __name__ == "__main__":
    main()
