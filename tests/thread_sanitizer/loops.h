#pragma once
/// The part of oneTBB that halyard uses, on std::thread, for builds with the thread sanitizer.
///
/// Debian's libtbb is not instrumented: the sanitizer sees neither how it hands work to its threads nor how it waits
/// for them, and would report every result that the body of a loop leaves behind. Here it sees both, and so what it
/// reports is a race between the bodies. A loop inside a loop runs on the thread that comes to it.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <iterator>
#include <mutex>
#include <thread>
#include <vector>

namespace tbb {

namespace loops {

inline std::atomic<std::size_t> most_threads{0};  ///< 0: no limit
inline thread_local int arena_threads = 0;        ///< 0: outside an arena
inline thread_local bool inside_a_loop = false;

inline std::size_t threads_for(std::size_t items) {
  if (inside_a_loop) return 1;
  std::size_t threads = std::max(4u, std::thread::hardware_concurrency());  // more than one on any machine
  if (most_threads > 0) threads = std::min<std::size_t>(threads, most_threads);
  if (arena_threads > 0) threads = std::min<std::size_t>(threads, arena_threads);
  return std::min(threads, items);
}

/// Calls item(i) for i = 0..items-1; throws what one of the calls throws.
template <class Item>
void run(std::size_t items, const Item& item) {
  const std::size_t threads = threads_for(items);
  if (threads <= 1) {
    for (std::size_t i = 0; i < items; ++i) item(i);
    return;
  }
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failing;
  const auto work = [&] {
    inside_a_loop = true;
    for (std::size_t i = next++; i < items; i = next++) {
      try {
        item(i);
      } catch (...) {
        const std::lock_guard lock(failing);
        if (!failure) failure = std::current_exception();
        next = items;
      }
    }
    inside_a_loop = false;
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t t = 1; t < threads; ++t) others.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace loops

template <class Index, class Body>
void parallel_for(Index first, Index last, const Body& body) {
  if (first < last)
    loops::run(static_cast<std::size_t>(last - first), [&](std::size_t i) { body(first + static_cast<Index>(i)); });
}

template <class Items, class Body>
void parallel_for_each(const Items& items, const Body& body) {
  loops::run(std::size(items), [&](std::size_t i) { body(*std::next(std::begin(items), std::ptrdiff_t(i))); });
}

template <class Index>
class blocked_range {
 public:
  blocked_range(Index begin, Index end, std::size_t = 1) : begin_(begin), end_(end) {}
  Index begin() const { return begin_; }
  Index end() const { return end_; }

 private:
  Index begin_, end_;
};

struct simple_partitioner {};

template <class Index, class Body>
void parallel_for(const blocked_range<Index>& range, const Body& body, const simple_partitioner&) {
  parallel_for(range.begin(), range.end(), [&](Index i) { body(blocked_range<Index>(i, i + 1)); });
}

class global_control {
 public:
  enum parameter { max_allowed_parallelism };
  global_control(parameter, std::size_t most) : before_(loops::most_threads.exchange(most)) {}
  global_control(const global_control&) = delete;
  global_control& operator=(const global_control&) = delete;
  ~global_control() { loops::most_threads = before_; }

 private:
  std::size_t before_;
};

class task_arena {
 public:
  explicit task_arena(int threads = 0) : threads_(threads) {}
  template <class Work>
  auto execute(const Work& work) {
    struct Restored {
      int before = loops::arena_threads;
      ~Restored() { loops::arena_threads = before; }
    } restored;
    loops::arena_threads = threads_;
    return work();
  }

 private:
  int threads_;
};

namespace this_task_arena {
template <class Work>
auto isolate(const Work& work) {
  return work();
}
}  // namespace this_task_arena

namespace info {
inline int default_concurrency() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }
}  // namespace info

}  // namespace tbb
