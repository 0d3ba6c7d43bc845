#include "planner/app/worker.h"

#include <utility>

namespace tern {

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
    if (job_) return false;
    job_ = std::move(job);
  }
  changed_.notify_all();
  return true;
}

bool Worker::busy() const {
  const std::lock_guard lock(mutex_);
  return static_cast<bool>(job_);
}

void Worker::run() {
  for (;;) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return stopping_ || job_; });
    if (stopping_) return;
    lock.unlock();
    job_();
    lock.lock();
    job_ = nullptr;
  }
}

}  // namespace tern
