#include "campaign/workers/process_pool.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace tern {
namespace {

constexpr int kNotExecuted = 127;

/// Between fork and exec, in the child. Only what is allowed there: no memory is taken.
[[noreturn]] void become(char* const* arguments, int out, const char* error_file, pid_t parent, rlim_t cpu_limit_s) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kNotExecuted);  // it died before the kernel knew
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const int null = open("/dev/null", O_RDONLY);
  const int error = open(error_file, O_WRONLY | O_CREAT | O_APPEND, 0644);
  const rlimit limit{cpu_limit_s, cpu_limit_s + 5};
  if (dup2(null, STDIN_FILENO) < 0 || dup2(out, STDOUT_FILENO) < 0 || dup2(error, STDERR_FILENO) < 0) {
    _exit(kNotExecuted);
  }
  setrlimit(RLIMIT_CPU, &limit);
  execv(arguments[0], arguments);
  _exit(kNotExecuted);
}

}  // namespace

ProcessPool::~ProcessPool() { kill_all(); }

void ProcessPool::start(std::uint64_t key, const std::vector<std::string>& command, const std::string& error_file,
                        std::int64_t cpu_limit_s) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(fmt::format("pipe: {}", std::strerror(errno)));
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid == 0) become(arguments.data(), ends[1], error_file.c_str(), parent, static_cast<rlim_t>(cpu_limit_s));
  close(ends[1]);
  if (pid < 0) {
    close(ends[0]);
    throw std::runtime_error(fmt::format("fork: {}", std::strerror(errno)));
  }
  setpgid(pid, pid);  // here and in the child: whoever comes first
  children_[key] = {pid, ends[0], {}};
}

std::vector<std::uint64_t> ProcessPool::keys() const {
  std::vector<std::uint64_t> keys;
  for (const auto& [key, child] : children_) keys.push_back(key);
  return keys;
}

FinishedProcess ProcessPool::reap(std::uint64_t key, Child& child) {
  close(child.fd);
  int status = 0;
  while (waitpid(child.pid, &status, 0) < 0 && errno == EINTR) {
  }
  FinishedProcess finished{key, std::move(child.output), std::nullopt, 0};
  if (WIFEXITED(status)) finished.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) finished.signal = WTERMSIG(status);
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
