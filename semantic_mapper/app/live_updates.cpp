#include "semantic_mapper/app/live_updates.h"

#include <fmt/format.h>

#include <utility>

#include "runtime/log.h"
#include "semantic_mapper/app/load_source.h"
#include "semantic_mapper/sources/class_names.h"
#include "semantic_mapper/voxel_map/voxel_painter.h"

namespace tern {

std::optional<LiveSetup> live_setup(const Scenario& scenario, const MapperConfig& config) {
  if (!config.live.enabled) return std::nullopt;
  LiveSetup setup;
  set_meanings(config.classes, setup.classes);
  for (const std::size_t number : {0U, 1U}) {
    if (!setup.classes[number] && !config.has_own_classes)
      setup.classes[number] = ClassMeaning{kUnlabelled, VoxelLabel::Occupied};
  }
  for (auto& meaning : setup.classes) {
    if (meaning && !is_kept(meaning->label, scenario.semantics.enabled)) meaning.reset();
  }
  setup.range = config.live.range;
  setup.period = config.live.period;
  setup.body = scenario.uav.body;
  setup.position = scenario.uav.start;
  return setup;
}

LiveUpdates::LiveUpdates(Bus& bus, const VoxelMap& base, const LiveSetup& setup)
    : bus_(bus),
      setup_(setup),
      map_(base, setup.classes, setup.range),
      intake_(bus),
      version_(base.version),
      next_map_(bus.clock().now()) {
  bus.subscribe(channels::kUavState, [this](const UavState& state) { setup_.position = state.motion.p; });
  bus.subscribe(channels::kMapFile, [this](const MapFile& part) { receive(part); });
}

void LiveUpdates::begin() {
  if (!std::exchange(has_begun_, true)) map_.free_start(setup_.body, setup_.position);
}

/// A refused file changes nothing: the one before stays.
void LiveUpdates::receive(const MapFile& part) {
  const auto bytes = file_parts_.add(part);
  if (!bytes) return;
  const auto octomap = parse_octomap(*bytes, "MAP_FILE", {-part.origin, 1.0});
  refused_file_ = octomap ? "" : octomap.error().message;
  if (!octomap) return log::warn("an OctoMap is not used: {}", refused_file_);
  if (!map_.set_octomap(*octomap)) {
    refused_file_ = fmt::format("none of its {} leaves lies in the map: check its origin and its frame",
                                octomap->leaves.size() + static_cast<std::size_t>(octomap->too_far));
    return log::warn("an OctoMap is not used: {}", refused_file_);
  }
  begin();
}

void LiveUpdates::add_scans(UTime now) {
  const std::int64_t left_out = intake_.left_out();
  const int used = intake_.add_to(map_, now);
  if (intake_.left_out() > left_out) last_left_out_ = now;
  if (used == 0) return;
  begin();
  last_scan_ = now;
}

std::optional<VoxelMap> LiveUpdates::take_new(UTime now) {
  if (now < next_map_) return std::nullopt;
  next_map_ = now + setup_.period;
  VoxelMap map = map_.map(setup_.body, setup_.position);
  if (map.version == std::exchange(version_, map.version)) return std::nullopt;
  return map;
}

std::string LiveUpdates::waiting_for() const {
  const std::string why = intake_.trouble().empty() ? "" : "; " + intake_.trouble();
  if (!has_begun_) {
    const std::string first = "a scan on POINT_CLOUD or DEPTH_IMAGE, or an OctoMap on MAP_FILE" + why;
    return refused_file_.empty() ? first : first + "; an OctoMap is not used: " + refused_file_;
  }
  if (!last_scan_) return "";
  const Duration silence = bus_.clock().now() - *last_scan_;
  if (silence < kScanSilence) return "";
  return fmt::format("scans: the last usable one came {:.0f} s ago", silence.seconds()) + why;
}

std::string LiveUpdates::trouble() const {
  if (!refused_file_.empty()) return "an OctoMap is not used: " + refused_file_;
  if (const std::string of_scan = intake_.trouble(); !of_scan.empty()) return of_scan;
  if (!last_left_out_ || bus_.clock().now() - *last_left_out_ >= kScanSilence) return "";
  return fmt::format("overloaded: {} scans so far were left out for newer ones; send fewer points", intake_.left_out());
}

}  // namespace tern
