// The live part of tern-mapper: scans, OctoMaps and the vehicle's position in, new versions of the map out.
#pragma once

#include <optional>
#include <string>

#include "runtime/bus.h"
#include "semantic_mapper/app/live_intake.h"
#include "semantic_mapper/app/live_setup.h"
#include "semantic_mapper/app/map_file_parts.h"

namespace tern {

/// After this time without a scan, HEARTBEAT says so.
inline constexpr Duration kScanSilence{2'000'000};

/// Receives scans and OctoMaps, and gives a new version of the map when they have changed it.
class LiveUpdates {
 public:
  /// @param base  the map of the files. @throws std::invalid_argument as LiveMap's constructor
  LiveUpdates(Bus& bus, const VoxelMap& base, const LiveSetup& setup);

  /// Whether a scan with a point that counts, or an OctoMap, was used.
  [[nodiscard]] bool has_begun() const { return has_begun_; }
  /// Adds the scans that are complete.
  void add_scans(UTime now);
  /// Returns the map if it differs from the version given last. Not more often than once per period.
  std::optional<VoxelMap> take_new(UTime now);
  [[nodiscard]] UTime next_map() const { return next_map_; }
  [[nodiscard]] UTime next_scan() const { return intake_.next_complete(); }
  /// The text for HEARTBEAT while usable scans are missing (LiveIntake). "" while they come, or if there is an OctoMap
  /// and no scan was ever used.
  [[nodiscard]] std::string waiting_for() const;
  /// The text for HEARTBEAT if scans were left out in the last kScanSilence, one was not used, or the newest OctoMap is
  /// refused; else "".
  [[nodiscard]] std::string trouble() const;

 private:
  void receive(const MapFile& part);
  /// Unseen space around the vehicle is free from the first scan or OctoMap on.
  void begin();

  Bus& bus_;
  LiveSetup setup_;
  LiveMap map_;
  LiveIntake intake_;
  MapFileParts file_parts_;
  std::string refused_file_;  ///< why the newest MAP_FILE was not used; "": it was
  bool has_begun_ = false;
  std::uint64_t version_;
  UTime next_map_;
  std::optional<UTime> last_scan_;
  std::optional<UTime> last_left_out_;
};

}  // namespace tern
