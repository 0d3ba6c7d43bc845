#include "flight_log/log_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "core/wire/message_limits.h"

namespace tern {
namespace {

constexpr std::size_t kReadBytes = 1U << 18U;
/// The largest gap that is counted, so that a damaged number cannot overflow the sum.
constexpr std::int64_t kMaxMissing = 1'000'000'000;

std::uint64_t read_big_endian(const std::uint8_t* bytes, int count) {
  std::uint64_t x = 0;
  for (int i = 0; i < count; ++i) x = x << 8U | bytes[i];
  return x;
}

bool is_printable(std::uint8_t c) { return c > 0x20 && c < 0x7F; }

}  // namespace

Result<LogReader> LogReader::open(const std::string& path, std::optional<std::int64_t> last_number) {
  File file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) return fail(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
  return LogReader(std::move(file), last_number);
}

/// Reads ahead until `wanted` bytes follow the cursor or the file ends. @return the number of bytes available
std::size_t LogReader::available(std::size_t wanted) {
  if (window_.size() - cursor_ >= wanted) return window_.size() - cursor_;
  if (cursor_ > kReadBytes) {
    window_.erase(window_.begin(), window_.begin() + static_cast<std::ptrdiff_t>(cursor_));
    cursor_ = 0;
  }
  while (window_.size() - cursor_ < wanted) {
    const std::size_t old = window_.size();
    window_.resize(old + kReadBytes);
    const std::size_t n = std::fread(window_.data() + old, 1, kReadBytes, file_.get());
    window_.resize(old + n);
    if (n == 0) break;
  }
  return window_.size() - cursor_;
}

/// Returns the head of an event `offset` bytes after the cursor; nullopt if the bytes there cannot be one.
std::optional<LogReader::Head> LogReader::head_at(std::size_t offset) {
  if (available(offset + kLogHeadBytes) < offset + kLogHeadBytes) return std::nullopt;
  const std::uint8_t* at = window_.data() + cursor_ + offset;
  if (read_big_endian(at, 4) != kLogSyncWord) return std::nullopt;
  Head head;
  head.number = static_cast<std::int64_t>(read_big_endian(at + 4, 8));
  head.received_us = static_cast<std::int64_t>(read_big_endian(at + 12, 8));
  head.channel_bytes = static_cast<std::size_t>(read_big_endian(at + 20, 4));
  head.data_bytes = static_cast<std::size_t>(read_big_endian(at + 24, 4));
  // No clock has such a time, and differences of such times overflow: the bytes are damaged.
  if (head.received_us < -kMaxTimeUs || head.received_us > kMaxTimeUs) return std::nullopt;
  if (head.number < 0 || head.channel_bytes < 1 || head.channel_bytes > kLogMaxChannelBytes ||
      head.data_bytes > kLogMaxDataBytes) {
    return std::nullopt;
  }
  const std::size_t named = offset + kLogHeadBytes + head.channel_bytes;
  if (available(named) < named) return std::nullopt;
  const std::uint8_t* name = window_.data() + cursor_ + offset + kLogHeadBytes;
  if (!std::all_of(name, name + head.channel_bytes, is_printable)) return std::nullopt;
  return head;
}

/// True if another event seems to begin within the event at the cursor.
bool LogReader::starts_within(const Head& head) {
  const std::size_t end = std::min(head.size(), available(head.size()));
  for (std::size_t offset = kLogHeadBytes; offset + 4 <= end; ++offset) {
    if (window_[cursor_ + offset] == kLogSyncWord >> 24U && head_at(offset)) return true;
  }
  return false;
}

bool LogReader::is_whole(const Head& head) {
  const std::size_t size = head.size();
  const std::size_t there = available(size + 4);
  if (there < size) return false;
  const bool followed = there == size || (there >= size + 4 && head_at(size));
  return followed || !starts_within(head);
}

/// Returns the distance in bytes from the cursor to the next complete event or to the end of the file.
std::size_t LogReader::find_next() {
  std::size_t offset = 1;
  while (available(offset + kLogHeadBytes) >= offset + kLogHeadBytes) {
    if (head_at(offset)) return offset;
    const auto from = window_.begin() + static_cast<std::ptrdiff_t>(cursor_ + offset + 1);
    const auto found = std::find(from, window_.end(), static_cast<std::uint8_t>(kLogSyncWord >> 24U));
    offset = static_cast<std::size_t>(found - window_.begin()) - cursor_;
    if (offset > kReadBytes) return offset;  // one step is enough: the caller continues from there
  }
  return available(0);
}

void LogReader::skip(std::size_t bytes) {
  if (!std::exchange(in_damage_, true)) ++damage_.places;
  damage_.bytes += static_cast<std::int64_t>(bytes);
  cursor_ += bytes;
}

LogEvent LogReader::take(const Head& head) {
  const auto name = window_.begin() + static_cast<std::ptrdiff_t>(cursor_ + kLogHeadBytes);
  const auto data = name + static_cast<std::ptrdiff_t>(head.channel_bytes);
  LogEvent event{head.number,
                 head.received_us,
                 std::string(name, data),
                 {data, data + static_cast<std::ptrdiff_t>(head.data_bytes)}};
  cursor_ += head.size();
  in_damage_ = false;
  if (last_number_ && head.number > *last_number_) {
    damage_.missing += std::min(head.number - *last_number_ - 1, kMaxMissing);
  }
  last_number_ = head.number;
  return event;
}

std::optional<LogEvent> LogReader::next() {
  while (available(1) > 0) {
    const auto head = head_at(0);
    if (head && is_whole(*head)) return take(*head);
    skip(find_next());
  }
  if (std::ferror(file_.get()) != 0) skip(0);  // what the disk does not give is damage, not the end
  damage_.truncated = in_damage_;
  return std::nullopt;
}

}  // namespace tern
