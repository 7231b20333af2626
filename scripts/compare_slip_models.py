#!/usr/bin/python3
"""Compares the slip models of `forecast` by how well they predict held-out slip.

A window slides over a recording of slip (rows time_s,slip); each model is fitted to the window and predicts the samples
after it. Printed per model: the mean log predictive density of a held-out sample (higher is better) in three ranges of
the horizon, the root mean square error over all of them, and that error over the predicted standard deviation (one when
the spread is honest).

    compare_slip_models.py SLIP.csv [--forecast EXECUTABLE] [--window 100] [--ahead 50] [--stride 5]
"""

import argparse
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

MODELS = ["paper", "paper_bias", "paper_slow", "brownian_matern", "rbf", "rbf_bias", "rbf_slow", "matern_bias", "ou",
          "ou_bias", "ou_slow"]
RANGES_S = [(0.0, 1.0), (1.0, 3.0), (3.0, math.inf)]


def read_samples(path):
    samples = []
    with open(path, newline="") as file:
        for row in csv.reader(file):
            try:
                samples.append((float(row[0]), float(row[1])))
            except ValueError:
                continue  # header
    return samples


def forecast(executable, window, model, horizon_s):
    with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
        file.writelines(f"{time!r},{slip!r}\n" for time, slip in window)
        file.flush()
        command = [executable, file.name, "--model", model, "--horizon", f"{horizon_s:.1f}", "--out", "-"]
        return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def score_window(executable, window, held_out, model):
    """Per held-out sample: (seconds ahead, log density, squared error, squared error over variance)."""
    last = window[-1][0]
    result = forecast(executable, window, model, held_out[-1][0] - last + 0.2)
    noise = result["hyperparameters"]["noise_variance"]
    scores = []
    for time, slip in held_out:
        nearest = min(range(len(result["t"])), key=lambda i: abs(result["t"][i] - time))
        variance = result["stddev"][nearest] ** 2 + noise
        error = slip - result["mean"][nearest]
        density = -0.5 * (math.log(2.0 * math.pi * variance) + error**2 / variance)
        scores.append((time - last, density, error**2, error**2 / variance))
    return scores


def mean(values):
    return sum(values) / len(values) if values else math.nan


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("samples", type=pathlib.Path, metavar="SLIP.csv")
    parser.add_argument("--forecast", default="forecast", help="the executable (rosrun slipnav forecast)")
    parser.add_argument("--window", type=int, default=100, help="samples to fit")
    parser.add_argument("--ahead", type=int, default=50, help="samples to predict")
    parser.add_argument("--stride", type=int, default=5, help="samples between windows")
    arguments = parser.parse_args()
    samples = read_samples(arguments.samples)
    starts = range(0, len(samples) - arguments.window - arguments.ahead + 1, arguments.stride)
    if not starts:
        sys.exit(f"compare_slip_models: {arguments.samples} has too few rows for one window")
    print(f"{len(starts)} windows of {arguments.window} samples, {arguments.ahead} ahead")
    print("model            0-1 s    1-3 s    > 3 s      all     rmse  error/sd")
    for model in MODELS:
        scores = []
        for start in starts:
            split = start + arguments.window
            scores += score_window(arguments.forecast, samples[start:split],
                                   samples[split:split + arguments.ahead], model)
        columns = [mean([s[1] for s in scores if low < s[0] <= high]) for low, high in RANGES_S]
        columns += [mean([s[1] for s in scores]), math.sqrt(mean([s[2] for s in scores])),
                    math.sqrt(mean([s[3] for s in scores]))]
        print(f"{model:15s}" + "".join(f"{column:9.3f}" for column in columns))


if __name__ == "__main__":
    main()
