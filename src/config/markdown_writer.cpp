#include "config/markdown_writer.h"

#include <algorithm>
#include <iterator>

#include "core/base/text.h"
#include "core/parameters/parameter_checker.h"

namespace slipnav {
namespace {

/// Marks what may be changed while the nodelets run.
const char* const kTunable = "⟳";

std::string code(const std::string& text) { return text.empty() ? "" : "`" + text + "`"; }

std::string joined(const std::vector<std::string>& items) {
  std::string text;
  for (const std::string& item : items) {
    text += (text.empty() ? "" : ", ") + item;
  }
  return "[" + text + "]";
}

/// A bar would end the cell.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    result += c == '|' ? "\\|" : std::string(1, c);
  }
  return result;
}

}  // namespace

MarkdownWriter::MarkdownWriter(std::set<std::string> tunable) : tunable_(std::move(tunable)) { openSection("", ""); }

void MarkdownWriter::number(const char* name, double& value, Range range, const char* meaning) {
  row(name, formatNumber(value), describeRange(range), meaning);
}

void MarkdownWriter::integer(const char* name, int& value, Range range, const char* meaning) {
  row(name, std::to_string(value), describeRange(range), meaning);
}

void MarkdownWriter::flag(const char* name, bool& value, const char* meaning) {
  row(name, value ? "true" : "false", "true or false", meaning);
}

void MarkdownWriter::text(const char* name, std::string& value, const char* meaning) { row(name, value, "", meaning); }

void MarkdownWriter::choice(const char* name, std::string& value, std::initializer_list<const char*> options,
                            const char* meaning) {
  row(name, value, joinAlternatives({options.begin(), options.end()}), meaning);
}

void MarkdownWriter::numbers(const char* name, std::vector<double>& value, Range range, const char* meaning) {
  std::vector<std::string> items;
  std::transform(value.begin(), value.end(), std::back_inserter(items), formatNumber);
  row(name, joined(items), describeRange(range), meaning);
}

void MarkdownWriter::words(const char* name, std::vector<std::string>& value,
                           std::initializer_list<const char*> options, const char* meaning) {
  row(name, joined(value), joinAlternatives({options.begin(), options.end()}), meaning);
}

std::string MarkdownWriter::markdown() const {
  std::string text = "# Configuration reference\n\n";
  if (!tunable_.empty()) {
    text += kTunable + std::string(": may be changed while the nodelets run, see [nodelets](nodelets.md).\n\n");
  }
  for (const Section& section : sections_) {
    if (!section.key.empty()) {
      text += "## " + code(section.key) + "\n\n" + section.meaning + "\n\n";
    }
    if (!section.rows.empty()) {
      text += "| key | default | allowed | meaning |\n|---|---|---|---|\n" + section.rows + "\n";
    }
  }
  return text;
}

bool MarkdownWriter::enterGroup(const char* name, const char* meaning) {
  openSection(name, meaning);
  return true;
}

void MarkdownWriter::leaveGroup() { closeSection(); }

std::optional<std::size_t> MarkdownWriter::enterList(const char* name, std::size_t current_size, const char* meaning) {
  openSection(std::string(name) + "[]", meaning);
  if (current_size == 0) {
    return 1;  // one item to show its keys
  }
  return std::nullopt;
}

void MarkdownWriter::enterItem(std::size_t index) { rows_wanted_ = index == 0; }

void MarkdownWriter::leaveItem() { rows_wanted_ = true; }

void MarkdownWriter::leaveList() { closeSection(); }

void MarkdownWriter::openSection(const std::string& name, const std::string& meaning) {
  open_.push_back(sections_.size());
  sections_.push_back({name.empty() ? "" : path_.key(name), meaning, ""});
  if (!name.empty()) {
    path_.enter(name);
  }
}

void MarkdownWriter::closeSection() {
  open_.pop_back();
  path_.leave();
}

void MarkdownWriter::row(const std::string& name, const std::string& value, const std::string& allowed,
                         const std::string& meaning) {
  if (rows_wanted_) {
    const std::string mark = tunable_.count(path_.key(name)) > 0 ? std::string(" ") + kTunable : "";
    sections_[open_.back()].rows += "| " + code(escaped(name)) + mark + " | " + code(escaped(value)) + " | " +
                                    escaped(allowed) + " | " + escaped(meaning) + " |\n";
  }
}

}  // namespace slipnav
