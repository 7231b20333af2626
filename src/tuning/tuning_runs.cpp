#include "tuning/tuning_runs.h"

#include <cstdlib>
#include <iostream>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace slipnav {
namespace {

/// A field of a line; strtod reads hexadecimal floating point, which streams do not.
double numberOf(const std::string& word) {
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  if (word.empty() || *end != '\0') {
    throw std::invalid_argument("'" + word + "' is not a number");
  }
  return value;
}

std::size_t countOf(std::istream& text) {
  std::size_t count = 0;
  if (!(text >> count)) {
    throw std::invalid_argument("a count is missing");
  }
  return count;
}

std::vector<double> numbersOf(std::istream& text) {
  std::vector<double> numbers;
  for (std::string word; text >> word;) {
    numbers.push_back(numberOf(word));
  }
  return numbers;
}

std::ostringstream exactStream() {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::hexfloat;
  return out;
}

}  // namespace

std::string runText(const TuningRun& run) {
  std::ostringstream out = exactStream();
  out << run.drive << ' ' << run.stretches;
  for (const double value : run.position) {
    out << ' ' << value;
  }
  return out.str();
}

TuningRun runFromText(const std::string& text) {
  std::istringstream in(text);
  TuningRun run;
  run.drive = countOf(in);
  run.stretches = countOf(in);
  const std::vector<double> position = numbersOf(in);
  run.position = Eigen::VectorXd::Map(position.data(), static_cast<Eigen::Index>(position.size()));
  return run;
}

std::string likelihoodText(const DriveLikelihood& likelihood) {
  std::ostringstream out = exactStream();
  for (const ComponentSums& stretch : likelihood) {
    for (const InnovationSums& kind : stretch) {
      out << kind.measurements << ' ' << kind.rows << ' ' << kind.log_likelihood << ' ' << kind.squared << ' ';
    }
  }
  return out.str();
}

DriveLikelihood likelihoodFromText(const std::string& text) {
  constexpr std::size_t kNumbers = 4;
  constexpr std::size_t kStretch = kNumbers * kComponents;
  std::istringstream in(text);
  const std::vector<double> numbers = numbersOf(in);
  if (numbers.size() % kStretch != 0) {
    throw std::invalid_argument("a likelihood of " + std::to_string(numbers.size()) + " numbers");
  }
  DriveLikelihood likelihood(numbers.size() / kStretch);
  auto number = numbers.begin();
  for (ComponentSums& stretch : likelihood) {
    for (InnovationSums& kind : stretch) {
      kind = {number[0], number[1], number[2], number[3]};
      number += kNumbers;
    }
  }
  return likelihood;
}

DriveLikelihood RunExchange::ask(const TuningRun& run) {
  std::unique_lock<std::mutex> lock(mutex_);
  const std::size_t number = next_++;
  requests_ << "run " + std::to_string(number) + " " + runText(run) + "\n" << std::flush;
  while (pending_.count(number) == 0) {
    if (ended_) {
      throw std::runtime_error("what makes the runs has ended");
    }
    if (reading_) {
      read_.wait(lock);
    } else {
      readOne(lock);
    }
  }
  std::istringstream answer(pending_.extract(number).mapped());
  std::string word;
  std::string rest;
  answer >> word;
  std::getline(answer >> std::ws, rest);
  if (word != "done") {
    throw std::runtime_error(rest);
  }
  return likelihoodFromText(rest);
}

void RunExchange::readOne(std::unique_lock<std::mutex>& lock) {
  reading_ = true;
  lock.unlock();
  std::string line;
  const bool is_read = static_cast<bool>(std::getline(answers_, line));
  lock.lock();
  reading_ = false;
  std::istringstream words(line);
  std::string word;
  std::size_t number = 0;
  std::string rest;
  if (is_read && words >> word >> number) {
    std::getline(words >> std::ws, rest);
    pending_[number] = word + " " + rest;
  }
  ended_ = !is_read;
  read_.notify_all();
}

}  // namespace slipnav
