// Writes an LCM log, in parts of bounded size.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/base/files.h"
#include "core/base/result.h"

namespace tern {

/// The path of a log's part: `path` itself for part 0, else with the number before the extension: flight.lcm,
/// flight.001.lcm …
std::string log_part_path(const std::string& path, int part);

struct LogWriterCounters {
  std::int64_t written = 0;    ///< events in the file
  std::int64_t bytes = 0;      ///< of those
  std::int64_t unwritten = 0;  ///< events that the disk did not take
  int parts = 0;               ///< files opened
};

/// Appends events to a log. Events are numbered on through the parts, so that the parts one after the other are one log
/// again.
///
/// Nothing that exists is ever overwritten: beside an older log (a logger that died and came back) a writer begins the
/// next free part. What the disk does not take (full, gone) is counted and dropped. The file is then cut back to its
/// last whole event; the next flush tries again. Events stay in memory until flush(), or until kBufferBytes wait.
class LogWriter {
 public:
  /// @param rotate_bytes  a part that has reached it is closed and the next one begun; 0: never
  /// @return an Error that names path and reason when the file cannot be made.
  static Result<LogWriter> open(const std::string& path, std::int64_t rotate_bytes);
  ~LogWriter();  ///< flushes
  LogWriter(LogWriter&& other) noexcept = default;
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;
  LogWriter& operator=(LogWriter&&) = delete;

  /// @pre channel has 1 … kLogMaxChannelBytes bytes, data at most kLogMaxDataBytes
  void append(std::string_view channel, std::int64_t received_us, std::span<const std::uint8_t> data);
  /// Hands what waits to the kernel. @return why the disk did not take it.
  Result<void> flush();

  [[nodiscard]] const LogWriterCounters& counters() const { return counters_; }
  [[nodiscard]] const std::string& part_path() const { return part_path_; }  ///< of the file being written

 private:
  LogWriter(std::string path, std::int64_t rotate_bytes) : path_(std::move(path)), rotate_bytes_(rotate_bytes) {}
  Result<void> open_next_part();

  std::string path_, part_path_;
  std::int64_t rotate_bytes_;
  Descriptor fd_;
  int next_part_ = 0;
  std::int64_t part_bytes_ = 0;  ///< whole events in the file
  std::int64_t next_number_ = 0;
  std::string buffer_;
  std::int64_t buffered_ = 0;  ///< events in the buffer
  LogWriterCounters counters_;
};

}  // namespace tern
