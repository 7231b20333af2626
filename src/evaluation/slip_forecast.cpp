#include "evaluation/slip_forecast.h"

#include <cmath>
#include <fstream>
#include <iomanip>
#include <limits>
#include <locale>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "core/base/text.h"
#include "evaluation/json_object.h"

namespace slipnav {
namespace {

std::string trimmed(const std::string& text) {
  const char* const blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::optional<double> parseField(const std::string& text) {
  return text == "nan" || text == "NaN" ? std::numeric_limits<double>::quiet_NaN() : parseNumber(text);
}

/// @return whether the row is `number,number`
bool appendRow(const std::string& row, SlipSamples& samples) {
  const std::size_t comma = row.find(',');
  if (comma == std::string::npos) {
    return false;
  }
  const std::optional<double> time_s = parseField(trimmed(row.substr(0, comma)));
  const std::optional<double> slip = parseField(trimmed(row.substr(comma + 1)));
  if (!time_s || !slip) {
    return false;
  }
  samples.times_s.push_back(*time_s);
  samples.slips.push_back(*slip);
  return true;
}

/// Every power of ten, twice and five times it: within `horizon_s`, and that itself.
std::vector<double> shownTimes(double horizon_s) {
  std::vector<double> times_s = {horizon_s};
  for (double decade_s = 1.0; decade_s < horizon_s; decade_s *= 10.0) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      if (factor * decade_s < horizon_s) {
        times_s.insert(times_s.end() - 1, factor * decade_s);
      }
    }
  }
  return times_s;
}

/// "12.5" in a column, whatever the process locale.
std::string column(double value, int decimals) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::setw(10) << std::fixed << std::setprecision(decimals) << value;
  return out.str();
}

/// Four digits.
std::string rounded(double value) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::setprecision(4) << value;
  return out.str();
}

double lastUsableTime(const SlipSamples& samples) {
  const SlipWindow window = makeSlipWindow(samples);
  return window.origin_s + window.times(window.size() - 1);
}

}  // namespace

SlipSamples readSlipCsv(const std::string& path) {
  std::ifstream file(path);
  if (!file) {
    throw std::invalid_argument(path + ": cannot be read");
  }
  SlipSamples samples;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    const std::string row = trimmed(line);
    if (!row.empty() && !appendRow(row, samples) && number > 1) {
      throw std::invalid_argument(path + ":" + std::to_string(number) + ": expected time_s,slip, not '" + row + "'");
    }
  }
  return samples;
}

SlipForecastResult forecastSlip(const SlipSamples& samples, const SlipModelParameters& parameters, double horizon_s) {
  const auto steps = static_cast<Eigen::Index>(std::floor(horizon_s / kSlipForecastStep_s + 1e-9));
  if (steps < 2) {
    throw std::invalid_argument("slip forecast: the horizon must be at least two steps of 0.1 s");
  }
  GaussianProcessSlipModel model(parameters);
  SlipForecastResult forecast;
  forecast.model = parameters.model;
  forecast.fit = model.fit(samples);
  if (!isAccepted(forecast.fit.status)) {
    throw std::invalid_argument("slip forecast: " + std::string(toString(forecast.fit.status)) + " (" +
                                std::to_string(forecast.fit.samples) + " usable)");
  }
  const double last_s = lastUsableTime(samples);
  const auto count = static_cast<double>(steps);
  forecast.prediction =
      model.predict(last_s + Eigen::ArrayXd::LinSpaced(steps, kSlipForecastStep_s, count * kSlipForecastStep_s));
  forecast.correlation = summarizeCorrelation(model, last_s + kSlipForecastStep_s, horizon_s);
  return forecast;
}

std::string toJson(const SlipForecastResult& forecast) {
  JsonObject hyperparameters;
  for (const auto& [name, value] : forecast.fit.hyperparameters) {
    hyperparameters.addNumber(name.c_str(), value);
  }
  JsonObject correlation;
  correlation.addNumber("bias_stddev", forecast.correlation.bias_stddev);
  correlation.addNumber("stddev", forecast.correlation.stddev);
  correlation.addNumber("time_constant_s", forecast.correlation.time_constant_s);
  JsonObject json;
  json.addText("model", forecast.model);
  json.addText("status", toString(forecast.fit.status));
  json.addNumber("origin_s", forecast.fit.origin_s);
  json.addObject("hyperparameters", hyperparameters);
  json.addNumber("log_marginal_likelihood", forecast.fit.log_marginal_likelihood);
  json.addCount("samples", forecast.fit.samples);
  json.addCount("left_out", forecast.fit.left_out);
  json.addObject("correlation", correlation);
  json.addNumbers("t", forecast.prediction.times_s);
  json.addNumbers("mean", forecast.prediction.mean);
  json.addNumbers("stddev", forecast.prediction.stddev);
  return json.text();
}

std::string summaryOf(const SlipForecastResult& forecast) {
  std::string text = "model " + forecast.model + ": " + toString(forecast.fit.status) + ", " +
                     std::to_string(forecast.fit.samples) + " samples, " + std::to_string(forecast.fit.left_out) +
                     " dropped, log marginal likelihood " + rounded(forecast.fit.log_marginal_likelihood) + "\n";
  const char* separator = "";
  for (const auto& [name, value] : forecast.fit.hyperparameters) {
    text += separator + name + " " + rounded(value);
    separator = ", ";
  }
  const SlipPrediction& prediction = forecast.prediction;
  text += "\n   ahead s      slip       +-2 sigma\n";
  const double horizon_s = static_cast<double>(prediction.times_s.size()) * kSlipForecastStep_s;
  for (const double time_s : shownTimes(horizon_s)) {
    const auto row = static_cast<Eigen::Index>(std::lround(time_s / kSlipForecastStep_s)) - 1;
    text +=
        column(time_s, 1) + column(prediction.mean(row), 4) + "      " + column(2.0 * prediction.stddev(row), 4) + "\n";
  }
  return text;
}

}  // namespace slipnav
