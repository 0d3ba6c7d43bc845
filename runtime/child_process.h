// Child processes that end with their parent.
#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tern {

/// How to start a program.
struct ChildProcess {
  std::vector<std::string> command;  ///< program (looked up in PATH if its name has no slash) and arguments
  int out = STDOUT_FILENO;           ///< the descriptor that becomes its standard output
  int error = STDERR_FILENO;         ///< the descriptor that becomes its standard error
  std::vector<int> inherited = {};   ///< close-on-exec descriptors that the child keeps
  bool own_group = false;            ///< starts a process group of its own: a terminal's Ctrl-C does not reach it
  std::optional<std::uint64_t> cpu_limit_s = {};         ///< CPU time after which SIGXCPU ends it
  std::optional<std::uint64_t> memory_limit_bytes = {};  ///< limit of its address space
};

/// How a process ended.
struct ProcessEnd {
  int exit_code = 0;  ///< valid if signal is 0
  int signal = 0;     ///< signal that ended it, or 0
};

/// Starts a program with empty standard input and no signal blocked. The kernel kills it when the parent, or the thread
/// that calls this, ends for any reason. A child that cannot execute the program reports why on its standard error. Its
/// exit code is then 127 if the program does not exist, else 126.
/// @return its process id  @throws std::runtime_error if no process can be made
pid_t start_child(const ChildProcess& child);

/// Opens a file for appending, close-on-exec. @return its descriptor  @throws std::runtime_error that names the file
int open_log(const std::string& path);

/// Waits until a child has ended. @pre it has not been waited for
ProcessEnd await_child(pid_t pid);

/// @return how a child ended, or nullopt if it still runs.
std::optional<ProcessEnd> poll_child(pid_t pid);

}  // namespace tern
