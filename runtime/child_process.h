// Child processes that do not outlive their parent.
#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tern {

struct ChildProcess {
  std::vector<std::string> command;  ///< a program, looked up in PATH if its name has no slash, and its arguments
  int out = STDOUT_FILENO;           ///< the descriptor that becomes its standard output
  int error = STDERR_FILENO;         ///< the descriptor that becomes its standard error
  std::vector<int> inherited = {};   ///< close-on-exec descriptors that it gets nevertheless
  bool own_group = false;            ///< leads a process group, so that a terminal's Ctrl-C does not reach it
  std::optional<std::uint64_t> cpu_limit_s = {};         ///< more CPU time ends it by SIGXCPU
  std::optional<std::uint64_t> memory_limit_bytes = {};  ///< of address space
};

/// How a process ended.
struct ProcessEnd {
  int exit_code = 0;  ///< valid if signal is 0
  int signal = 0;     ///< the one that ended it, or 0
};

/// Starts a program with empty standard input and no signal blocked. The kernel kills it when the parent dies, however
/// that comes. What cannot be executed ends with exit code 127, or 126 if it is there; its standard error says so.
/// @pre the caller has one thread  @return its process id  @throws std::runtime_error if no process can be made
pid_t start_child(const ChildProcess& child);

/// Opens a file for appending, close-on-exec. @return its descriptor  @throws std::runtime_error that names the file
int open_log(const std::string& path);

/// Waits until a child has ended. @pre nobody else has waited for it
ProcessEnd await_child(pid_t pid);

/// @return how a child ended, or nullopt if it still runs.
std::optional<ProcessEnd> poll_child(pid_t pid);

}  // namespace tern
