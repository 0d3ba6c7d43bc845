#include "semantic_mapper/app/fence_uploads.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/world/uploaded_fences.h"
#include "runtime/log.h"
#include "runtime/polygon.h"

namespace tern {
namespace {

bool is_same(const Fence& a, const Fence& b) {
  if (a.is_inclusion != b.is_inclusion || a.shape.index() != b.shape.index()) return false;
  if (const auto* polygon = std::get_if<FencePolygon>(&a.shape))
    return polygon->corners == std::get<FencePolygon>(b.shape).corners;
  const auto &one = std::get<FenceCircle>(a.shape), &other = std::get<FenceCircle>(b.shape);
  return one.centre == other.centre && one.radius == other.radius;
}

}  // namespace

FenceUploads::FenceUploads(Bus& bus, const VoxelGrid& grid, const Box& flight_box)
    : grid_(grid), flight_box_(flight_box) {
  bus.subscribe(channels::kFences, [this](const FenceSet& set) { receive(set); });
}

void FenceUploads::receive(const FenceSet& set) {
  if (has_heard_ && std::ranges::equal(set.fences, heard_, is_same)) return;
  has_heard_ = true;
  heard_ = set.fences;
  refused_ = take(set.fences);
  if (!refused_.empty()) return log::warn("{} uploaded fences are not used: {}", set.fences.size(), refused_);
  has_changed_ = true;
  log::info("{} uploaded fences are in force", set.fences.size());
}

std::string FenceUploads::take(const std::vector<Fence>& fences) {
  for (const Fence& fence : fences) {
    const auto* polygon = std::get_if<FencePolygon>(&fence.shape);
    if (polygon != nullptr && !is_simple_polygon(polygon->corners)) return "a polygon touches or crosses itself";
  }
  auto labels = uploaded_fence_labels(fences, grid_, flight_box_);
  if (!labels) return labels.error().message;
  labels_ = std::move(*labels);
  return "";
}

VoxelMap FenceUploads::onto(VoxelMap map) {
  has_changed_ = false;
  add_uploaded_fences(*labels_, map);
  return map;
}

std::string FenceUploads::text() const {
  if (!refused_.empty()) return "uploaded fences are not used: " + refused_;
  return labels_ ? "" : "FENCES of tern-mission (mission.fence_uploads)";
}

}  // namespace tern
