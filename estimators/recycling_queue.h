#pragma once
/// A queue of which removed elements keep their memory for later ones: in steady state it takes none from the heap.

#include <cstddef>
#include <utility>
#include <vector>

namespace halyard {

template <class T>
class RecyclingQueue {
 public:
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T& operator[](std::size_t i) { return slots_[(first_ + i) % slots_.size()]; }
  const T& operator[](std::size_t i) const { return slots_[(first_ + i) % slots_.size()]; }
  T& front() { return (*this)[0]; }
  T& back() { return (*this)[size_ - 1]; }
  const T& back() const { return (*this)[size_ - 1]; }

  /// Appends an element. It has the value of some removed one: the caller has to set all of it.
  T& append() {
    if (size_ == slots_.size()) grow();
    ++size_;
    return back();
  }
  /// Removes the first `count` elements.
  void remove_front(std::size_t count = 1) {
    if (count == 0) return;
    first_ = (first_ + count) % slots_.size();
    size_ -= count;
  }
  void clear() { size_ = 0; }

 private:
  void grow() {
    std::vector<T> larger(2 * size_ + 4);
    for (std::size_t i = 0; i < size_; ++i) larger[i] = std::move((*this)[i]);
    slots_ = std::move(larger);
    first_ = 0;
  }

  std::vector<T> slots_;
  std::size_t first_ = 0, size_ = 0;
};

}  // namespace halyard
