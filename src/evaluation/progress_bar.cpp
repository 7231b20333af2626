#include "evaluation/progress_bar.h"

#include <algorithm>
#include <utility>

namespace slipnav {
namespace {

constexpr std::size_t kWidth = 40;
constexpr std::size_t kWhole_pct = 100;
constexpr std::size_t kStepWithoutTerminal_pct = 10;

}  // namespace

ProgressBar::ProgressBar(std::string program, std::ostream& out, bool is_terminal)
    : program_(std::move(program)), out_(out), is_terminal_(is_terminal) {}

void ProgressBar::show(std::size_t done, std::size_t expected, const std::string& note) {
  const std::size_t step_pct = is_terminal_ ? 1 : kStepWithoutTerminal_pct;
  const std::size_t now_pct = kWhole_pct * done / std::max<std::size_t>(1, expected);
  if (now_pct < shown_pct_ + step_pct) {
    return;
  }
  shown_pct_ = now_pct - now_pct % step_pct;
  const std::size_t filled = std::min(kWidth, kWidth * shown_pct_ / kWhole_pct);
  out_ << (is_terminal_ ? "\r" : "") << program_ << ": [" << std::string(filled, '#')
       << std::string(kWidth - filled, '.') << "] " << shown_pct_ << " %, " << note << (is_terminal_ ? "" : "\n")
       << std::flush;
}

void ProgressBar::finish() {
  if (is_terminal_ && shown_pct_ > 0) {
    out_ << "\n" << std::flush;
  }
  shown_pct_ = 0;
}

}  // namespace slipnav
