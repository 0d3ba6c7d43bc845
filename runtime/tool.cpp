#include "runtime/tool.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "runtime/command_line.h"
#include "runtime/process.h"

namespace tern {

int run_tool(CommandLine& app, const std::string& name, int argc, char** argv, const std::function<int()>& run) {
  try {
    if (const auto code = app.parse(argc, argv, kExitBadConfiguration)) return *code;
    return run();
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", name, error.what());
    return kExitBadConfiguration;
  }
}

}  // namespace tern
