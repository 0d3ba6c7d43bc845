// Runs a few child processes at once; each returns a result on its standard output.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tern {

/// How a child process ended.
struct FinishedProcess {
  std::uint64_t key = 0;
  std::string output;            ///< its whole standard output
  std::optional<int> exit_code;  ///< nullopt: ended by `signal`
  int signal = 0;                ///< if there is no exit code
};

/// Each child leads its own process group, so Ctrl-C in a terminal reaches only the parent. The kernel kills the
/// children if the parent dies for any reason. Not thread-safe; the parent must stay single-threaded.
class ProcessPool {
 public:
  ProcessPool() = default;
  /// Kills all running children.
  ~ProcessPool();
  ProcessPool(const ProcessPool&) = delete;
  ProcessPool& operator=(const ProcessPool&) = delete;

  /// Starts a program with its arguments. Standard input is empty; standard error goes to a file. A program that cannot
  /// be executed ends with exit code 127.
  /// @param cpu_limit_s  limit of CPU time; SIGXCPU ends the child beyond it
  /// @throws std::runtime_error if no process can be created
  void start(std::uint64_t key, const std::vector<std::string>& command, const std::string& error_file,
             std::int64_t cpu_limit_s);
  [[nodiscard]] std::size_t running() const { return children_.size(); }
  [[nodiscard]] std::vector<std::uint64_t> keys() const;

  /// Waits until a child ends, `stop_fd` becomes readable, or the time is over.
  /// @param stop  set to whether stop_fd is readable
  /// @return the children that ended
  std::vector<FinishedProcess> wait(int stop_fd, int timeout_ms, bool& stop);
  /// Kills all children by SIGKILL and forgets them.
  void kill_all();

 private:
  struct Child {
    pid_t pid = 0;
    int fd = -1;  ///< read end of the pipe from its standard output
    std::string output;
  };
  FinishedProcess reap(std::uint64_t key, Child& child);

  std::map<std::uint64_t, Child> children_;
};

}  // namespace tern
