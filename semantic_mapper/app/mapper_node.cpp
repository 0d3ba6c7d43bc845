#include "semantic_mapper/app/mapper_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "core/wire/message_limits.h"
#include "core/world/map_progress.h"
#include "messages/codec.h"
#include "runtime/log.h"
#include "semantic_mapper/app/fence_uploads.h"
#include "semantic_mapper/app/live_updates.h"
#include "semantic_mapper/app/load_map.h"

namespace tern {
namespace {

static_assert(kMaxMessageBytes * std::int64_t{1'000'000} / kMapBytesPerSecond <= kMapChunkTime.us);

/// Returns the size of a chunk on the wire, to within a few bytes.
std::int64_t bytes_of(const MapChunk& chunk) {
  constexpr std::int64_t kFixedBytes = 120;
  constexpr std::int64_t kRunBytes = 6;
  std::int64_t bytes = kFixedBytes + kRunBytes * static_cast<std::int64_t>(chunk.runs.size());
  for (const std::string& name : chunk.class_names) bytes += 4 + static_cast<std::int64_t>(name.size());
  return bytes;
}

/// Returns how long a rotation takes, in words; "" if it takes no longer than kMapSilence.
std::string rotation_text(const std::vector<MapChunk>& chunks) {
  std::int64_t bytes = 0;
  for (const MapChunk& chunk : chunks) bytes += bytes_of(chunk);
  const Duration rotation{bytes * 1'000'000 / kMapBytesPerSecond};
  if (rotation <= kMapSilence) return "";
  return fmt::format("the map of {:.0f} MB in {} chunks takes {:.0f} s, at {:g} MB/s",
                     static_cast<double>(bytes) * 1e-6, chunks.size(), rotation.seconds(),
                     static_cast<double>(kMapBytesPerSecond) * 1e-6);
}

std::array<std::int64_t, kVoxelLabels> count_labels(const VoxelMap& map) {
  std::array<std::int64_t, kVoxelLabels> count{};
  for (const VoxelLabel label : map.labels) ++count[idx(label)];
  return count;
}

}  // namespace

MapperNode::MapperNode(Bus& bus, const VoxelMap& map, const std::optional<LiveSetup>& live,
                       const std::optional<Box>& fenced, std::string warnings)
    : bus_(bus),
      warnings_(std::move(warnings)),
      rotation_began_(bus.clock().now()),
      next_(rotation_began_),
      earliest_(rotation_began_) {
  if (live) live_ = std::make_unique<LiveUpdates>(bus, map, *live);
  if (fenced) {
    fences_ = std::make_unique<FenceUploads>(bus, map.grid, *fenced);
    unfenced_ = map;
  }
  publish(map);
  if (!rotation_text_.empty()) log::info("{}", rotation_text_);
}

MapperNode::~MapperNode() = default;

void MapperNode::publish(const VoxelMap& map) {
  chunks_ = to_chunks(map);
  if (chunks_.size() > static_cast<std::size_t>(kMaxMapChunks)) {
    throw std::invalid_argument(
        fmt::format("the map takes {} chunks (limit {}): give smaller extents or a coarser resolution", chunks_.size(),
                    kMaxMapChunks));
  }
  rotation_text_ = rotation_text(chunks_);
  at_ = 0;
  next_ = earliest_;
}

UTime MapperNode::next_wakeup() const {
  if (fences_ && !fences_->has_taken()) return live_ ? live_->next_scan() : kNever;
  if (!live_) return next_;
  if (!live_->has_begun()) return live_->next_scan();
  const UTime next = std::min(next_, live_->next_scan());
  return at_ == 0 ? std::min(next, live_->next_map()) : next;
}

void MapperNode::take_changes(UTime now) {
  std::optional<VoxelMap> map = live_ ? live_->take_new(now) : std::nullopt;
  if (!fences_) {
    if (map) publish(*map);
    return;
  }
  const bool is_new = map || fences_->has_changed();
  if (map) unfenced_ = std::move(*map);
  if (is_new) publish(fences_->onto(unfenced_));
}

void MapperNode::step(UTime now) {
  if (live_) {
    live_->add_scans(now);
    if (!live_->has_begun()) return;
  }
  if (fences_ && !fences_->has_taken()) return;
  if (at_ == 0) take_changes(now);
  if (now < next_) return;
  if (at_ == 0) rotation_began_ = now;
  const MapChunk& chunk = chunks_[at_];
  bus_.publish(channels::kSemanticMap, chunk);
  earliest_ = now + std::max(kPacing, Duration{bytes_of(chunk) * 1'000'000 / kMapBytesPerSecond});
  at_ = (at_ + 1) % chunks_.size();
  next_ = at_ == 0 ? std::max(earliest_, rotation_began_ + kMapPeriod) : earliest_;
}

NodeHealth MapperNode::health() const {
  const std::string waiting_for = live_ ? live_->waiting_for() : "";
  if (!waiting_for.empty()) return {ProcessState::Waiting, waiting_for};
  const std::string fences = fences_ ? fences_->text() : "";
  if (!fences.empty() && !fences_->has_taken()) return {ProcessState::Waiting, fences};
  std::string words = fences;
  for (const std::string& more : {live_ ? live_->trouble() : "", rotation_text_, warnings_}) {
    if (!more.empty()) words += (words.empty() ? "" : "; ") + more;
  }
  return {ProcessState::Ready, words};
}

std::optional<Box> fenced_by_uploads(const Scenario& scenario, const MapperConfig& config) {
  return config.fence_uploads ? std::optional(scenario.uav.flight_box) : std::nullopt;
}

std::unique_ptr<Node> make_mapper_node(ProcessContext& context) {
  const MapperConfig config = read_mapper_config(context.document);
  const LoadedMap loaded = load_map(context.scenario, config, std::getenv("TERN_DATA"));
  log_remarks(loaded.remarks);
  const VoxelMap& map = loaded.map;
  const auto count = count_labels(map);
  log::info("map {:016x}: {} × {} × {} voxels of {} m: {} occupied, {} attractive, {} repulsive, {} unknown",
            map.version, map.grid.size.x(), map.grid.size.y(), map.grid.size.z(), map.grid.resolution, count[2],
            count[3], count[4], count[0]);
  try {
    return std::make_unique<MapperNode>(context.bus, map, live_setup(context.scenario, config),
                                        fenced_by_uploads(context.scenario, config), warnings_of(loaded.remarks));
  } catch (const std::invalid_argument& e) {
    throw ConfigError(fmt::format("{}: mapper: {}", context.scenario.file, e.what()));
  }
}

}  // namespace tern
