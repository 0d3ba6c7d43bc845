// The subcommands of tern-campaign. Each adds itself to the command line; main() runs the selected one.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "core/base/result.h"
#include "runtime/command_line.h"

namespace tern {

/// Exit code if a file cannot be read or written.
inline constexpr int kExitFile = 3;

/// A file cannot be read or written (exit code 3).
class FileError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Returns the result's value. @throws FileError with the error's text if there is none
template <class T>
T value_of_file(Result<T> result) {
  if (!result) throw FileError(result.error().message);
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

/// Runs a subcommand. @return the exit code. @throws ConfigError for an error that the user must correct (exit code 2),
/// FileError, and std::filesystem::filesystem_error (exit code 3)
using Command = std::function<int()>;

/// Each function sets `chosen` if its subcommand is on the command line. add_campaign adds the program itself, which
/// has no subcommand.
void add_campaign(CommandLine& app, Command& chosen);
void add_check(CommandLine& app, Command& chosen);
void add_fly_one(CommandLine& app, Command& chosen);
void add_judge_contacts(CommandLine& app, Command& chosen);
void add_merge(CommandLine& app, Command& chosen);
void add_schema(CommandLine& app, Command& chosen);
void add_summarize(CommandLine& app, Command& chosen);
void add_ways(CommandLine& app, Command& chosen);
/// Adds compare, page and columns.
void add_compare(CommandLine& app, Command& chosen);
/// Adds paper-6.1 and paper-6.2.
void add_paper(CommandLine& app, Command& chosen);

}  // namespace tern
