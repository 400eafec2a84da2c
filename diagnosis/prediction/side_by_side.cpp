#include "diagnosis/prediction/side_by_side.h"

#include <algorithm>
#include <deque>
#include <system_error>
#include <thread>

namespace halyard {
namespace {

constexpr std::size_t kAtOnce = 16;
constexpr std::size_t kMeetings = 2;

thread_local SideBySide* meeting_of_thread = nullptr;
thread_local std::size_t number_of_thread = 0;

}  // namespace

SideBySide* SideBySide::of_this_thread() { return meeting_of_thread; }

void SideBySide::enter(std::size_t number) {
  meeting_of_thread = this;
  number_of_thread = number;
}

void SideBySide::leave() {
  meeting_of_thread = nullptr;
  const std::lock_guard lock(mutex_);
  --running_;
  serve_if_all_wait();
}

std::vector<std::vector<Residuals>> SideBySide::predict(const std::vector<PredictionRequest>& requests) {
  Waiting own{number_of_thread, &requests, {}, {}};
  std::unique_lock lock(mutex_);
  waiting_.push_back(&own);
  serve_if_all_wait();
  served_.wait(lock, [&] { return own.is_served; });
  if (own.error) std::rethrow_exception(own.error);
  return std::move(own.residuals);
}

void SideBySide::serve_if_all_wait() {
  if (!waiting_.empty() && waiting_.size() == running_) serve();
}

/// In the order of the jobs, so that the lanes are filled alike in every run.
void SideBySide::serve() {
  try {
    std::ranges::sort(waiting_, {}, &Waiting::job);
    std::vector<PredictionRequest> all;
    for (const Waiting* w : waiting_) all.insert(all.end(), w->requests->begin(), w->requests->end());
    auto residuals = predict_at_once(all);
    auto next = std::make_move_iterator(residuals.begin());
    for (Waiting* w : waiting_) {
      const auto end = next + std::ssize(*w->requests);
      w->residuals.assign(next, end);
      next = end;
    }
  } catch (...) {
    for (Waiting* w : waiting_) w->error = std::current_exception();
  }
  for (Waiting* w : waiting_) w->is_served = true;
  waiting_.clear();
  served_.notify_all();
}

void run_side_by_side(std::size_t n, const std::function<void(std::size_t)>& job) {
  const std::size_t width = std::min(n, kAtOnce);
  if (n <= 1) {
    if (n == 1) job(0);
    return;
  }
  std::deque<SideBySide> meetings;
  for (std::size_t m = 0; m < kMeetings; ++m) meetings.emplace_back((width + kMeetings - 1 - m) / kMeetings);
  std::vector<std::exception_ptr> errors(n);
  // Each thread has its jobs beforehand: which jobs meet does not depend on how fast they are.
  const auto run = [&](std::size_t first) {
    SideBySide& meeting = meetings[first % kMeetings];
    meeting.enter(first);
    for (std::size_t i = first; i < n; i += width) {
      try {
        job(i);
      } catch (...) {
        errors[i] = std::current_exception();
      }
    }
    meeting.leave();
  };
  {
    std::vector<std::jthread> threads;
    const auto start = [&](std::size_t first) {
      try {
        threads.emplace_back(run, first);
      } catch (const std::system_error&) {  // no more threads: the others must not wait for its jobs
        errors[first] = std::current_exception();
        meetings[first % kMeetings].leave();
      }
    };
    for (std::size_t first = 0; first < width; ++first) start(first);
  }
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

}  // namespace halyard
