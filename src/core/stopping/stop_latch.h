#pragma once
/// What the operator has said and no restart may forget: emergency stop and override.
///
/// The file is one line of text with format and version. It is written beside its place, flushed to the disk and then
/// moved there, so that neither a killed process nor a power failure leaves half of it.

#include <string>

namespace slipnav {

/// Released by the operator alone.
struct StopLatch {
  bool emergency_stop = false;
  bool overridden = false;
};

/// The text of the file.
std::string formatStopLatch(const StopLatch& latch);

/// On return the file holds `latch`, even when the power fails. Throws std::runtime_error that names the file.
void saveStopLatch(const std::string& file, const StopLatch& latch);

/// What was found at the place of the file.
struct LoadedStopLatch {
  StopLatch latch;
  std::string problem;  ///< one line, "" when there was none
};

/// A file that is not there holds nothing. One that cannot be read or understood counts as an emergency stop: what it
/// said may have been one. Never throws.
LoadedStopLatch loadStopLatch(const std::string& file);

}  // namespace slipnav
