// Reads an LCM log that may be damaged, with bounded memory, and says what it could not read.
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

/// What a reader had to leave out.
struct LogDamage {
  std::int64_t places = 0;   ///< runs of bytes that are no events
  std::int64_t bytes = 0;    ///< of those
  std::int64_t missing = 0;  ///< events that the gaps in the numbers say were there; 0 where numbers start anew
  bool truncated = false;    ///< the file's end is no event's end
};

/// Reads one file in its order. An event counts as whole when the next one, or the end of the file, follows it. Else
/// its length is doubted if another event begins within it. After damage the reader goes on at the next event that
/// looks whole. The format has no checksum: damage within the data of a message is for the message's own decoder to
/// find.
class LogReader {
 public:
  /// @return an Error that names path and reason when the file cannot be opened.
  static Result<LogReader> open(const std::string& path);

  /// The next whole event, or nothing at the end. Never throws but std::bad_alloc.
  std::optional<LogEvent> next();
  /// Grows while reading; final when next() has returned nothing.
  [[nodiscard]] const LogDamage& damage() const { return damage_; }

 private:
  struct Head {
    std::int64_t number = 0, received_us = 0;
    std::size_t channel_bytes = 0, data_bytes = 0;
    [[nodiscard]] std::size_t size() const { return kLogHeadBytes + channel_bytes + data_bytes; }
  };
  using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
  explicit LogReader(File file) : file_(std::move(file)) {}
  std::size_t available(std::size_t wanted);
  [[nodiscard]] std::optional<Head> head_at(std::size_t offset);
  [[nodiscard]] bool starts_within(const Head& head);
  [[nodiscard]] bool is_whole(const Head& head);
  [[nodiscard]] std::size_t find_next();
  void skip(std::size_t bytes);
  LogEvent take(const Head& head);

  File file_;
  std::vector<std::uint8_t> window_;  ///< read ahead; [cursor_, end) is still to be judged
  std::size_t cursor_ = 0;
  bool in_damage_ = false;
  std::optional<std::int64_t> last_number_;
  LogDamage damage_;
};

}  // namespace tern
