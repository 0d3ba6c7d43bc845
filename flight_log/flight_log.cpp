#include "flight_log/flight_log.h"

#include <algorithm>
#include <charconv>
#include <deque>
#include <filesystem>
#include <set>
#include <unordered_set>

#include "core/base/digest.h"
#include "flight_log/log_writer.h"
#include "flight_log/text_log.h"

namespace tern {
namespace {

namespace fs = std::filesystem;

/// Further channels are counted as one, so that damage which looks like names cannot fill the memory.
constexpr std::size_t kMaxChannels = 1'000;
/// Further spans between silences are not kept: damaged times must not fill the memory.
constexpr std::size_t kMaxSpans = 10'000;
constexpr char kOtherChannels[] = "(others)";
/// The number of a channel's messages among which repetitions are found; repetitions follow within milliseconds.
constexpr std::size_t kRemembered = 4096;

/// The newest messages of a channel, by digest.
class Recent {
 public:
  /// Remembers these bytes; returns true if it knew them already.
  bool again(std::span<const std::uint8_t> bytes) {
    const std::uint64_t name = digest({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    if (!known_.insert(name).second) return true;
    order_.push_back(name);
    if (order_.size() > kRemembered) {
      known_.erase(order_.front());
      order_.pop_front();
    }
    return false;
  }

 private:
  std::unordered_set<std::uint64_t> known_;
  std::deque<std::uint64_t> order_;
};

std::string first_part(const std::string& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored) ? (fs::path(path) / "flight.lcm").string() : path;
}

/// Returns the numbers of the parts beside the first one.
std::set<int> further_parts(const std::string& first) {
  std::set<int> parts;
  std::error_code ignored;
  // The next ones are found also in a folder that cannot be listed.
  for (int part = 1; fs::exists(log_part_path(first, part), ignored); ++part) parts.insert(part);
  const fs::path path(first);
  const std::string begin = path.stem().string() + ".";
  for (fs::directory_iterator it(path.has_parent_path() ? path.parent_path() : ".", ignored), end; it != end;
       it.increment(ignored)) {
    const std::string name = it->path().filename().string();
    int part = 0;
    if (!name.starts_with(begin)) continue;
    const auto number = std::from_chars(name.data() + begin.size(), name.data() + name.size(), part);
    const bool is_part = number.ec == std::errc() && part > 0;
    if (is_part && name == fs::path(log_part_path(first, part)).filename()) parts.insert(part);
  }
  return parts;
}

}  // namespace

std::vector<std::string> log_parts(const std::string& path) {
  const std::string first = first_part(path);
  std::vector<std::string> parts{first};
  for (const int part : further_parts(first)) parts.push_back(log_part_path(first, part));
  return parts;
}

std::vector<std::string> missing_log_parts(const std::string& path) {
  const std::string first = first_part(path);
  const auto name = [&first](int part) { return fs::path(log_part_path(first, part)).filename().string(); };
  std::vector<std::string> missing;
  int expected = 1;
  for (const int part : further_parts(first)) {
    if (part == expected + 1) missing.push_back(name(expected));
    if (part > expected + 1) missing.push_back(name(expected) + " to " + name(part - 1));
    expected = part + 1;
  }
  return missing;
}

/// One reading of all parts.
struct FlightLog::Reading {
  const std::map<std::string, std::vector<Handler>>& handlers;
  std::string suffix;
  LogContents contents;
  std::map<std::string, MessageLosses> losses;
  std::map<std::string, Recent> recent;
  std::int64_t last_us = INT64_MIN;  ///< of the event before
  std::int64_t places_of_part = 0;

  /// Keeps the last span open; the messages of several senders need not come in order.
  void extend_spans(std::int64_t at_us) {
    auto& spans = contents.spans;
    const auto is_near = [at_us](const auto& span) {
      return at_us >= span.first - kLogSilence.us && at_us <= span.second + kLogSilence.us;
    };
    if (spans.empty() || !is_near(spans.back())) {
      if (spans.size() < kMaxSpans) spans.emplace_back(at_us, at_us);
      return;
    }
    spans.back() = {std::min(spans.back().first, at_us), std::max(spans.back().second, at_us)};
  }

  void join_spans() {
    std::vector<std::pair<std::int64_t, std::int64_t>> joined;
    std::ranges::sort(contents.spans);
    for (const auto& span : contents.spans) {
      if (joined.empty() || span.first > joined.back().second + kLogSilence.us) {
        joined.push_back(span);
      } else {
        joined.back().second = std::max(joined.back().second, span.second);
      }
    }
    contents.spans = std::move(joined);
  }

  LogChannel& channel_of(const std::string& name) {
    const auto found = contents.channels.find(name);
    if (found != contents.channels.end()) return found->second;
    const bool room = contents.channels.size() < kMaxChannels || handlers.contains(name);
    LogChannel& channel = contents.channels[room ? name : kOtherChannels];
    channel.read = handlers.contains(name);
    const auto nothing = [](const auto&) {};
    channel.foreign = !name.ends_with(suffix) ||
                      !visit_channel(std::string_view(name).substr(0, name.size() - suffix.size()), nothing);
    return channel;
  }

  /// Remembers between which events damaged places lie. @param places  damaged places of this part so far
  void find_damage(std::int64_t places, std::int64_t before_us, std::int64_t after_us) {
    if (places > places_of_part && contents.damaged.size() < kMaxSpans) {
      contents.damaged.emplace_back(before_us, after_us);
    }
    places_of_part = places;
  }

  void take(const LogEvent& event) {
    if (contents.events++ == 0) contents.first_us = contents.last_us = event.received_us;
    contents.first_us = std::min(contents.first_us, event.received_us);
    contents.last_us = std::max(contents.last_us, event.received_us);
    extend_spans(event.received_us);
    LogChannel& channel = channel_of(event.channel);
    ++channel.messages;
    channel.bytes += static_cast<std::int64_t>(event.data.size());
    const auto found = handlers.find(event.channel);
    if (found == handlers.end()) return;
    if (recent[event.channel].again(event.data)) {
      ++channel.repeated;
      return;
    }
    bool is_first = true;
    for (const Handler& handler : found->second) {
      const auto header = handler(event.data, event.received_us);
      if (!std::exchange(is_first, false)) continue;
      if (!header) {
        ++channel.refused[idx(header.error())];
        return;
      }
      MessageLosses& numbers = losses[event.channel];
      numbers.add(header->name, UTime{event.received_us});
      channel.lost = numbers.lost();
      channel.before_first = numbers.before_first();
    }
  }

  /// Reads one file. @param last_number  of the last event of the part before; set to that of this part
  Result<void> read(const std::string& part, std::optional<std::int64_t>& last_number) {
    auto reader = LogReader::open(part, last_number);
    if (!reader) return tl::make_unexpected(reader.error());
    places_of_part = 0;
    while (const auto event = reader->next()) {
      find_damage(reader->damage().places, last_us, event->received_us);
      last_us = event->received_us;
      take(*event);
    }
    find_damage(reader->damage().places, last_us, INT64_MAX);
    take(reader->damage());
    last_number = reader->last_number();
    return {};
  }

  void take(const LogDamage& damage) {
    contents.damage.places += damage.places;
    contents.damage.bytes += damage.bytes;
    contents.damage.missing += damage.missing;
    contents.damage.truncated = damage.truncated;
  }
};

void FlightLog::add(std::string_view channel, Handler handler) {
  handlers_[std::string(channel) + suffix_].push_back(std::move(handler));
}

Result<LogContents> FlightLog::read(const std::string& path) {
  Reading reading{handlers_, suffix_, {}, {}, {}};
  reading.contents.parts = log_parts(path);
  reading.contents.missing_parts = missing_log_parts(path);
  std::optional<std::int64_t> last_number;
  for (const std::string& part : reading.contents.parts) {
    if (is_text_log(part)) {
      const auto whole = read_text_log(part, [&reading](const LogEvent& event) { reading.take(event); });
      if (!whole) return tl::make_unexpected(whole.error());
      continue;
    }
    if (auto whole = reading.read(part, last_number); !whole) return tl::make_unexpected(whole.error());
  }
  reading.join_spans();
  return std::move(reading.contents);
}

}  // namespace tern
