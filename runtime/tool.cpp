#include "runtime/tool.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>

#include "runtime/command_line.h"
#include "runtime/process.h"

namespace tern {

namespace {

/// Never throws: stderr may be full as well.
int say_error(const std::string& name, const std::string& what) {
  std::fputs((name + ": " + what + "\n").c_str(), stderr);
  return kExitBadConfiguration;
}

}  // namespace

int run_tool(CommandLine& app, const std::string& name, int argc, char** argv, const std::function<int()>& run) {
  try {
    const auto parsed = app.parse(argc, argv, kExitBadConfiguration);
    const int code = parsed ? *parsed : run();
    errno = 0;
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    return say_error(name, std::string("the output cannot be written") +
                               (errno != 0 ? std::string(": ") + std::strerror(errno) : std::string()));
  } catch (const std::exception& error) {
    return say_error(name, error.what());
  }
}

}  // namespace tern
