// How every tool ends that works on a flight after it.
#pragma once

#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace tern {

/// Parses, then runs. @return what run returns, or 0 after --help and --version. A bad command line, and whatever run
/// throws, is said on stderr ("NAME: why") and is kExitBadConfiguration.
int run_tool(CLI::App& app, const std::string& name, int argc, char** argv, const std::function<int()>& run);

}  // namespace tern
