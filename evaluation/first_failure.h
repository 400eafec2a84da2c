#pragma once

#include <atomic>
#include <exception>
#include <mutex>

namespace halyard {

/// Exceptions of the bodies of a parallel loop with parallel loops inside. If a body threw, oneTBB would cancel the
/// inner loops of the other bodies as well: these loops return early without an error, with results that are not there.
/// Here the other bodies run to their end, and bodies that have not begun do nothing.
class FirstFailure {
 public:
  /// Calls `body` unless one has thrown. May be called by several threads.
  template <class Body>
  void keep(const Body& body) {
    if (has_failed_) return;
    try {
      body();
    } catch (...) {
      const std::lock_guard lock(failing_);
      if (!failure_) failure_ = std::current_exception();
      has_failed_ = true;
    }
  }

  /// Call after the loop. Throws what the first body threw.
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::atomic<bool> has_failed_ = false;
  std::mutex failing_;
  std::exception_ptr failure_;
};

}  // namespace halyard
