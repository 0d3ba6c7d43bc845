// MCAP files (https://mcap.dev/spec): JSON messages with their JSON schemas.
#pragma once

#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "tools/export/message_json.h"

namespace tern::exporting {

/// Writes Header, then Schema, Channel and Message as they come, DataEnd, and a summary of the schemas, channels and
/// Statistics. Without chunks, hence without an index or compression; without checksums (0: not computed).
class McapWriter {
 public:
  explicit McapWriter(const std::string& path);

  /// The first message of a topic settles its schema. Numbers that are not finite become null.
  /// @param schema_name  the same name means the same schema
  /// @param time_us      since the Unix epoch, ≥ 0
  void add(const std::string& topic, const std::string& schema_name, Json (*schema)(const std::string& name),
           std::int64_t time_us, const Json& message);
  /// Ends the file. @return an Error when it could not be written.
  Result<void> finish();

 private:
  struct Topic {
    std::uint16_t id = 0;
    std::uint32_t messages = 0;
  };
  void write(std::string_view bytes);
  std::string statistics() const;

  std::string path_;
  std::ofstream file_;
  std::uint64_t size_ = 0, messages_ = 0, first_ns_ = 0, last_ns_ = 0;
  std::map<std::string, std::uint16_t> schemas_;
  std::map<std::string, Topic> topics_;
  std::string summary_;  ///< the records of schemas and channels
};

}  // namespace tern::exporting
