/// Fits a slip model to a file of slip samples, prints the forecast and writes it as JSON.

#include <iostream>

#include "config/command_line.h"
#include "core/base/atomic_file.h"
#include "evaluation/slip_forecast.h"

namespace {

slipnav::CommandLine declareCommandLine() {
  const slipnav::SlipModelParameters defaults;
  slipnav::CommandLine command("forecast", "Fits a Gaussian process to slip samples and predicts slip ahead.");
  command.positional("SLIP.csv", "rows time_s,slip; a header is skipped")
      .choice("model", slipnav::latentModelNames(), "slip model", defaults.model)
      .choice("inference", {"dense", "state_space"}, "exact, or in linear time", defaults.inference)
      .option("horizon", "S", "how far to predict, in seconds", "60")
      .option("origin", "T", "time origin of the Brownian kernel; without it one interval before the first sample")
      .option("out", "JSON", "everything as JSON into a file; - for standard output instead of the summary");
  return command;
}

int run(const slipnav::Arguments& arguments) {
  slipnav::SlipModelParameters parameters;
  parameters.model = arguments.text("model");
  parameters.inference = arguments.text("inference");
  slipnav::SlipSamples samples = slipnav::readSlipCsv(arguments.text("SLIP.csv"));
  if (arguments.given("origin")) {
    samples.origin_s = arguments.number("origin");
  }
  const double horizon_s = arguments.number("horizon", {2.0 * slipnav::kSlipForecastStep_s, 3600.0});
  const slipnav::SlipForecastResult forecast = slipnav::forecastSlip(samples, parameters, horizon_s);
  if (arguments.given("out") && arguments.text("out") == "-") {
    std::cout << slipnav::toJson(forecast);
    return 0;
  }
  if (arguments.given("out")) {
    slipnav::AtomicFile file(arguments.text("out"));
    file.stream() << slipnav::toJson(forecast);
    file.commit();
  }
  std::cout << slipnav::summaryOf(forecast);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return slipnav::runGuarded("forecast", std::cerr, [&] {
    const slipnav::CommandLine command = declareCommandLine();
    const slipnav::Arguments arguments = command.parse(argc, argv);
    if (arguments.helpRequested()) {
      std::cout << command.help();
      return 0;
    }
    return run(arguments);
  });
}
