#include "tools/export/bag_folder.h"

#include <fmt/format.h>

#include <fstream>

namespace tern::exporting {

std::string bag_file_name(const std::filesystem::path& folder) {
  const std::filesystem::path whole = std::filesystem::absolute(folder).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string() + "_0.mcap";
}

std::string bag_metadata(const std::string& file_name, const McapWriter& mcap) {
  const McapWriter::Span& span = mcap.span();
  std::string topics;
  for (const auto& [name, topic] : mcap.topics()) {
    topics += fmt::format(
        "    - topic_metadata:\n        name: {}\n        type: {}\n        serialization_format: cdr\n"
        "        offered_qos_profiles: \"\"\n      message_count: {}\n",
        name, topic.type, topic.messages);
  }
  const std::uint64_t duration_ns = span.last_ns - span.first_ns;
  return fmt::format(
      "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: mcap\n"
      "  duration:\n    nanoseconds: {1}\n  starting_time:\n    nanoseconds_since_epoch: {2}\n  message_count: {3}\n"
      "  topics_with_message_count:\n{4}"
      "  compression_format: \"\"\n  compression_mode: \"\"\n  relative_file_paths:\n    - \"{0}\"\n"
      "  files:\n    - path: \"{0}\"\n      starting_time:\n        nanoseconds_since_epoch: {2}\n"
      "      duration:\n        nanoseconds: {1}\n      message_count: {3}\n",
      file_name, duration_ns, span.first_ns, span.messages, topics);
}

Result<void> write_bag_metadata(const std::filesystem::path& path, const std::filesystem::path& folder,
                                const McapWriter& mcap) {
  std::ofstream file(path);
  file << bag_metadata(bag_file_name(folder), mcap);
  file.close();
  if (!file) return fail(path.string() + ": cannot be written");
  return {};
}

}  // namespace tern::exporting
