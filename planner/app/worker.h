// A thread that runs one job at a time: planning, or preparing what planning needs, off the receiving thread.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace tern {

/// What a job throws ends it and the worker, which then takes no more: see failure().
class Worker {
 public:
  Worker();
  /// Waits for the running job.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Starts the job if the worker is idle. @return false when it is busy or has failed; the job is then not taken.
  bool try_start(std::function<void()> job);
  [[nodiscard]] bool busy() const;
  /// The text of what a job threw.
  [[nodiscard]] std::optional<std::string> failure() const;

 private:
  void run();
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::function<void()> job_;
  std::optional<std::string> failure_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace tern
