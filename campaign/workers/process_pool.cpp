#include "campaign/workers/process_pool.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "runtime/child_process.h"

namespace tern {

ProcessPool::~ProcessPool() { kill_all(); }

void ProcessPool::start(std::uint64_t key, const std::vector<std::string>& command, const std::string& error_file,
                        std::int64_t cpu_limit_s) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(fmt::format("pipe: {}", std::strerror(errno)));
  const int error = open_log(error_file);
  ChildProcess child{.command = command, .out = ends[1], .error = error, .own_group = true};
  child.cpu_limit_s = static_cast<std::uint64_t>(cpu_limit_s);
  children_[key] = {start_child(child), ends[0], {}};
  close(ends[1]);
  close(error);
}

std::vector<std::uint64_t> ProcessPool::keys() const {
  std::vector<std::uint64_t> keys;
  for (const auto& [key, child] : children_) keys.push_back(key);
  return keys;
}

FinishedProcess ProcessPool::reap(std::uint64_t key, Child& child) {
  close(child.fd);
  const ProcessEnd end = await_child(child.pid);
  FinishedProcess finished{key, std::move(child.output), end.exit_code, end.signal};
  if (end.signal != 0) finished.exit_code.reset();
  return finished;
}

std::vector<FinishedProcess> ProcessPool::wait(int stop_fd, int timeout_ms, bool& stop) {
  std::vector<pollfd> fds;
  for (const auto& [key, child] : children_) fds.push_back({child.fd, POLLIN, 0});
  fds.push_back({stop_fd, POLLIN, 0});
  std::vector<FinishedProcess> finished;
  if (poll(fds.data(), fds.size(), timeout_ms) <= 0) return finished;
  stop = fds.back().revents != 0;
  std::size_t k = 0;
  for (auto at = children_.begin(); at != children_.end(); ++k) {
    Child& child = at->second;
    std::array<char, 65536> buffer;
    const ssize_t n = fds[k].revents == 0 ? -1 : read(child.fd, buffer.data(), buffer.size());
    if (n > 0) child.output.append(buffer.data(), static_cast<std::size_t>(n));
    if (n == 0) {
      finished.push_back(reap(at->first, child));
      at = children_.erase(at);
    } else {
      ++at;
    }
  }
  return finished;
}

void ProcessPool::kill_all() {
  for (auto& [key, child] : children_) kill(-child.pid, SIGKILL);
  for (auto& [key, child] : children_) (void)reap(key, child);
  children_.clear();
}

}  // namespace tern
