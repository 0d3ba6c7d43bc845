// A program that a test starts, reads and ends.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>
#include <string>
#include <vector>

namespace tern {

/// How long a test waits for an event that must happen. No test asserts a time.
inline constexpr int kPatienceMs = 180'000;

/// A child process and its stdout and stderr.
class Child {
 public:
  /// @param argv  the program first  @param ignore_sigint  as a script's background job has it
  explicit Child(std::vector<std::string> argv, bool ignore_sigint = false) {
    int pipe_fds[2];
    if (pipe(pipe_fds) != 0) throw std::runtime_error("pipe");
    pid_ = fork();
    if (pid_ == 0) {
      if (ignore_sigint) std::signal(SIGINT, SIG_IGN);
      dup2(pipe_fds[1], STDOUT_FILENO);
      dup2(pipe_fds[1], STDERR_FILENO);
      close(pipe_fds[0]);
      std::vector<char*> arguments;
      for (std::string& argument : argv) arguments.push_back(argument.data());
      arguments.push_back(nullptr);
      execvp(arguments[0], arguments.data());
      _exit(126);
    }
    close(pipe_fds[1]);
    output_fd_ = pipe_fds[0];
  }
  ~Child() {
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
    close(output_fd_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  void signal(int number) const { kill(pid_, number); }

  /// Returns at once whether the process has ended. `output` holds its output so far.
  bool has_ended() {
    while (speaks(0)) {
      if (!hear()) return true;
    }
    return false;
  }

  /// Waits for the end of the process; `output` then holds all of its output.
  /// @return the exit code, or −signal if a signal ended it
  int wait() {
    do {
      if (!speaks(kPatienceMs)) kill(pid_, SIGKILL);
    } while (hear());
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  std::string output;

 private:
  /// Returns whether the process prints something or ends within this time.
  [[nodiscard]] bool speaks(int patience_ms) const {
    pollfd fd{output_fd_, POLLIN, 0};
    return poll(&fd, 1, patience_ms) != 0;
  }
  /// Reads its next output. @return false at its end
  bool hear() {
    char buffer[4096];
    const ssize_t n = read(output_fd_, buffer, sizeof(buffer));
    if (n > 0) output.append(buffer, static_cast<std::size_t>(n));
    return n > 0;
  }

  pid_t pid_ = 0;
  int output_fd_ = -1;
};

}  // namespace tern
