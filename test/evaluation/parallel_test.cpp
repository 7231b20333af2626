#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "evaluation/parallel_for.h"
#include "evaluation/progress_bar.h"

namespace slipnav {
namespace {

TEST(ParallelTest, allOnceAndTheFirstErrorComesOut) {
  std::vector<std::atomic<int>> calls(50);
  parallelFor(calls.size(), 4, [&calls](std::size_t i) { ++calls[i]; });
  for (const std::atomic<int>& count : calls) {
    EXPECT_EQ(count, 1);
  }
  EXPECT_THROW(parallelFor(5, 2, [](std::size_t i) { i == 3 ? throw std::runtime_error("three") : void(); }),
               std::runtime_error);
}

TEST(ParallelTest, noMoreAreAtWorkThanThereAreCores) {
  Cores cores(2);
  std::atomic<int> busy = 0;
  std::atomic<int> most = 0;
  parallelFor(40, 8, [&](std::size_t) {
    cores.run([&] {
      const int now = ++busy;
      int before = most;
      while (before < now && !most.compare_exchange_weak(before, now)) {
      }
      --busy;
    });
  });
  EXPECT_LE(most, 2);
  EXPECT_THROW(cores.run([] { throw std::runtime_error("work"); }), std::runtime_error);
  EXPECT_THROW(cores.run([] { throw std::runtime_error("work"); }), std::runtime_error);
  cores.run([&most] { most = 0; });  // the failed ones have left
  EXPECT_EQ(most, 0);
}

TEST(ProgressBarTest, aLineEveryTenPercentWithoutATerminal) {
  std::ostringstream out;
  ProgressBar bar("tune", out, false);
  for (std::size_t done = 1; done <= 100; ++done) {
    bar.show(done, 100, std::to_string(done) + " runs");
  }
  bar.finish();
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
  EXPECT_EQ(text.substr(0, text.find('\n')), "tune: [####....................................] 10 %, 10 runs");
}

}  // namespace
}  // namespace slipnav
