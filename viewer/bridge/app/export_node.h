// tern-viewer --export and --video: write a file from a log, then end the process.
#pragma once

#include <memory>

#include "runtime/bus.h"
#include "runtime/command_line.h"
#include "runtime/node.h"
#include "viewer/bridge/app/viewer_node.h"

namespace tern {

/// Adds --export, --video and their options. The options of a film are refused without --video.
void add_export_options(CommandLine& app, ViewerOptions& options);

/// Puts a log on a bus of its own inside this process, so a played log neither needs nor disturbs the network.
///
/// Refuses options that would have no effect. With a log, these are the options of a live flight. With --export or
/// --video, they are the options of a page in the browser.
/// @pre app has all options of tern-viewer; `options` outlives it
void keep_logs_apart(CommandLine& app, const ViewerOptions& options);

/// Writes the files that the options name, or makes the viewer if they name none.
/// @throws ConfigError if reading a log or writing a file fails
std::unique_ptr<Node> make_viewer(Bus& bus, const Scenario& scenario, const ViewerOptions& options);

}  // namespace tern
