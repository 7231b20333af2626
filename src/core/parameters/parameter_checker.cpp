#include "core/parameters/parameter_checker.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/text.h"

namespace slipnav {
namespace {

void throwIfAny(const std::string& key, const std::string& complaint) {
  if (!complaint.empty()) {
    throw std::invalid_argument("'" + key + "' " + complaint);
  }
}

}  // namespace

std::string describeRange(const Range& range) {
  const bool has_min = std::isfinite(range.min);
  const bool has_max = std::isfinite(range.max);
  if (has_min && has_max) {
    return formatNumber(range.min) + " to " + formatNumber(range.max);
  }
  if (has_min) {
    return "at least " + formatNumber(range.min);
  }
  return has_max ? "at most " + formatNumber(range.max) : "";
}

std::string complaintAbout(double value, const Range& range) {
  if (!std::isfinite(value)) {
    return "must be a finite number, not " + formatNumber(value);
  }
  if (value < range.min || value > range.max) {
    return "must be " + describeRange(range) + ", not " + formatNumber(value);
  }
  return "";
}

std::string complaintAbout(const std::string& value, const std::vector<std::string>& options) {
  if (options.empty() || std::find(options.begin(), options.end(), value) != options.end()) {
    return "";
  }
  return "must be " + joinAlternatives(options) + ", not '" + value + "'";
}

void ParameterChecker::number(const char* name, double& value, Range range, const char* /*meaning*/) {
  throwIfAny(path_.key(name), complaintAbout(value, range));
}

void ParameterChecker::integer(const char* name, int& value, Range range, const char* /*meaning*/) {
  throwIfAny(path_.key(name), complaintAbout(static_cast<double>(value), range));
}

void ParameterChecker::flag(const char* /*name*/, bool& /*value*/, const char* /*meaning*/) {}

void ParameterChecker::text(const char* /*name*/, std::string& /*value*/, const char* /*meaning*/) {}

void ParameterChecker::choice(const char* name, std::string& value, std::initializer_list<const char*> options,
                              const char* /*meaning*/) {
  throwIfAny(path_.key(name), complaintAbout(value, {options.begin(), options.end()}));
}

void ParameterChecker::numbers(const char* name, std::vector<double>& value, Range range, const char* /*meaning*/) {
  for (std::size_t i = 0; i < value.size(); ++i) {
    throwIfAny(path_.key(name) + "[" + std::to_string(i) + "]", complaintAbout(value[i], range));
  }
}

void ParameterChecker::words(const char* name, std::vector<std::string>& value,
                             std::initializer_list<const char*> options, const char* /*meaning*/) {
  for (std::size_t i = 0; i < value.size(); ++i) {
    throwIfAny(path_.key(name) + "[" + std::to_string(i) + "]",
               complaintAbout(value[i], {options.begin(), options.end()}));
  }
}

bool ParameterChecker::enterGroup(const char* name, const char* /*meaning*/) {
  path_.enter(name);
  return true;
}

void ParameterChecker::leaveGroup() { path_.leave(); }

std::optional<std::size_t> ParameterChecker::enterList(const char* name, std::size_t /*current_size*/,
                                                       const char* /*meaning*/) {
  path_.enter(name);
  return std::nullopt;
}

void ParameterChecker::enterItem(std::size_t index) { path_.enterItem(index); }

void ParameterChecker::leaveItem() { path_.leave(); }

void ParameterChecker::leaveList() { path_.leave(); }

}  // namespace slipnav
