// tern-viewer --export and --video: a log becomes a file, and the process has done its work.
#pragma once

#include <memory>

#include "runtime/bus.h"
#include "runtime/node.h"
#include "viewer/bridge/app/viewer_node.h"

namespace CLI {
class App;
}

namespace tern {

/// --export, --video and what goes with them. A film's options without --video are refused.
void add_export_options(CLI::App& app, ViewerOptions& options);

/// A log is played on a bus that ends in this process: no network is needed, and none is disturbed. Where one is
/// played, what only a live flight has is refused; where a file is written, what only a page in the browser has: it
/// would have no effect. @pre app has all options of tern-viewer; `options` outlives it
void keep_logs_apart(CLI::App& app, const ViewerOptions& options);

/// Writes the files that the options ask for, or shows the flight if they ask for none.
/// @throws ConfigError when that cannot be done
std::unique_ptr<Node> make_viewer(Bus& bus, const Scenario& scenario, const ViewerOptions& options);

}  // namespace tern
