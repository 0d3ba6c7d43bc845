// The files mission.json and mission.txt of a flight: which steps were reached, and when.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/time.h"
#include "mavlink/messages.h"
#include "mission/progress.h"

namespace tern::mission {

/// Writes where a mission stands, and reads it back after a restart.
class MissionRecord {
 public:
  /// @param folder  of the flight; "": nothing is written
  explicit MissionRecord(std::string folder) : folder_(std::move(folder)) {}

  /// Replaces mission.json and mission.txt. @return false if that is impossible
  [[nodiscard]] bool write(const Progress& progress) const;
  /// Writes the steps of an uploaded mission, and reads them back after a restart. They are in uploaded.json.
  [[nodiscard]] bool write_upload(const std::vector<Step>& steps) const;
  [[nodiscard]] std::optional<std::vector<Step>> read_upload() const;
  /// Writes the items of uploaded fences to fences.json. @return an Error without a folder, or if that is impossible
  [[nodiscard]] Result<void> write_fences(const std::vector<mavlink::MissionItemInt>& items) const;
  /// Reads them back; empty if there is no such file. @return an Error if it is damaged
  [[nodiscard]] Result<std::vector<mavlink::MissionItemInt>> read_fences() const;
  /// Removes the files of a mission: an uploaded one was cleared or replaced.
  void forget() const;
  /// Reads mission.json; nullopt if there is none, or if it belongs to another mission.
  [[nodiscard]] std::optional<Remembered> read(const Mission& mission) const;

 private:
  std::string folder_;
};

/// The content of mission.txt: a line of the whole, and one per step.
std::string to_text(const Progress& progress);

}  // namespace tern::mission
