#include "slipnav/core/base/ring_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <functional>

#include "simulation/random.h"

namespace slipnav {
namespace {

template <class T>
void expectSame(const RingQueue<T>& queue, const std::deque<T>& reference) {
  ASSERT_EQ(queue.size(), reference.size());
  ASSERT_EQ(queue.empty(), reference.empty());
  for (std::size_t i = 0; i < reference.size(); ++i) {
    ASSERT_EQ(queue[i], reference[i]);
  }
  if (!reference.empty()) {
    ASSERT_EQ(queue.front(), reference.front());
    ASSERT_EQ(queue.back(), reference.back());
  }
}

TEST(RingQueue, IsADequeWhateverTheOrderOfOperations) {
  RingQueue<int> queue;
  std::deque<int> reference;
  sim::RandomStream random(1, "queue");
  for (int i = 0; i < 5000; ++i) {
    // grows to some hundreds, wraps around many times, and shrinks to nothing
    const double push_share = i % 1000 < 500 ? 0.7 : 0.3;
    if (random.uniform() < push_share) {
      queue.push_back(i);
      reference.push_back(i);
    } else if (!reference.empty()) {
      queue.pop_front();
      reference.pop_front();
    }
    expectSame(queue, reference);
  }
}

TEST(RingQueue, ClearEmptiesAndTheQueueStaysUsable) {
  RingQueue<int> queue;
  for (int i = 0; i < 40; ++i) {
    queue.push_back(i);
  }
  queue.clear();
  EXPECT_TRUE(queue.empty());
  queue.push_back(7);
  EXPECT_EQ(queue.front(), 7);
  EXPECT_EQ(queue.size(), 1U);
}

TEST(RingQueue, InsertsInOrder) {
  RingQueue<int> queue;
  std::deque<int> reference;
  sim::RandomStream random(2, "queue");
  for (int i = 0; i < 300; ++i) {
    const int value = static_cast<int>(random.uniform(0.0, 1000.0));
    queue.insertSorted(value, std::less<int>());
    reference.insert(std::upper_bound(reference.begin(), reference.end(), value), value);
    if (i % 7 == 0) {
      queue.pop_front();
      reference.pop_front();
    }
    expectSame(queue, reference);
  }
}

TEST(RingQueue, EqualItemsKeepTheirOrder) {
  struct Item {
    int key;
    int arrival;
  };
  RingQueue<Item> queue;
  for (int i = 0; i < 30; ++i) {
    queue.insertSorted({i % 3, i}, [](const Item& a, const Item& b) { return a.key < b.key; });
  }
  for (std::size_t i = 1; i < queue.size(); ++i) {
    EXPECT_TRUE(queue[i - 1].key < queue[i].key ||
                (queue[i - 1].key == queue[i].key && queue[i - 1].arrival < queue[i].arrival));
  }
}

}  // namespace
}  // namespace slipnav
