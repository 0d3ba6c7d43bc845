// What the page is told, by topic: only the newest text of each counts.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

namespace tern {

/// A frame is a JSON object with a member per topic that changed since the reader's last frame.
enum class Topic : std::uint8_t {
  Session,  ///< live or log, what is allowed, the scenario
  Player,   ///< where a log stands
  State,    ///< the vehicle
  Truth,    ///< obstacles as they are
  Tracks,   ///< obstacles as predicted
  Request,  ///< the committed trajectory, limits, flight box
  Plan,     ///< the last answer
  Timing,   ///< what it cost
  Hulls,    ///< on demand
  Search,   ///< on demand
  Map,      ///< faces of the labelled voxels
  Health,   ///< every process
  Goal,
  Result,
  Chart,   ///< the whole flight in numbers: the fields that pages ask for
  Path,    ///< where it flew
  Fields,  ///< what could be charted
  Events,  ///< what happened when
  Ghost,   ///< another log's path
};
inline constexpr int kTopics = 19;
const char* to_string(Topic topic);

/// The newest text per topic. A writer never waits for a reader. A text that a reader has not taken when the next one
/// comes is dropped for that reader and counted. A text that stands there already is not told again. Thread-safe.
class Board {
 public:
  /// What one reader has been given.
  struct Reader {
    std::array<std::int64_t, kTopics> taken{};
    std::int64_t frame = 0;    ///< counts the frames that it got
    std::int64_t dropped = 0;  ///< texts that were replaced before it took them
  };

  /// @param json  a JSON value; "null" takes back what the topic said
  void post(Topic topic, std::string json);
  /// The next frame for this reader: {"frame": n, "dropped": k, topic: value …}; empty when there is nothing new. A new
  /// reader gets everything, and has dropped nothing.
  std::string take(Reader& reader) const;

 private:
  struct Entry {
    std::int64_t version = 0;  ///< 0: nothing was posted
    std::shared_ptr<const std::string> json;
  };
  mutable std::mutex mutex_;
  std::array<Entry, kTopics> entries_;
};

}  // namespace tern
