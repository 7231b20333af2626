#pragma once
/// A whole slip forecast from one file of slip samples, and its JSON.

#include <string>

#include "core/forecast/gaussian_process_slip_model.h"
#include "core/forecast/slip_correlation.h"
#include "core/forecast/slip_model.h"

namespace slipnav {

/// Step of the predicted times [s].
inline constexpr double kSlipForecastStep_s = 0.1;

/// Output of `forecast`.
struct SlipForecastResult {
  std::string model;
  SlipFit fit;
  SlipPrediction prediction;    ///< every 0.1 s after the last usable sample, up to the horizon
  GaussMarkovSlip correlation;  ///< of the prediction
};

/// Rows `time_s,slip`; a first row without numbers is a header, empty rows are skipped, `nan` is an unknown
/// slip. Throws std::invalid_argument naming the file (and line) that cannot be read.
SlipSamples readSlipCsv(const std::string& path);

/// Fits one model to the samples and predicts. Throws std::invalid_argument with the status if the samples are
/// rejected, or if the horizon is shorter than two steps.
SlipForecastResult forecastSlip(const SlipSamples& samples, const SlipModelParameters& parameters, double horizon_s);

/// One object: model, status, origin_s, hyperparameters, log_marginal_likelihood, samples, left_out, correlation
/// {bias_stddev, stddev, time_constant_s}, t, mean, stddev. Numbers carry all their digits.
std::string toJson(const SlipForecastResult& forecast);

/// The same as text: the fit, and slip with 2σ at a handful of future times.
std::string summaryOf(const SlipForecastResult& forecast);

}  // namespace slipnav
