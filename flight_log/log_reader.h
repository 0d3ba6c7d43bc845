// Reads an LCM log that may be damaged, with bounded memory, and counts the damage.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "flight_log/log_format.h"

namespace tern {

/// The damage of a log.
struct LogDamage {
  std::int64_t places = 0;  ///< damaged places: runs of bytes outside events
  std::int64_t bytes = 0;   ///< bytes at these places
  std::int64_t missing =
      0;                   ///< events missing in the sequence of event numbers; a restart of the numbers does not count
  bool truncated = false;  ///< the file ends within an event, or its rest cannot be read
};

/// Reads the events of one file in their order.
///
/// An event counts as complete if all its bytes are in the file, and one of these holds:
/// - the next event, or the end of the file, follows it directly;
/// - no other event seems to begin within it.
///
/// The remaining events have a wrong length and count as damage. After damage, reading continues at the next complete
/// event. The format has no checksum; damage within the data of a message is left to the message's decoder.
class LogReader {
 public:
  /// Opens a file.
  /// @param last_number  of the last event of the part before: events that are missing between the parts are counted
  /// @return an Error that names path and reason if it cannot be opened
  static Result<LogReader> open(const std::string& path, std::optional<std::int64_t> last_number = std::nullopt);

  /// Returns the next complete event, or nullopt at the end. It throws std::bad_alloc only.
  std::optional<LogEvent> next();
  /// Returns the damage so far; it is final once next() has returned nullopt.
  [[nodiscard]] const LogDamage& damage() const { return damage_; }
  /// Returns the number of the last event so far; nullopt before the first one of a log.
  [[nodiscard]] std::optional<std::int64_t> last_number() const { return last_number_; }

 private:
  struct Head {
    std::int64_t number = 0, received_us = 0;
    std::size_t channel_bytes = 0, data_bytes = 0;
    [[nodiscard]] std::size_t size() const { return kLogHeadBytes + channel_bytes + data_bytes; }
  };
  using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
  LogReader(File file, std::optional<std::int64_t> last_number) : file_(std::move(file)), last_number_(last_number) {}
  std::size_t available(std::size_t wanted);
  [[nodiscard]] std::optional<Head> head_at(std::size_t offset);
  [[nodiscard]] bool starts_within(const Head& head);
  [[nodiscard]] bool is_whole(const Head& head);
  [[nodiscard]] std::size_t find_next();
  void skip(std::size_t bytes);
  LogEvent take(const Head& head);

  File file_;
  std::vector<std::uint8_t> window_;  ///< bytes read ahead; [cursor_, end) is not yet judged
  std::size_t cursor_ = 0;
  bool in_damage_ = false;
  std::optional<std::int64_t> last_number_;
  LogDamage damage_;
};

}  // namespace tern
