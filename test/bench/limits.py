#!/usr/bin/python3
"""Prints which benchmarks keep their limits, from the JSON of Google Benchmark."""

import json
import sys

MICROSECONDS = {"ns": 1e-3, "us": 1.0, "ms": 1e3, "s": 1e6}


def rows(benchmarks):
    """Name, figure and limit of every benchmark that has a limit; processor time unless it has percentiles."""
    for b in benchmarks:
        if "limit_ratio" in b:
            yield b["name"], f'{b["ratio"]:.1f} times', f'{b["limit_ratio"]:.0f} times', b["ratio"] <= b["limit_ratio"]
        elif "limit_us" in b:
            measured = b["p99_us"] if "p99_us" in b else b["cpu_time"] * MICROSECONDS[b["time_unit"]]
            kind = " (p99)" if "p99_us" in b else ""
            yield b["name"], duration(measured) + kind, duration(b["limit_us"]), measured <= b["limit_us"]
        if "limit_p50_us" in b:
            yield b["name"], duration(b["p50_us"]) + " (p50)", duration(b["limit_p50_us"]), b["p50_us"] <= b["limit_p50_us"]


def duration(us):
    return f"{us:.2f} µs" if us < 1e3 else f"{1e-3 * us:.2f} ms"


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        benchmarks = json.load(file)["benchmarks"]
    print(f'\n{"benchmark":<58} {"measured":>17} {"limit":>10}')
    for name, measured, limit, kept in rows(benchmarks):
        print(f'{name:<58} {measured:>17} {limit:>10} {"kept" if kept else "MISSED"}')


if __name__ == "__main__":
    main()
