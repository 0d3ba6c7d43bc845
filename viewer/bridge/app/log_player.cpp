#include "viewer/bridge/app/log_player.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "flight_log/flight_log.h"
#include "messages/codec.h"
#include "viewer/bridge/json_writer.h"

namespace tern {
namespace {

/// Limit of channels, since a damaged or foreign log may name any number. The page shows eleven.
constexpr std::size_t kMaxChannels = 256;

/// Number of a channel's newest messages that a jump reads. They contain a complete set, every process, and the request
/// of the newest answer.
std::size_t messages_needed(std::string_view channel) {
  if (channel == channels::kObstacleTruth.name || channel == channels::kPredictions.name)
    return 2 * std::size_t{kMaxBatches};
  if (channel == channels::kObstacleObservations.name) return kMaxSensors;
  if (channel == channels::kHorizonRequest.name) return Scene::kRememberedRequests;
  if (channel == channels::kHeartbeat.name || channel == channels::kConfiguration.name) return 64;
  return 1;
}

/// A jump reads the views of this time before it, for what was seen lately.
constexpr Duration kViewsBefore{1'000'000};

/// The channels of charts, path and timeline.
bool is_remembered(std::string_view channel) {
  constexpr std::tuple kRemembered{channels::kUavState,       channels::kVehicleTruth, channels::kObstacleTruth,
                                   channels::kHorizonRequest, channels::kPlan,         channels::kPlanTiming,
                                   channels::kGoal,           channels::kHeartbeat,    channels::kFlightResult,
                                   channels::kSemanticMap,    channels::kOdometry};
  return visit_channel(
      channel, [](const auto&) {}, kRemembered);
}

/// Adds the entries of one file of the log.
Result<LogDamage> index_part(const std::string& path, std::int32_t part, const std::string& suffix, LogIndex& index) {
  auto reader = LogReader::open(path);
  if (!reader) return fail(reader.error().message);
  std::int64_t bytes_of_events = 0;
  while (const auto event = reader->next()) {
    // Offsets follow from the sizes of the events and the bytes that the reader skipped.
    const auto data_bytes = static_cast<std::int64_t>(event->data.size());
    bytes_of_events += static_cast<std::int64_t>(kLogHeadBytes + event->channel.size()) + data_bytes;
    if (data_bytes > kMaxMessageBytes || !event->channel.ends_with(suffix)) continue;
    const std::string name = event->channel.substr(0, event->channel.size() - suffix.size());
    const auto known = std::ranges::find(index.channels, name);
    const auto channel = static_cast<std::int16_t>(known - index.channels.begin());
    if (known == index.channels.end()) {
      if (index.channels.size() >= kMaxChannels) continue;
      index.channels.push_back(name);
    }
    index.entries.push_back({UTime{event->received_us}, bytes_of_events + reader->damage().bytes - data_bytes,
                             static_cast<std::int32_t>(data_bytes), static_cast<std::int16_t>(part), channel});
  }
  return reader->damage();
}

Result<LogIndex> index_log(const std::vector<std::string>& parts, const std::string& suffix) {
  LogIndex index;
  LogDamage damage;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const auto of_part = index_part(parts[k], static_cast<std::int32_t>(k), suffix, index);
    if (!of_part) return fail(of_part.error().message);
    damage.places += of_part->places;
    damage.bytes += of_part->bytes;
    damage.missing += of_part->missing;
    damage.truncated = of_part->truncated;
  }
  if (index.entries.empty()) return fail(parts.front() + ": holds no message that can be shown");
  std::ranges::stable_sort(index.entries, [](const auto& a, const auto& b) { return a.received < b.received; });
  if (damage.places > 0 || damage.missing > 0 || damage.truncated) {
    index.damage = fmt::format("{} bytes in {} places could not be read, {} messages are missing{}", damage.bytes,
                               damage.places, damage.missing, damage.truncated ? ", the end is cut off" : "");
  }
  return index;
}

}  // namespace

Result<LogPlayer> LogPlayer::open(const std::string& path, const std::string& suffix) {
  const std::vector<std::string> parts = log_parts(path);
  if (parts.empty()) return fail(path + ": no such log");
  auto index = index_log(parts, suffix);
  if (!index) return fail(index.error().message);
  std::vector<std::ifstream> files;
  for (const std::string& part : parts) {
    files.emplace_back(part, std::ios::binary);
    if (!files.back()) return fail(part + ": cannot be opened");
  }
  LogPlayer player(std::move(files), std::move(*index), read_flight_note(path));
  player.build_memory();
  return player;
}

LogPlayer::LogPlayer(std::vector<std::ifstream> files, LogIndex index, FlightNote note)
    : files_(std::move(files)), index_(std::move(index)), note_(std::move(note)) {
  by_channel_.resize(index_.channels.size());
  for (std::size_t k = 0; k < index_.entries.size(); ++k) {
    by_channel_[idx(index_.entries[k].channel)].push_back(static_cast<std::uint32_t>(k));
  }
  position_ = begin();
}

void LogPlayer::build_memory() {
  Scene scene(&memory_, note_.pace);
  SceneIntake intake(scene);
  std::vector<bool> wanted;
  for (const std::string& channel : index_.channels) wanted.push_back(is_remembered(channel));
  for (std::size_t k = 0; k < index_.entries.size(); ++k) {
    if (wanted[idx(index_.entries[k].channel)]) feed(k, intake);
  }
  body_radius_ = scene.body_radius();
}

void LogPlayer::remember_tracks() {
  if (std::exchange(remembers_tracks_, true)) return;
  const auto found = std::ranges::find(index_.channels, channels::kPredictions.name);
  if (found == index_.channels.end()) return;
  Scene scene(&memory_);
  SceneIntake intake(scene);
  for (const std::uint32_t entry : by_channel_[idx(found - index_.channels.begin())]) feed(entry, intake);
}

void LogPlayer::play(bool on, UTime wall_now) {
  playing_ = on && position_ < end();
  wall_ = wall_now;
}

std::size_t LogPlayer::first_after(UTime t) const {
  const auto after = std::ranges::upper_bound(index_.entries, t, {}, &LogIndex::Entry::received);
  return idx(after - index_.entries.begin());
}

void LogPlayer::seek(UTime t, Scene& scene, SceneIntake& intake) {
  position_ = std::clamp(t, begin(), end());
  next_ = first_after(position_);
  scene.clear();
  intake.restart();
  for (std::size_t c = 0; c < index_.channels.size(); ++c) {
    const int channel = static_cast<int>(c);
    if (index_.channels[c] == channels::kSemanticMap.name) {
      feed_map(next_, channel, scene, intake);
    } else {
      const bool are_views = index_.channels[c] == channels::kObstacleSightings.name;
      feed_newest(next_, channel, are_views ? views_before(next_, channel) : messages_needed(index_.channels[c]),
                  intake);
    }
  }
}

void LogPlayer::step(int plans, Scene& scene, SceneIntake& intake) {
  const auto found = std::ranges::find(index_.channels, channels::kPlan.name);
  if (found == index_.channels.end()) return;
  const auto& plans_at = by_channel_[idx(found - index_.channels.begin())];
  const auto time_of = [&](std::uint32_t entry) { return index_.entries[entry].received; };
  auto at = std::upper_bound(plans_at.begin(), plans_at.end(), position_,
                             [&](UTime t, std::uint32_t entry) { return t < time_of(entry); });
  if (plans < 0) {
    at = std::lower_bound(plans_at.begin(), plans_at.end(), position_,
                          [&](std::uint32_t entry, UTime t) { return time_of(entry) < t; });
    if (at == plans_at.begin()) return;
    --at;
  }
  if (at == plans_at.end()) return;
  playing_ = false;
  seek(time_of(*at), scene, intake);
}

void LogPlayer::advance(UTime wall_now, SceneIntake& intake) {
  if (!playing_) return;
  const double played_us = static_cast<double>((wall_now - wall_).us) * speed_;
  wall_ = wall_now;
  position_ = std::min(position_ + Duration{static_cast<std::int64_t>(played_us)}, end());
  for (; next_ < index_.entries.size() && index_.entries[next_].received <= position_; ++next_) feed(next_, intake);
  if (position_ == end()) playing_ = false;
}

void LogPlayer::feed_newest(std::size_t end, int channel, std::size_t most, SceneIntake& intake) {
  const auto& entries = by_channel_[idx(channel)];
  const auto stop = std::lower_bound(entries.begin(), entries.end(), end);
  const auto have = idx(stop - entries.begin());
  for (auto it = stop - static_cast<std::ptrdiff_t>(std::min(have, most)); it != stop; ++it) feed(*it, intake);
}

std::size_t LogPlayer::views_before(std::size_t end, int channel) const {
  const auto& entries = by_channel_[idx(channel)];
  const auto stop = std::lower_bound(entries.begin(), entries.end(), end);
  const auto first = std::lower_bound(entries.begin(), stop, first_after(position_ - kViewsBefore));
  return std::max(kMaxSensors, idx(stop - first));
}

void LogPlayer::feed_map(std::size_t end, int channel, const Scene& scene, SceneIntake& intake) {
  const auto& entries = by_channel_[idx(channel)];
  const auto stop = std::lower_bound(entries.begin(), entries.end(), end);
  if (stop == entries.begin()) return;
  const auto newest = decode<MapChunk>(read(index_.entries[*(stop - 1)]));
  if (!newest || (scene.map() && scene.map()->version == newest->version)) return;
  feed_newest(end, channel, 2 * static_cast<std::size_t>(newest->count), intake);
}

const std::vector<std::uint8_t>& LogPlayer::read(const LogIndex::Entry& entry) {
  buffer_.resize(static_cast<std::size_t>(entry.bytes));
  std::ifstream& file = files_[idx(entry.part)];
  file.clear();
  file.seekg(entry.offset);
  file.read(reinterpret_cast<char*>(buffer_.data()), entry.bytes);
  if (!file) buffer_.clear();  ///< the file was truncated meanwhile; the decoder refuses an empty message
  return buffer_;
}

void LogPlayer::feed(std::size_t entry, SceneIntake& intake) {
  const LogIndex::Entry& e = index_.entries[entry];
  if (!intake.receive(index_.channels[idx(e.channel)], read(e), e.received)) ++refused_;
}

std::string LogPlayer::json() const {
  JsonWriter json;
  json.begin_object().key("begin_us").integer(begin().us);
  json.key("zero_us").integer(zero().us).key("end_us").integer(end().us);
  json.key("at_us").integer(position_.us).key("playing").flag(playing_).key("speed").number(speed_);
  json.key("refused").integer(refused_).key("damage").text(index_.damage);
  return json.end_object().take();
}

}  // namespace tern
