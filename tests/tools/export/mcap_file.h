// Takes an MCAP file apart, byte by byte, by the letter of https://mcap.dev/spec.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tern::testing {

struct McapMessage {
  std::string topic, schema;
  std::uint32_t sequence = 0;
  std::uint64_t log_ns = 0;
  nlohmann::json fields;
};

struct McapFile {
  std::map<std::string, nlohmann::json> schemas;  ///< by name
  std::vector<McapMessage> messages;              ///< in the file's order
  std::map<std::string, std::uint64_t> counted;   ///< what its Statistics say, by topic
  int chunks = 0;
  std::uint64_t first_ns = 0, last_ns = 0;  ///< what its Statistics say
};

/// Reads all of a file.
/// @throws std::runtime_error that says what is contradicted: the magic, a length, a checksum, an offset of the index,
/// the summary against the data.
McapFile parse_mcap(std::string bytes);
McapFile read_mcap(const std::string& path);

}  // namespace tern::testing
