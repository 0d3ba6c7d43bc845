#include "runtime/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>

namespace tern {
namespace {

constexpr int kNotFound = 127, kNotExecutable = 126;

void say(const char* text) { (void)!write(STDERR_FILENO, text, std::strlen(text)); }

/// Runs in the child between fork and exec, so it must not allocate.
[[noreturn]] void become(const ChildProcess& child, char* const* arguments, pid_t parent) {
  if (child.own_group) setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kNotFound);  // the parent died before prctl took effect
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const int null = open("/dev/null", O_RDONLY);
  if (dup2(null, STDIN_FILENO) < 0 || dup2(child.out, STDOUT_FILENO) < 0 || dup2(child.error, STDERR_FILENO) < 0) {
    _exit(kNotFound);
  }
  for (const int fd : child.inherited) fcntl(fd, F_SETFD, 0);
  const rlim_t cpu_s = child.cpu_limit_s.value_or(0), bytes = child.memory_limit_bytes.value_or(0);
  const rlimit cpu{cpu_s, cpu_s + 5}, memory{bytes, bytes};
  if (child.cpu_limit_s) setrlimit(RLIMIT_CPU, &cpu);
  if (child.memory_limit_bytes) setrlimit(RLIMIT_AS, &memory);
  execvp(arguments[0], arguments);
  const bool found = errno != ENOENT;
  say(arguments[0]);
  say(found ? ": cannot be executed\n" : ": no such program\n");
  _exit(found ? kNotExecutable : kNotFound);
}

std::optional<ProcessEnd> wait_for(pid_t pid, int options) {
  int status = 0;
  pid_t ended = 0;
  while ((ended = waitpid(pid, &status, options)) < 0 && errno == EINTR) {
  }
  if (ended == 0) return std::nullopt;
  return WIFSIGNALED(status) ? ProcessEnd{0, WTERMSIG(status)} : ProcessEnd{WEXITSTATUS(status), 0};
}

}  // namespace

pid_t start_child(const ChildProcess& child) {
  std::vector<char*> arguments;
  for (const std::string& word : child.command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid == 0) become(child, arguments.data(), parent);
  if (pid < 0) throw std::runtime_error(fmt::format("fork: {}", std::strerror(errno)));
  if (child.own_group) setpgid(pid, pid);  // in parent and child, whichever is first
  return pid;
}

int open_log(const std::string& path) {
  const int fd = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (fd < 0) throw std::runtime_error(fmt::format("{}: {}", path, std::strerror(errno)));
  return fd;
}

ProcessEnd await_child(pid_t pid) { return *wait_for(pid, 0); }

std::optional<ProcessEnd> poll_child(pid_t pid) { return wait_for(pid, WNOHANG); }

}  // namespace tern
