/// Runs a fuzz target where libFuzzer is not at hand: takes inputs of its corpus, changes them at random, and feeds
/// them to it. A crash leaves the input in the file `crash` of the present folder.
///
/// usage: TARGET CORPUS_FOLDER RUNS [SEED]

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <vector>

#include "fuzz_target.h"

namespace {

using Input = std::vector<std::uint8_t>;

Input present_input;

void keepInput(int signal_number) {
  std::ofstream("crash", std::ios::binary)
      .write(reinterpret_cast<const char*>(present_input.data()), static_cast<std::streamsize>(present_input.size()));
  std::signal(signal_number, SIG_DFL);
  std::raise(signal_number);
}

std::vector<Input> readCorpus(const std::string& folder) {
  std::vector<Input> corpus;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream file(entry.path(), std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  std::sort(corpus.begin(), corpus.end());
  return corpus;
}

class Mutator {
 public:
  Mutator(std::vector<Input> corpus, std::uint64_t seed) : corpus_(std::move(corpus)), engine_(seed) {}

  Input next() {
    Input input = corpus_[below(corpus_.size())];
    const std::size_t changes = 1 + below(8);
    for (std::size_t i = 0; i < changes; ++i) {
      change(input);
    }
    return input;
  }

 private:
  std::size_t below(std::size_t limit) { return limit == 0 ? 0 : engine_() % limit; }

  void change(Input& input) {
    const std::size_t at = below(input.size());
    const auto begin = input.begin() + static_cast<std::ptrdiff_t>(at);
    const std::size_t length = std::min(1 + below(16), input.size() - at);
    const auto end = begin + static_cast<std::ptrdiff_t>(length);
    switch (below(6)) {
      case 0:
        std::for_each(begin, end, [this](std::uint8_t& byte) { byte = static_cast<std::uint8_t>(engine_()); });
        break;
      case 1:
        std::for_each(begin, end, [this](std::uint8_t& byte) { byte ^= static_cast<std::uint8_t>(1U << below(8)); });
        break;
      case 2:
        input.erase(begin, end);
        break;
      case 3: {
        const Input piece(begin, end);
        input.insert(input.begin() + static_cast<std::ptrdiff_t>(below(input.size())), piece.begin(), piece.end());
        break;
      }
      case 4:
        input.resize(at);
        break;
      default: {  // part of another input
        const Input& other = corpus_[below(corpus_.size())];
        const std::size_t from = below(other.size());
        input.insert(begin, other.begin() + static_cast<std::ptrdiff_t>(from), other.end());
        break;
      }
    }
  }

  std::vector<Input> corpus_;
  std::mt19937_64 engine_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: " << argv[0] << " CORPUS_FOLDER RUNS [SEED]\n";
    return 2;
  }
  std::vector<Input> corpus = readCorpus(argv[1]);
  if (corpus.empty()) {
    std::cerr << argv[1] << ": has no inputs to begin with\n";
    return 2;
  }
  for (const int signal_number : {SIGABRT, SIGSEGV, SIGFPE, SIGILL, SIGBUS}) {
    std::signal(signal_number, keepInput);
  }
  for (const Input& input : corpus) {
    present_input = input;
    LLVMFuzzerTestOneInput(present_input.data(), present_input.size());
  }
  Mutator mutator(std::move(corpus), argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1);
  const long long runs = std::atoll(argv[2]);
  for (long long i = 0; i < runs; ++i) {
    present_input = mutator.next();
    LLVMFuzzerTestOneInput(present_input.data(), present_input.size());
  }
  std::cout << runs << " inputs, no crash\n";
  return 0;
}
