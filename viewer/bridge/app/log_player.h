// A recorded flight as a tape: play, pause, step, speed, scrub.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/time.h"
#include "viewer/bridge/app/scene_intake.h"

namespace tern {

/// Where the messages of one log lie in its files: 24 bytes of memory each, so that a log of any length can be played.
struct LogIndex {
  struct Entry {
    UTime received;
    std::int64_t offset = 0;  ///< of the message's bytes in its file
    std::int32_t bytes = 0;
    std::int16_t part = 0;     ///< which file of the log
    std::int16_t channel = 0;  ///< index into `channels`
  };
  std::vector<std::string> channels;  ///< without the vehicle's suffix
  std::vector<Entry> entries;         ///< times ascending
  std::string damage;                 ///< what could not be read, in words; "" when all could
};

/// Plays a log into a scene by the time at which its messages were received.
class LogPlayer {
 public:
  /// Reads the whole log once, for its index and the flight's history (charts and path).
  /// @param path  a file that tern-logger began (its further parts are found), or a flight's folder
  /// @param suffix  only channels that end with it are played, "" for all
  /// @return an Error that names the file when it cannot be read or holds no message of Tern's
  static Result<LogPlayer> open(const std::string& path, const std::string& suffix);

  [[nodiscard]] UTime begin() const { return index_.entries.front().received; }
  [[nodiscard]] UTime end() const { return index_.entries.back().received; }
  /// The flight's time 0: that of the world, or the log's begin where that is not known.
  [[nodiscard]] UTime zero() const { return memory_.world_time.zero().value_or(begin()); }
  [[nodiscard]] UTime position() const { return position_; }
  [[nodiscard]] bool playing() const { return playing_; }
  [[nodiscard]] const Scene::Memory& memory() const { return memory_; }
  /// The radius of the ball around the vehicle's body, m; 0 when no request says it.
  [[nodiscard]] double body_radius() const { return body_radius_; }

  void play(bool on, UTime wall_now);
  void set_speed(double factor) { speed_ = factor; }
  /// Brings the scene to what it was at t: the newest complete set, plan and so on before it.
  void seek(UTime t, Scene& scene, SceneIntake& intake);
  /// To the next (1) or the last (−1) answer of the planner, and pauses there.
  void step(int plans, Scene& scene, SceneIntake& intake);
  /// Plays on to what the wall clock asks for; pauses at the log's end.
  void advance(UTime wall_now, SceneIntake& intake);

  /// {"begin_us", "zero_us", "end_us", "at_us", "playing", "speed", "refused", "damage"}
  [[nodiscard]] std::string json() const;

 private:
  LogPlayer(std::vector<std::ifstream> files, LogIndex index);
  void build_memory();
  [[nodiscard]] std::size_t first_after(UTime t) const;
  void feed(std::size_t entry, SceneIntake& intake);
  void feed_newest(std::size_t end, int channel, std::size_t most, SceneIntake& intake);
  void feed_map(std::size_t end, int channel, const Scene& scene, SceneIntake& intake);
  const std::vector<std::uint8_t>& read(const LogIndex::Entry& entry);

  std::vector<std::ifstream> files_;
  LogIndex index_;
  std::vector<std::vector<std::uint32_t>> by_channel_;  ///< entries of each channel
  Scene::Memory memory_;
  double body_radius_ = 0.0;
  std::vector<std::uint8_t> buffer_;
  UTime position_, wall_{};
  std::size_t next_ = 0;  ///< the first entry that was not played
  bool playing_ = false;
  double speed_ = 1.0;
  std::int64_t refused_ = 0;
};

}  // namespace tern
