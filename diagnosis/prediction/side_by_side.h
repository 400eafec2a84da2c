#pragma once
/// Jobs that run side by side and share the lanes of their predictions. A fit asks for few predictions at a time and
/// waits for them. When every job of a meeting is waiting, all their hypotheses are predicted at once, and the lanes
/// are full. There are two meetings: while the jobs of one solve for their next step, or it predicts too little for all
/// cores, the other keeps the cores busy. Each job gets exactly the numbers that it would get alone.

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <vector>

#include "diagnosis/prediction/prediction.h"

namespace halyard {

/// Runs job(0), ..., job(n - 1), sixteen at a time, every other one in the same meeting. Each runs on a thread of its
/// own. Throws what the first job that failed has thrown, when all have ended.
void run_side_by_side(std::size_t n, const std::function<void(std::size_t)>& job);

/// A meeting of jobs that run at the same time.
class SideBySide {
 public:
  explicit SideBySide(std::size_t n_jobs) : running_(n_jobs) {}

  /// That of the job on this thread; null if it runs alone.
  static SideBySide* of_this_thread();

  /// Waits until all its jobs that run want a prediction, and returns this one's. Called by a thread that enter()ed.
  std::vector<std::vector<Residuals>> predict(const std::vector<PredictionRequest>& requests);

  /// The calling thread runs a job of that number; of two that wait the one with the lower number comes first.
  void enter(std::size_t number);
  void leave();

 private:
  struct Waiting {
    std::size_t job;
    const std::vector<PredictionRequest>* requests;
    std::vector<std::vector<Residuals>> residuals;
    std::exception_ptr error;
    bool is_served = false;
  };

  void serve_if_all_wait();
  void serve();

  std::mutex mutex_;
  std::condition_variable served_;
  std::size_t running_;
  std::vector<Waiting*> waiting_;
};

}  // namespace halyard
