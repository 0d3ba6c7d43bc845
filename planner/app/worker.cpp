#include "planner/app/worker.h"

#include <exception>
#include <utility>

namespace tern {
namespace {

/// Runs the job. @return the text of the exception that it threw, if any
std::optional<std::string> failure_of(const std::function<void()>& job) {
  try {
    job();
  } catch (const std::exception& e) {
    return e.what();
  } catch (...) {
    return "an exception that is not a std::exception";
  }
  return std::nullopt;
}

}  // namespace

Worker::Worker() : thread_([this] { run(); }) {}

Worker::~Worker() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

bool Worker::try_start(std::function<void()> job) {
  {
    const std::lock_guard lock(mutex_);
    if (job_ || failure_) return false;
    job_ = std::move(job);
  }
  changed_.notify_all();
  return true;
}

bool Worker::busy() const {
  const std::lock_guard lock(mutex_);
  return static_cast<bool>(job_);
}

std::optional<std::string> Worker::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

void Worker::run() {
  for (;;) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return stopping_ || job_; });
    if (stopping_) return;
    lock.unlock();
    auto failure = failure_of(job_);
    lock.lock();
    job_ = nullptr;
    failure_ = std::move(failure);
  }
}

}  // namespace tern
