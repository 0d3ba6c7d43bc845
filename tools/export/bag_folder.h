// The folder of a rosbag2 recording: an MCAP file, and metadata.yaml, which `ros2 bag` reads first.
#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.h"
#include "tools/export/mcap_writer.h"

namespace tern::exporting {

/// Returns the name of the MCAP file in a folder, as rosbag2 numbers it: "flight_0.mcap" in "…/flight".
std::string bag_file_name(const std::filesystem::path& folder);

/// Returns the text of metadata.yaml (version 5: ROS 2 Humble and later).
/// @param mcap  complete: finish() was called
std::string bag_metadata(const std::string& file_name, const McapWriter& mcap);

/// Writes metadata.yaml of a folder to `path`. @return an Error if it could not be written
Result<void> write_bag_metadata(const std::filesystem::path& path, const std::filesystem::path& folder,
                                const McapWriter& mcap);

}  // namespace tern::exporting
