#pragma once
/// First-in first-out queue in one block of memory that only grows: no allocation once it has reached its size.

#include <cstddef>
#include <utility>
#include <vector>

namespace slipnav {

/// @tparam T default-constructible and copyable
template <class T>
class RingQueue {
 public:
  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  T& front() { return items_[head_]; }
  const T& front() const { return items_[head_]; }
  T& back() { return (*this)[size_ - 1]; }
  const T& back() const { return (*this)[size_ - 1]; }
  T& operator[](std::size_t i) { return items_[(head_ + i) & (items_.size() - 1)]; }
  const T& operator[](std::size_t i) const { return items_[(head_ + i) & (items_.size() - 1)]; }

  void push_back(const T& item) {
    if (size_ == items_.size()) {
      grow();
    }
    ++size_;
    back() = item;
  }

  void pop_front() {
    head_ = (head_ + 1) & (items_.size() - 1);
    --size_;
  }

  void pop_back() { --size_; }

  /// Inserts so that `item` comes after every element for which `before(item, element)` is false.
  template <class Before>
  void insertSorted(const T& item, Before before) {
    push_back(item);
    for (std::size_t i = size_ - 1; i > 0 && before((*this)[i], (*this)[i - 1]); --i) {
      std::swap((*this)[i], (*this)[i - 1]);
    }
  }

  void clear() {
    head_ = 0;
    size_ = 0;
  }

 private:
  void grow() {
    std::vector<T> larger(items_.empty() ? 16 : 2 * items_.size());
    for (std::size_t i = 0; i < size_; ++i) {
      larger[i] = (*this)[i];
    }
    items_.swap(larger);
    head_ = 0;
  }

  std::vector<T> items_;  ///< a power of two in length
  std::size_t head_ = 0;
  std::size_t size_ = 0;
};

}  // namespace slipnav
