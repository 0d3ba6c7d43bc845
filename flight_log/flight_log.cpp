#include "flight_log/flight_log.h"

#include <algorithm>
#include <deque>
#include <filesystem>
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

}  // namespace

std::vector<std::string> log_parts(const std::string& path) {
  std::error_code ignored;
  const std::string first = fs::is_directory(path, ignored) ? (fs::path(path) / "flight.lcm").string() : path;
  std::vector<std::string> parts{first};
  for (int part = 1; fs::exists(log_part_path(first, part), ignored); ++part) {
    parts.push_back(log_part_path(first, part));
  }
  return parts;
}

/// One reading of all parts.
struct FlightLog::Reading {
  const std::map<std::string, std::vector<Handler>>& handlers;
  std::string suffix;
  LogContents contents;
  std::map<std::string, MessageLosses> losses;
  std::map<std::string, Recent> recent;

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
  for (const std::string& part : reading.contents.parts) {
    if (is_text_log(part)) {
      const auto whole = read_text_log(part, [&reading](const LogEvent& event) { reading.take(event); });
      if (!whole) return tl::make_unexpected(whole.error());
      continue;
    }
    auto reader = LogReader::open(part);
    if (!reader) return tl::make_unexpected(reader.error());
    while (const auto event = reader->next()) reading.take(*event);
    reading.take(reader->damage());
  }
  reading.join_spans();
  return std::move(reading.contents);
}

}  // namespace tern
