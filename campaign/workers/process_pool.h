// A few child processes at once, each asked for one result on its standard output.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tern {

/// How a child ended.
struct FinishedProcess {
  std::uint64_t key = 0;
  std::string output;            ///< all that it wrote to standard output
  std::optional<int> exit_code;  ///< nullopt: a signal ended it …
  int signal = 0;                ///< … this one
};

/// Children lead process groups of their own, so that a terminal's Ctrl-C reaches the parent alone. The kernel kills
/// them when the parent dies, however that comes. Not thread-safe; the parent stays single-threaded.
class ProcessPool {
 public:
  ProcessPool() = default;
  /// Kills what still runs.
  ~ProcessPool();
  ProcessPool(const ProcessPool&) = delete;
  ProcessPool& operator=(const ProcessPool&) = delete;

  /// Starts a program with its arguments. Standard input is empty, standard error goes to a file.
  /// @param cpu_limit_s  more CPU time than this ends it by SIGXCPU
  /// @throws std::runtime_error when no process can be made. What cannot be executed ends with exit code 127.
  void start(std::uint64_t key, const std::vector<std::string>& command, const std::string& error_file,
             std::int64_t cpu_limit_s);
  [[nodiscard]] std::size_t running() const { return children_.size(); }
  [[nodiscard]] std::vector<std::uint64_t> keys() const;

  /// Waits for children to end, for `stop_fd` to become readable, or for the time to pass. @return those that ended;
  /// `stop` says whether stop_fd is readable.
  std::vector<FinishedProcess> wait(int stop_fd, int timeout_ms, bool& stop);
  /// Ends all children by SIGKILL and forgets them.
  void kill_all();

 private:
  struct Child {
    pid_t pid = 0;
    int fd = -1;  ///< of the pipe from its standard output
    std::string output;
  };
  FinishedProcess reap(std::uint64_t key, Child& child);

  std::map<std::uint64_t, Child> children_;
};

}  // namespace tern
