// Plays a recorded flight: play, pause, step, speed, seek.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/time.h"
#include "viewer/bridge/app/flight_note.h"
#include "viewer/bridge/app/scene_intake.h"

namespace tern {

/// Where a log's messages lie in its files. An entry takes 24 bytes of memory, so a log of any length can be played.
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
  std::string damage;                 ///< in words, the unreadable part of the log; empty: all was read
};

/// Plays a log into a scene, by the receive times of its messages.
class LogPlayer {
 public:
  /// Reads the whole log once, for the index and the flight's history (charts and path).
  /// @param path    the first file of a log (further parts are found), or a flight's folder
  /// @param suffix  only channels with this suffix are played; "": all
  /// @return an Error that names the file if it is unreadable, or without a message of Tern
  static Result<LogPlayer> open(const std::string& path, const std::string& suffix);

  [[nodiscard]] UTime begin() const { return index_.entries.front().received; }
  [[nodiscard]] UTime end() const { return index_.entries.back().received; }
  /// Returns the flight's time 0: the start of world time, or the log's begin if that is unknown.
  [[nodiscard]] UTime zero() const { return memory_.world_time.zero().value_or(begin()); }
  [[nodiscard]] UTime position() const { return position_; }
  [[nodiscard]] bool playing() const { return playing_; }
  [[nodiscard]] const Scene::Memory& memory() const { return memory_; }
  /// Returns what the summary beside the log says.
  [[nodiscard]] const FlightNote& note() const { return note_; }
  /// Returns the radius of the ball around the vehicle's body, m; 0 if no request tells it.
  [[nodiscard]] double body_radius() const { return body_radius_; }

  /// Reads all predictions once, so memory() has the ages of the tracks. Takes about a second per gigabyte of log.
  void remember_tracks();

  void play(bool on, UTime wall_now);
  void set_speed(double factor) { speed_ = factor; }
  /// Sets the scene to its state at t: the newest message of each kind before t.
  void seek(UTime t, Scene& scene, SceneIntake& intake);
  /// Goes to the next (1) or previous (−1) answer of the planner, and pauses.
  void step(int plans, Scene& scene, SceneIntake& intake);
  /// Plays on to the position that the wall clock asks for; pauses at the log's end.
  void advance(UTime wall_now, SceneIntake& intake);

  /// Returns {"begin_us", "zero_us", "end_us", "at_us", "playing", "speed", "refused", "damage"}.
  [[nodiscard]] std::string json() const;

 private:
  LogPlayer(std::vector<std::ifstream> files, LogIndex index, FlightNote note);
  void build_memory();
  [[nodiscard]] std::size_t first_after(UTime t) const;
  void feed(std::size_t entry, SceneIntake& intake);
  void feed_newest(std::size_t end, int channel, std::size_t most, SceneIntake& intake);
  /// Returns how many of a channel's messages before `end` a jump reads for the views of the sensors.
  [[nodiscard]] std::size_t views_before(std::size_t end, int channel) const;
  void feed_map(std::size_t end, int channel, const Scene& scene, SceneIntake& intake);
  const std::vector<std::uint8_t>& read(const LogIndex::Entry& entry);

  std::vector<std::ifstream> files_;
  LogIndex index_;
  std::vector<std::vector<std::uint32_t>> by_channel_;  ///< entries of each channel
  FlightNote note_;
  Scene::Memory memory_;
  double body_radius_ = 0.0;
  std::vector<std::uint8_t> buffer_;
  UTime position_, wall_{};
  std::size_t next_ = 0;  ///< the first entry that is not yet played
  bool playing_ = false, remembers_tracks_ = false;
  double speed_ = 1.0;
  std::int64_t refused_ = 0;
};

}  // namespace tern
