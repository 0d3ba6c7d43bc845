// Writes MCAP files (https://mcap.dev/spec) of ROS 2 messages: profile "ros2", schemas "ros2msg", messages "cdr".
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
#include "ros_messages/description.h"

namespace tern::exporting {

/// Writes these records, in this order:
///
/// 1. Header
/// 2. Chunks, compressed by Zstandard, each followed by its index
/// 3. DataEnd
/// 4. the summary: schemas, channels, Statistics, the index of chunks, the index of record kinds
///
/// A Schema and a Channel are written to the chunk of their first message and to the summary. Chunks, data and summary
/// have checksums.
class McapWriter {
 public:
  struct Topic {
    std::uint16_t id = 0;  ///< of its Channel, from 1: the reader rosbags 0.10 leaves out messages of channel 0
    std::string type;
    std::uint32_t messages = 0;
  };
  struct Span {
    std::uint64_t first_ns = 0, last_ns = 0;
    std::uint64_t messages = 0;
    void take(std::uint64_t ns);
  };

  /// A chunk is closed when its records exceed this size, bytes.
  static constexpr std::size_t kChunkBytes = 8 << 20;

  explicit McapWriter(const std::string& path);

  /// Adds a message. The first message of a topic fixes its type.
  /// @param time_us  since the Unix epoch, ≥ 0
  void add(const std::string& topic, const ros::RosType& type, std::int64_t time_us, std::string_view cdr);
  /// Completes the file. @return an Error if it could not be written
  Result<void> finish();
  [[nodiscard]] const std::map<std::string, Topic>& topics() const { return topics_; }
  /// Returns the time of all messages.
  [[nodiscard]] const Span& span() const { return span_; }

 private:
  /// Index of one channel in a chunk: time, offset in the chunk's records.
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
