#pragma once
/// A whole slip forecast from one file of slip samples, and its JSON.

#include <string>

#include "core/forecast/gaussian_process_slip_model.h"
#include "core/forecast/slip_correlation.h"
#include "core/forecast/slip_model.h"

namespace slipnav {

/// Step of the predicted times [s].
inline constexpr double kSlipForecastStep_s = 0.1;

/// What `forecast` writes.
struct SlipForecastResult {
  std::string model;
  SlipFit fit;
  SlipPrediction prediction;    ///< every 0.1 s after the last usable sample, up to the horizon
  GaussMarkovSlip correlation;  ///< of the prediction
};

/// Rows `time_s,slip`; a first row that is not of numbers is a header, empty rows are skipped, `nan` is a slip that is
/// not known. Throws std::invalid_argument naming the file (and line) that cannot be read.
SlipSamples readSlipCsv(const std::string& path);

/// Fits one model to the samples and predicts. Throws std::invalid_argument with the status when the samples are
/// refused, or when the horizon is shorter than two steps.
SlipForecastResult forecastSlip(const SlipSamples& samples, const SlipModelParameters& parameters, double horizon_s);

/// One object: model, status, origin_s, hyperparameters, log_marginal_likelihood, samples, left_out, correlation
/// {bias_stddev, stddev, time_constant_s}, t, mean, stddev. Numbers carry all their digits.
std::string toJson(const SlipForecastResult& forecast);

/// The same for a reader: what was fitted, and slip with 2σ at a handful of times ahead.
std::string summaryOf(const SlipForecastResult& forecast);

}  // namespace slipnav
