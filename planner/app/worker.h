// A thread that runs one job at a time beside the receiving thread: planning, or preparing maps and fields.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace tern {

/// Runs jobs one at a time. If a job throws, the worker takes no further job (failure()).
class Worker {
 public:
  Worker();
  /// Waits for the running job.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Starts the job if the worker is idle. @return false if it is busy or has failed
  bool try_start(std::function<void()> job);
  [[nodiscard]] bool busy() const;
  /// Returns the text of the exception that a job threw.
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
