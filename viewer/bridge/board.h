// The newest JSON text of each topic, for the page.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

namespace tern {

/// The topics of a frame. A frame is a JSON object with one member per topic that changed since the reader's last
/// frame.
enum class Topic : std::uint8_t {
  Session,  ///< live or log, permissions, the scenario
  Player,   ///< position in the log
  State,    ///< the vehicle
  Truth,    ///< true obstacles
  Tracks,   ///< predicted obstacles
  Request,  ///< the committed trajectory, limits, flight box
  Plan,     ///< the last answer
  Timing,   ///< its cost
  Hulls,    ///< on demand
  Tracked,  ///< on demand: detections, and tracks with α and age
  Search,   ///< on demand
  Map,      ///< faces of the labelled voxels
  Health,   ///< every process
  Goal,
  Result,
  Chart,     ///< the fields that pages chart, over the whole flight
  Path,      ///< the flown path
  Fields,    ///< names of all fields that can be charted
  Events,    ///< marks of the timeline
  Ghost,     ///< the path of another log
  Views,     ///< fields of view of the sensors, and the planned heading
  Estimate,  ///< the estimator's pose with its bound, the true vehicle beside it, and the features in view
  Sight,     ///< depth pictures of the sensors with their sightings, and what no sensor has seen lately
};
inline constexpr int kTopics = 23;
const char* to_string(Topic topic);

/// Holds the newest text per topic. Thread-safe.
///
/// | event                                          | effect                               |
/// |------------------------------------------------|--------------------------------------|
/// | a new text is posted                           | readers get it with their next frame |
/// | the same text is posted again                  | none                                 |
/// | a text is replaced before a reader has read it | counted as dropped for that reader   |
///
/// Writers never wait for readers.
class Board {
 public:
  /// The state of one reader.
  struct Reader {
    std::array<std::int64_t, kTopics> taken{};
    std::int64_t frame = 0;    ///< number of frames that it got
    std::int64_t dropped = 0;  ///< texts that were replaced before it read them
  };

  /// Posts a text. @param json  a JSON value; "null" clears the topic
  void post(Topic topic, std::string json);
  /// Returns the reader's next frame, {"frame": n, "dropped": k, topic: value …}; empty if nothing is new. The first
  /// frame of a reader has every topic, and no drops.
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
