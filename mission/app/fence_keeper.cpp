#include "mission/app/fence_keeper.h"

#include <fmt/format.h>

#include <utility>

#include "core/world/uploaded_fences.h"
#include "mission/check.h"
#include "mission/upload/fence_items.h"
#include "runtime/log.h"
#include "runtime/polygon.h"

namespace tern::mission {
namespace {

using Wire = std::vector<mavlink::MissionItemInt>;

Result<std::vector<Fence>> read(const Wire& wire, const Site& site) {
  std::vector<Item> items;
  for (const mavlink::MissionItemInt& item : wire) items.push_back(item_of(item));
  auto fences = fences_of(items, site);
  if (!fences) return fences;
  for (std::size_t k = 0; k < fences->size(); ++k) {
    const auto* polygon = std::get_if<FencePolygon>(&(*fences)[k].shape);
    if (polygon != nullptr && !is_simple_polygon(polygon->corners))
      return fail(fmt::format("fence {} is a polygon that touches or crosses itself", k + 1));
  }
  return fences;
}

std::string count_of(const std::vector<Fence>& fences) {
  return fences.size() == 1 ? "1 uploaded fence is" : fmt::format("{} uploaded fences are", fences.size());
}

}  // namespace

FenceKeeper::FenceKeeper(Bus& bus, const MissionRecord& record, Site site, UavSpec uav)
    : bus_(bus), record_(record), site_(std::move(site)), uav_(std::move(uav)), changed_(bus.clock().now()) {
  next_publish_ = changed_;
  auto recorded = record_.read_fences();
  if (recorded) items_ = std::move(*recorded);
  const auto fences = recorded ? read(items_, site_) : fail(recorded.error().message);
  if (fences) {
    fences_ = *fences;
    if (!fences_.empty()) log::info("has {} fences that were uploaded before the restart", fences_.size());
    return;
  }
  is_readable_ = false;
  items_.clear();
  refused_ = "the recorded fences are unreadable: upload or clear fences";
  log::error("the recorded fences are unreadable: {}", fences.error().message);
}

std::string FenceKeeper::refuse(std::string why) {
  refused_ = "the last upload of fences was refused: upload or clear fences";
  log::warn("uploaded fences are refused: {}", why);
  return why;
}

/// A map that is occupied where the fences forbid, and unknown elsewhere.
Result<VoxelMap> FenceKeeper::forbidden(const std::vector<Fence>& fences, const VoxelGrid& grid) const {
  const auto labels = uploaded_fence_labels(fences, grid, uav_.flight_box);
  if (!labels) return tl::unexpected(labels.error());
  VoxelMap map;
  map.grid = grid;
  map.labels.assign(idx(grid.voxels()), VoxelLabel::Unknown);
  map.classes.assign(idx(grid.voxels()), 0);
  map.class_names = {""};
  add_uploaded_fences(*labels, map);
  return map;
}

std::string FenceKeeper::take(const Wire& items, const VoxelMap& map, const Mission* mission, const Vec3& vehicle) {
  const auto fences = read(items, site_);
  if (!fences) return refuse(fences.error().message);
  auto forbids = forbidden(*fences, map.grid);
  if (!forbids) return refuse(forbids.error().message);
  if (const std::string why = beyond(*forbids, mission, vehicle); !why.empty()) return refuse(why);
  if (const auto kept = record_.write_fences(items); !kept) return refuse(kept.error().message);
  items_ = items;
  fences_ = *fences;
  forbidden_ = std::move(*forbids);
  refused_.clear();
  is_readable_ = true;
  is_in_force_ = has_complained_ = false;
  held_since_.reset();
  next_publish_ = changed_ = bus_.clock().now();
  receive(map);
  return "";
}

void FenceKeeper::receive(const VoxelMap& map) {
  const VoxelGrid& grid = map.grid;
  const bool is_other = !forbidden_ || forbidden_->grid.size != grid.size || forbidden_->grid.origin != grid.origin ||
                        forbidden_->grid.resolution != grid.resolution;
  if (is_other && is_readable_) {
    auto forbids = forbidden(fences_, grid);
    if (!forbids) log::error("the uploaded fences do not fit into the map: {}", forbids.error().message);
    forbidden_.reset();
    if (forbids) forbidden_ = std::move(*forbids);
  }
  const bool holds = forbidden_ && holds_fences(map, forbidden_->labels);
  if (!holds) {
    held_since_.reset();
    is_in_force_ = false;
  } else if (!held_since_) {
    held_since_ = bus_.clock().now();
  }
}

std::vector<std::string> FenceKeeper::step(UTime now) {
  std::vector<std::string> texts;
  if (!is_in_force_ && held_since_ && now >= *held_since_ + kMapSilence) {
    is_in_force_ = true;
    if (!fences_.empty()) texts.push_back(count_of(fences_) + " in force");
  }
  if (!not_in_force().empty() && refused_.empty() && now >= changed_ + kFencePatience &&
      !std::exchange(has_complained_, true)) {
    texts.emplace_back("the fences are not in force: tern-mapper has not put them into its map");
  }
  for (const std::string& text : texts) log::info("{}", text);
  if (now < next_publish_) return texts;
  next_publish_ = now + kFencePeriod;
  if (is_readable_) bus_.publish(channels::kFences, FenceSet{{}, fences_});
  return texts;
}

std::string FenceKeeper::not_in_force() const {
  if (!refused_.empty()) return refused_;
  return is_in_force_ || fences_.empty() ? "" : "the uploaded fences are not yet in force";
}

std::string FenceKeeper::why_beyond(const Mission* mission, const Vec3& vehicle) const {
  return forbidden_ ? beyond(*forbidden_, mission, vehicle) : "";
}

std::string FenceKeeper::beyond(const VoxelMap& map, const Mission* mission, const Vec3& vehicle) const {
  Mission places = mission == nullptr ? Mission{} : *mission;
  Step here;
  here.name = "the vehicle";
  here.position = vehicle;
  places.steps.insert(places.steps.begin(), here);
  return steps_blocked(places, map, uav_.body);
}

}  // namespace tern::mission
