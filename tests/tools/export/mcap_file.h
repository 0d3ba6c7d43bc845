// Parses an MCAP file byte by byte, strictly by https://mcap.dev/spec.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tern::testing {

struct McapMessage {
  std::string topic, schema;
  std::uint32_t sequence = 0;
  std::uint64_t log_ns = 0;
  std::vector<std::uint8_t> cdr;
};

struct McapFile {
  std::map<std::string, std::string> schemas;    ///< definitions ("ros2msg"), by name
  std::vector<McapMessage> messages;             ///< in the file's order
  std::map<std::string, std::uint64_t> counted;  ///< from its Statistics, by topic
  int chunks = 0;
  std::uint64_t first_ns = 0, last_ns = 0;  ///< from its Statistics
};

/// Reads a whole file.
/// @throws std::runtime_error that names a contradiction: the magic, a length, a checksum, an offset of the index, or
/// the summary against the data
McapFile parse_mcap(std::string bytes);
McapFile read_mcap(const std::string& path);

}  // namespace tern::testing
