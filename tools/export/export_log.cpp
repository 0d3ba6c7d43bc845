#include "tools/export/export_log.h"

#include <fmt/format.h>

#include <filesystem>
#include <numeric>
#include <system_error>

#include "tools/export/csv_files.h"

namespace tern::exporting {
namespace {

std::int64_t refused(const LogChannel& channel) {
  return std::accumulate(std::begin(channel.refused), std::end(channel.refused), std::int64_t{0});
}

/// What the log did not give.
std::string shortfalls(const LogContents& contents) {
  std::string text;
  for (const auto& [name, channel] : contents.channels) {
    if (channel.foreign) text += fmt::format("{}: left out, not a channel of Tern's\n", name);
    if (refused(channel) > 0) {
      text += fmt::format("{}: {} of {} messages left out, damaged or of another version\n", name, refused(channel),
                          channel.messages);
    }
    if (channel.lost > 0) text += fmt::format("{}: {} messages are not in the log\n", name, channel.lost);
  }
  if (contents.damage.places > 0) {
    text += fmt::format("the log is damaged in {} places, {} bytes\n", contents.damage.places, contents.damage.bytes);
  }
  if (contents.damage.truncated) text += "the log breaks off within a message\n";
  return text;
}

}  // namespace

Result<std::string> export_log(const ExportOptions& options) {
  if (options.csv_folder.empty()) return fail("nothing to write: --csv DIR");
  std::error_code error;
  std::filesystem::create_directories(options.csv_folder, error);
  if (error) return fail(options.csv_folder + ": " + error.message());

  CsvFiles csv(options.csv_folder);
  std::int64_t messages = 0;
  FlightLog log(options.suffix);
  on_every_channel(log, options.suffix, [&](const LoggedMessage& message) {
    ++messages;
    csv.add(message);
  });
  const auto contents = log.read(options.log);
  if (!contents) return tl::make_unexpected(contents.error());
  if (messages == 0) return fail(options.log + ": not one message of Tern's in it");
  if (const auto written = csv.finish(); !written) return tl::make_unexpected(written.error());
  return fmt::format("{} messages: {}\n{}", messages, options.csv_folder, shortfalls(*contents));
}

}  // namespace tern::exporting
