// Writes an LCM log in parts of bounded size.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/base/files.h"
#include "core/base/result.h"

namespace tern {

/// Returns the path of a part of a log: flight.lcm for part 0, flight.001.lcm for part 1, and so on.
std::string log_part_path(const std::string& path, int part);

/// Counters of a LogWriter.
struct LogWriterCounters {
  std::int64_t written = 0;    ///< events written to files
  std::int64_t bytes = 0;      ///< bytes of these events
  std::int64_t unwritten = 0;  ///< events that could not be written
  int parts = 0;               ///< files opened
};

/// Appends events to a log. Numbers continue through the parts, so the concatenated parts are one log.
///
/// * An existing file is never overwritten. If a log exists already (its logger died and was restarted), writing
///   continues in the next free part.
/// * Events stay in memory until flush(), or until kBufferBytes are reached.
/// * If the disk does not accept events (it is full or gone), they are counted and dropped. The file is cut back to
///   its last complete event, and the next flush() tries again.
class LogWriter {
 public:
  /// Opens the first free part of a log.
  /// @param rotate_bytes  size at which a part is closed and the next one opened; 0: never
  /// @return an Error that names path and reason if the file cannot be created
  static Result<LogWriter> open(const std::string& path, std::int64_t rotate_bytes);
  ~LogWriter();  ///< flushes
  LogWriter(LogWriter&& other) noexcept = default;
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;
  LogWriter& operator=(LogWriter&&) = delete;

  /// Appends one event. @pre channel has 1 … kLogMaxChannelBytes bytes, data at most kLogMaxDataBytes
  void append(std::string_view channel, std::int64_t received_us, std::span<const std::uint8_t> data);
  /// Writes the buffered events. @return an Error that says why the disk did not accept them
  Result<void> flush();

  [[nodiscard]] const LogWriterCounters& counters() const { return counters_; }
  [[nodiscard]] const std::string& part_path() const { return part_path_; }  ///< file being written
  /// Returns file and reason of the last events that could not be written; empty if all were.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }

 private:
  LogWriter(std::string path, std::int64_t rotate_bytes) : path_(std::move(path)), rotate_bytes_(rotate_bytes) {}
  Result<void> open_next_part();

  std::string path_, part_path_, trouble_;
  std::int64_t rotate_bytes_;
  Descriptor fd_;
  int next_part_ = 0;
  std::int64_t part_bytes_ = 0;  ///< bytes of complete events in the file
  std::int64_t next_number_ = 0;
  std::string buffer_;
  std::int64_t buffered_ = 0;  ///< events in the buffer
  LogWriterCounters counters_;
};

}  // namespace tern
