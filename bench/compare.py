#!/usr/bin/env python3
"""Two builds of one benchmark in turn: the ratio of their CPU times, median over pairs.

    bench/compare.py BEFORE AFTER [--pairs 21] [--filter REGEX] [--min-time 0.05]

BEFORE and AFTER are programs of Google Benchmark with the same benchmarks, say build/bench/bench/bench_kernels of two
commits. They run alternately, so that a processor whose speed drifts does so for both; a ratio above 1 means that AFTER
is slower. The exit code is 1 if the median of a benchmark is above --limit.
"""
import argparse
import json
import re
import statistics
import subprocess
import sys


def times(program, options):
    command = [program, "--benchmark_format=json", f"--benchmark_min_time={options.min_time}",
               f"--benchmark_filter={options.filter}"]
    out = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return {one["name"]: one["cpu_time"] for one in json.loads(out)["benchmarks"] if one.get("run_type") != "aggregate"}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("before")
    parser.add_argument("after")
    parser.add_argument("--pairs", type=int, default=21)
    parser.add_argument("--filter", default=".")
    parser.add_argument("--min-time", type=float, default=0.05, help="of a benchmark in a run, s")
    parser.add_argument("--limit", type=float, default=float("inf"))
    options = parser.parse_args()
    re.compile(options.filter)
    ratios = {}
    for pair in range(options.pairs):
        # Who goes first changes from pair to pair.
        order = (options.before, options.after) if pair % 2 == 0 else (options.after, options.before)
        first, second = (times(program, options) for program in order)
        before, after = (first, second) if pair % 2 == 0 else (second, first)
        for name in before.keys() & after.keys():
            ratios.setdefault(name, []).append(after[name] / before[name])
        print(f"\rpair {pair + 1} of {options.pairs}", end="", file=sys.stderr)
    print(file=sys.stderr)
    if not ratios:
        sys.exit("the two programs have no benchmark in common")
    print(f"{'after / before':<60} {'median':>8} {'quartiles':>17}")
    worst = 0
    for name, values in ratios.items():
        low, middle, high = statistics.quantiles(values, n=4) if len(values) > 1 else values * 3
        worst = max(worst, middle)
        print(f"{name:<60} {middle:8.3f} {low:8.3f} {high:8.3f}")
    print(f"{'geometric mean':<60} {statistics.geometric_mean(statistics.median(v) for v in ratios.values()):8.3f}")
    sys.exit(worst > options.limit)


if __name__ == "__main__":
    main()
