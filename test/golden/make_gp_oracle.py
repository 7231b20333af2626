#!/usr/bin/env python3
"""Makes the tables against which the Gaussian process of the core is tested, with scikit-learn.

    pip install scikit-learn
    python3 make_gp_oracle.py            # reads gp_slip.csv beside it, writes gp_oracle.csv and gp_optima.csv

gp_slip.csv holds rows 1 to 150 of slip_pathfinder.csv (time_s, slip) from wvu-navLab/CN-GP, MIT license.

gp_oracle.csv, rows `case,model,kind,index,value`: at fixed hyperparameters, with times k = 1..150 times `unit`, the
log hyperparameters in the order of hyperparameterNames(), the log marginal likelihood, its gradient, and at some times
ahead the mean and variance of the latent slip and its covariance with that at the first of them.

gp_optima.csv, rows `origin,log_marginal_likelihood,variance,length_scale_s,noise_variance,stddev_10s`: maximum
likelihood (no priors) of the paper's kernel near a length scale of 1 s, for origins of time on the clock of the file.
"""

import csv
import pathlib

import numpy as np
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import RBF, ConstantKernel, Kernel, Matern, WhiteKernel

HERE = pathlib.Path(__file__).parent


class Brownian(Kernel):
    """min(t, t'), without a parameter; scikit-learn has none."""

    def __init__(self):  # scikit-learn reads the parameters from the signature: none
        pass

    def __call__(self, X, Y=None, eval_gradient=False):
        K = np.minimum(X, (X if Y is None else Y).T)
        return (K, np.empty((len(X), len(X), 0))) if eval_gradient else K

    def diag(self, X):
        return X[:, 0].copy()

    def is_stationary(self):
        return False


def variance(value):
    return ConstantKernel(value, (1e-12, 1e12))


def length(shape, value):
    bounds = (1e-6, 1e6)
    return RBF(value, bounds) if shape == "rbf" else Matern(value, bounds, nu=shape)


def regression(latent, noise, times, slips, optimizer=None):
    kernel = latent + WhiteKernel(noise, (1e-12, 1e3))
    model = GaussianProcessRegressor(kernel, alpha=0.0, optimizer=optimizer, n_restarts_optimizer=0)
    return model.fit(times[:, None], slips)


def predict(model, ahead):
    """Mean and covariance of the latent process: scikit-learn's, less the white noise on the diagonal."""
    mean, covariance = model.predict(ahead[:, None], return_cov=True)
    return mean, covariance - model.kernel_.k2.noise_level * np.eye(len(ahead))


def fixed_cases():
    def paper(v, scale):
        return variance(v) * Brownian() * length("rbf", scale)

    yield "paper_counts", "paper", 1.0, paper(3.6e-5, 10.0), 0.0028
    yield "paper_short", "paper", 1.0, paper(6e-5, 1.5), 0.001
    yield "paper_long", "paper", 1.0, paper(2e-4, 80.0), 0.0026
    yield "paper_seconds", "paper", 0.1, paper(3.6e-4, 1.0), 0.0028
    yield "brownian_matern", "brownian_matern", 0.1, variance(4e-4) * Brownian() * length(2.5, 1.2), 0.0027
    yield "matern_bias", "matern_bias", 0.1, variance(2e-3) * length(1.5, 0.8) + variance(1e-3), 0.0025
    yield "ou_slow", "ou_slow", 0.1, variance(2e-3) * length(0.5, 0.7) + variance(1e-3) * length(0.5, 20.0), 0.0024
    yield "paper_bias", "paper_bias", 0.1, paper(4e-4, 1.1) + variance(1e-3), 0.0028
    yield "rbf", "rbf", 0.1, variance(2e-3) * length("rbf", 0.9), 0.003


def write_fixed(slips, writer):
    for case, model_name, unit, latent, noise in fixed_cases():
        times = unit * np.arange(1, len(slips) + 1)
        model = regression(latent, noise, times, slips)
        theta = model.kernel_.theta
        likelihood, gradient = model.log_marginal_likelihood(theta, eval_gradient=True)
        ahead = unit * np.array([151, 155, 160, 180, 250, 400, 750.0])
        mean, covariance = predict(model, ahead)
        columns = {
            "unit": [unit], "log_parameter": theta, "log_marginal_likelihood": [likelihood], "gradient": gradient,
            "time": ahead, "mean": mean, "variance": np.diag(covariance), "covariance": covariance[0],
        }
        for kind, values in columns.items():
            for index, value in enumerate(values):
                writer.writerow([case, model_name, kind, index, repr(float(value))])


def write_optima(times, slips, writer):
    for origin in (float(times[0] - np.median(np.diff(times))), 0.0, -1000.0):
        since = times - origin
        start = variance(0.4 * slips.var() / since.mean()) * Brownian() * length("rbf", 1.0)
        model = regression(start, 0.6 * slips.var(), since, slips, optimizer="fmin_l_bfgs_b")
        _, covariance = predict(model, np.array([since[-1] + 10.0]))
        values = [model.log_marginal_likelihood_value_, *np.exp(model.kernel_.theta), np.sqrt(covariance[0, 0])]
        writer.writerow([repr(origin)] + [repr(float(value)) for value in values])


def main():
    times, slips = np.loadtxt(HERE / "gp_slip.csv", delimiter=",", skiprows=1, unpack=True)
    with open(HERE / "gp_oracle.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["case", "model", "kind", "index", "value"])
        write_fixed(slips, writer)
    with open(HERE / "gp_optima.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(
            ["origin", "log_marginal_likelihood", "variance", "length_scale_s", "noise_variance", "stddev_10s"])
        write_optima(times, slips, writer)


if __name__ == "__main__":
    main()
