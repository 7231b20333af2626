/// Prints every parameter: the defaults, or the result of configuration files and overrides.

#include <iostream>

#include "config/command_line.h"
#include "config/config.h"
#include "config/markdown_writer.h"
#include "config/tuning.h"
#include "config/yaml_writer.h"

namespace {

int run(int argc, char** argv) {
  slipnav::CommandLine command("configuration", "Prints the whole configuration, every parameter with its meaning.");
  command.choice("format", {"yaml", "markdown"}, "how to print it", "yaml");
  slipnav::declareConfigOptions(command);
  const slipnav::Arguments arguments = command.parse(argc, argv);
  if (arguments.helpRequested()) {
    std::cout << command.help();
    return 0;
  }
  const slipnav::Config config = slipnav::configFromOptions(arguments);
  std::cout << (arguments.text("format") == "yaml" ? slipnav::toYaml(config)
                                                   : slipnav::toMarkdown(config, slipnav::tunableKeys()));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return slipnav::runGuarded("configuration", std::cerr, [&] { return run(argc, argv); });
}
