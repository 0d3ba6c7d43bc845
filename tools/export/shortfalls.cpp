#include "tools/export/shortfalls.h"

#include <fmt/format.h>

namespace tern::exporting {

std::string shortfalls(const LogContents& contents) {
  std::string text;
  for (const auto& [name, channel] : contents.channels) {
    if (channel.foreign && name != kLcmSelfTest) text += fmt::format("{}: left out: not a channel of Tern\n", name);
    if (const std::int64_t refused = channel.refused_total(); refused > 0) {
      text += fmt::format("{}: {} of {} messages left out, damaged or of another version\n", name, refused,
                          channel.messages);
    }
    if (channel.lost > 0) text += fmt::format("{}: {} messages are not in the log\n", name, channel.lost);
  }
  if (contents.damage.places > 0) {
    text += fmt::format("the log is damaged in {} places, {} bytes\n", contents.damage.places, contents.damage.bytes);
  }
  if (contents.damage.missing > 0) {
    text += fmt::format("{} messages are missing, as the event numbers show\n", contents.damage.missing);
  }
  for (const std::string& part : contents.missing_parts) text += fmt::format("the log's part {} is missing\n", part);
  if (contents.damage.truncated) text += "the log ends within a message\n";
  return text;
}

}  // namespace tern::exporting
