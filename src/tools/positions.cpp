/// The solutions of an RTKLIB file as rows of numbers, for scripts; skipped rows are reported on standard error.

#include <iostream>
#include <limits>
#include <map>

#include "config/command_line.h"
#include "evaluation/truth_gate.h"
#include "io/rtklib_pos.h"

namespace {

using slipnav::Arguments;
using slipnav::CommandLine;
using slipnav::RtklibSolution;

CommandLine commandLine() {
  CommandLine command_line("positions", "Prints the solutions of an RTKLIB file: UNIX time, position, covariance.");
  command_line.positional("FILE", "RTKLIB solution (.pos)")
      .flag("truth", "skip rows far off their neighbors, as evaluate does with truth");
  return command_line;
}

/// Rows that contain a solution; the others are counted by what is wrong with them.
std::vector<RtklibSolution> solved(const std::vector<RtklibSolution>& rows, std::map<std::string, int>& left_out) {
  std::vector<RtklibSolution> solutions;
  for (const RtklibSolution& row : rows) {
    if (row.solved()) {
      solutions.push_back(row);
    } else {
      ++left_out["rows " + row.flaw];
    }
  }
  return solutions;
}

/// Without those that an evaluation would reject as truth.
std::vector<RtklibSolution> withoutOutliers(const std::vector<RtklibSolution>& solutions,
                                            std::map<std::string, int>& left_out) {
  std::vector<slipnav::GnssFix> fixes;
  fixes.reserve(solutions.size());
  for (const RtklibSolution& solution : solutions) {
    fixes.push_back(solution.fix);
  }
  const std::set<slipnav::Nanoseconds> kept = slipnav::stampsWithoutJumps(fixes);
  std::vector<RtklibSolution> believed;
  for (const RtklibSolution& solution : solutions) {
    if (kept.count(solution.fix.stamp) > 0) {
      believed.push_back(solution);
    } else {
      ++left_out["rows far off their neighbors"];
    }
  }
  return believed;
}

void print(const std::vector<RtklibSolution>& solutions) {
  std::cout.precision(std::numeric_limits<double>::max_digits10);
  std::cout << "stamp_ns,latitude_deg,longitude_deg,height_m,quality,ee_m2,en_m2,eu_m2,nn_m2,nu_m2,uu_m2\n";
  for (const RtklibSolution& solution : solutions) {
    const slipnav::GnssFix& fix = solution.fix;
    const slipnav::Matrix3& ned = fix.covariance_ned_m2;
    std::cout << fix.stamp << ',' << fix.latitude_deg << ',' << fix.longitude_deg << ',' << fix.height_m << ','
              << static_cast<int>(solution.quality) << ',' << ned(1, 1) << ',' << ned(0, 1) << ',' << -ned(1, 2) << ','
              << ned(0, 0) << ',' << -ned(0, 2) << ',' << ned(2, 2) << '\n';
  }
}

int run(int argc, char** argv) {
  const CommandLine command_line = commandLine();
  const Arguments arguments = command_line.parse(argc, argv);
  if (arguments.helpRequested()) {
    std::cout << command_line.help();
    return 0;
  }
  const std::string& path = arguments.text("FILE");
  std::map<std::string, int> left_out;
  std::vector<RtklibSolution> solutions = solved(slipnav::readRtklibPos(path), left_out);
  if (arguments.given("truth")) {
    solutions = withoutOutliers(solutions, left_out);
  }
  print(solutions);
  for (const auto& [what, count] : left_out) {
    std::cerr << path << ": " << what << ": " << count << " skipped\n";
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return slipnav::runGuarded("positions", std::cerr, [argc, argv] { return run(argc, argv); });
}
