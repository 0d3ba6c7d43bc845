#include "flight_log/text_log.h"

#include <fmt/format.h>

#include <charconv>
#include <fstream>

#include "core/wire/message_limits.h"

namespace tern {
namespace {

constexpr char kDigits[] = "0123456789abcdef";

int digit(char c) {
  const std::string_view digits(kDigits);
  const std::size_t value = digits.find(c);
  return value == std::string_view::npos ? -1 : static_cast<int>(value);
}

}  // namespace

std::string text_line(const LogEvent& event) {
  std::string line = fmt::format("{} {} ", event.channel, event.received_us);
  for (const std::uint8_t byte : event.data) {
    line += kDigits[byte >> 4U];
    line += kDigits[byte & 15U];
  }
  return line;
}

std::optional<LogEvent> event_of_line(std::string_view line) {
  const std::size_t first = line.find(' ');
  const std::size_t second = line.find(' ', first == std::string_view::npos ? first : first + 1);
  if (first == 0 || first > kLogMaxChannelBytes || second == std::string_view::npos) return std::nullopt;
  LogEvent event;
  event.channel = line.substr(0, first);
  const char* const end = line.data() + second;
  if (std::from_chars(line.data() + first + 1, end, event.received_us).ptr != end) return std::nullopt;
  if (event.received_us < -kMaxTimeUs || event.received_us > kMaxTimeUs) return std::nullopt;
  const std::string_view hex = line.substr(second + 1);
  if (hex.size() % 2 != 0 || hex.size() / 2 > kLogMaxDataBytes) return std::nullopt;
  event.data.reserve(hex.size() / 2);
  for (std::size_t k = 0; k < hex.size(); k += 2) {
    const int high = digit(hex[k]);
    const int low = digit(hex[k + 1]);
    if (high < 0 || low < 0) return std::nullopt;
    event.data.push_back(static_cast<std::uint8_t>(high * 16 + low));
  }
  return event;
}

bool is_text_log(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(kTextLogHead.size(), '\0');
  return file.read(head.data(), static_cast<std::streamsize>(head.size())) && head == kTextLogHead;
}

Result<void> read_text_log(const std::string& path, const std::function<void(const LogEvent&)>& use) {
  std::ifstream file(path);
  if (!file) return fail(path + ": cannot be read");
  std::string line;
  std::int64_t number = 0;
  for (int at = 1; std::getline(file, line); ++at) {
    if (line.empty() || line[0] == '#') continue;
    auto event = event_of_line(line);
    if (!event) return fail(fmt::format("{}:{}: neither a message nor a comment", path, at));
    event->number = number++;
    use(*event);
  }
  return {};
}

}  // namespace tern
