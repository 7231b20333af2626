#include "config/parameter_list.h"

#include <utility>

#include "config/yaml_writer.h"
#include "core/base/text.h"

namespace slipnav {

void ParameterLister::number(const char* name, double& value, Range range, const char* meaning) {
  add(name, value, range, {}, meaning);
}

void ParameterLister::integer(const char* name, int& value, Range range, const char* meaning) {
  add(name, value, range, {}, meaning);
}

void ParameterLister::flag(const char* name, bool& value, const char* meaning) { add(name, value, {}, {}, meaning); }

void ParameterLister::text(const char* name, std::string& value, const char* meaning) {
  add(name, value, {}, {}, meaning);
}

void ParameterLister::choice(const char* name, std::string& value, std::initializer_list<const char*> options,
                             const char* meaning) {
  add(name, value, {}, {options.begin(), options.end()}, meaning);
}

void ParameterLister::numbers(const char* /*name*/, std::vector<double>& /*value*/, Range /*range*/,
                              const char* /*meaning*/) {}

void ParameterLister::words(const char* /*name*/, std::vector<std::string>& /*value*/,
                            std::initializer_list<const char*> /*options*/, const char* /*meaning*/) {}

bool ParameterLister::enterGroup(const char* name, const char* /*meaning*/) {
  path_.enter(name);
  return true;
}

void ParameterLister::leaveGroup() { path_.leave(); }

std::optional<std::size_t> ParameterLister::enterList(const char* name, std::size_t /*current_size*/,
                                                      const char* /*meaning*/) {
  path_.enter(name);
  ++lists_;
  return std::nullopt;
}

void ParameterLister::enterItem(std::size_t index) { path_.enterItem(index); }

void ParameterLister::leaveItem() { path_.leave(); }

void ParameterLister::leaveList() {
  --lists_;
  path_.leave();
}

void ParameterLister::add(const char* name, ParameterValue value, Range range, std::vector<std::string> options,
                          const char* meaning) {
  if (lists_ == 0) {
    parameters_.push_back({path_.key(name), std::move(value), range, std::move(options), meaning});
  }
}

std::string toText(const ParameterValue& value) {
  if (const bool* flag = std::get_if<bool>(&value)) {
    return *flag ? "true" : "false";
  }
  if (const int* integer = std::get_if<int>(&value)) {
    return std::to_string(*integer);
  }
  if (const double* number = std::get_if<double>(&value)) {
    return formatNumber(*number);
  }
  return yamlScalar(std::get<std::string>(value));
}

}  // namespace slipnav
