// MCAP files (https://mcap.dev/spec): JSON messages with their JSON schemas.
#pragma once

#include <boost/crc.hpp>
#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "tools/export/message_json.h"

namespace tern::exporting {

/// Writes Header, Chunks with an index after each, DataEnd, and a summary: schemas, channels, Statistics, where each
/// chunk is, where each kind of record is. Schema and Channel stand in the chunk of their first message and in the
/// summary. Chunks, data and summary have their checksums; the records of a chunk are
/// compressed by Zstandard.
class McapWriter {
 public:
  /// A chunk is ended when its records are more than this, bytes.
  static constexpr std::size_t kChunkBytes = 4 << 20;

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
  struct Span {
    std::uint64_t first_ns = 0, last_ns = 0;
    std::uint64_t messages = 0;
    void take(std::uint64_t ns);
  };
  /// Where the messages of a channel are: time, offset in the chunk's records.
  using MessageIndex = std::vector<std::pair<std::uint64_t, std::uint64_t>>;
  struct Chunk {
    std::string records;
    Span span;
    std::map<std::uint16_t, MessageIndex> index;
  };

  void write(std::string_view bytes);
  void end_chunk();
  std::string statistics() const;

  std::string path_;
  std::ofstream file_;
  std::uint64_t size_ = 0;
  boost::crc_32_type crc_;  ///< of the data section, then of the summary
  Span span_;
  Chunk chunk_;
  std::uint32_t chunks_ = 0;
  std::map<std::string, std::uint16_t> schemas_;
  std::map<std::string, Topic> topics_;
  std::string schema_records_, channel_records_, chunk_index_records_;  ///< of the summary
};

}  // namespace tern::exporting
