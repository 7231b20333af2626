#pragma once
/// Operator decisions that must survive any restart: emergency stop and override.
///
/// The file is one line of text with format and version. It is written next to its place, flushed to disk and then
/// moved there, so that neither a killed process nor a power failure leaves half of it.

#include <string>

namespace slipnav {

/// Released only by the operator.
struct StopLatch {
  bool emergency_stop = false;
  bool overridden = false;
};

/// The text of the file.
std::string formatStopLatch(const StopLatch& latch);

/// On return the file contains `latch`, even if the power fails. Throws std::runtime_error that names the file.
void saveStopLatch(const std::string& file, const StopLatch& latch);

/// Result of reading the file.
struct LoadedStopLatch {
  StopLatch latch;
  std::string problem;  ///< one line, "" if there was none
};

/// A missing file contains nothing. One that cannot be read or understood counts as an emergency stop, since
/// it may have been one. Never throws.
LoadedStopLatch loadStopLatch(const std::string& file);

}  // namespace slipnav
