#pragma once

#include <tbb/parallel_for.h>

#include <atomic>
#include <cstddef>
#include <exception>
#include <limits>
#include <mutex>

namespace halyard {

/// Exceptions of the bodies of a parallel loop with parallel loops inside. If a body threw, oneTBB would cancel the
/// inner loops of the other bodies as well: these loops return early without an error, with results that are not there.
/// Here the other bodies run to their end. A body that has not begun does nothing if one before it has thrown, in the
/// order of their indices: what is thrown in the end does not depend on the threads.
class FirstFailure {
 public:
  /// Calls `body` unless one of a smaller index has thrown. May be called by several threads.
  template <class Body>
  void keep(std::size_t index, const Body& body) {
    if (first_ < index) return;
    try {
      body();
    } catch (...) {
      const std::lock_guard lock(failing_);
      if (index < first_) first_ = index, failure_ = std::current_exception();
    }
  }

  /// Call after the loop. Throws what the body of the smallest index threw.
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::atomic<std::size_t> first_ = std::numeric_limits<std::size_t>::max();  ///< index of failure_
  std::mutex failing_;
  std::exception_ptr failure_;
};

/// Calls body(0), ..., body(count - 1) in parallel. Throws what the body of the smallest index threw.
template <class Body>
void for_each_in_parallel(std::size_t count, const Body& body) {
  FirstFailure failure;
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { failure.keep(i, [&] { body(i); }); });
  failure.rethrow();
}

}  // namespace halyard
