#include "mission/upload/fence_items.h"

#include <fmt/format.h>

#include <cmath>

#include "core/world/fence_set.h"

namespace tern::mission {
namespace {

using Place = Eigen::Vector2d;

constexpr int kReturnPoint = 5000, kPolygonInclusion = 5001, kPolygonExclusion = 5002, kCircleInclusion = 5003,
              kCircleExclusion = 5004;
/// Frames of items, by MAVLink's common.xml.
constexpr int kGlobal = 0, kLocalNed = 1, kRelative = 3, kLocalEnu = 4, kGlobalInt = 5, kRelativeInt = 6;

class FenceReader {
 public:
  explicit FenceReader(const Site& site) : site_(site) {}

  Result<void> add(const Item& item) {
    const bool is_polygon = item.command == kPolygonInclusion || item.command == kPolygonExclusion;
    if (missing_ > 0 && item.command != polygon_command_)
      return refuse(item, fmt::format("{} corners of the polygon before are missing", missing_));
    if (item.command == kReturnPoint) return {};
    const bool is_circle = item.command == kCircleInclusion || item.command == kCircleExclusion;
    if (!is_polygon && !is_circle) return refuse(item, "is no fence");
    if (std::isfinite(item.params[1]) && item.params[1] != 0.0)
      return refuse(item, fmt::format("groups of inclusions (param2 = {:g}) are not supported", item.params[1]));
    const auto place = place_of(item);
    if (!place) return tl::unexpected(place.error());
    return is_polygon ? corner(item, *place) : circle(item, *place);
  }

  [[nodiscard]] Result<std::vector<Fence>> take() {
    if (missing_ > 0) return fail(fmt::format("the last polygon lacks {} corners", missing_));
    return std::move(fences_);
  }

 private:
  static tl::unexpected<Error> refuse(const Item& item, const std::string& why) {
    return fail(fmt::format("fence item {}, {}: {}", item.number, command_name(item.command), why));
  }

  [[nodiscard]] Result<Place> place_of(const Item& item) const {
    if (!std::isfinite(item.x) || !std::isfinite(item.y)) return refuse(item, "has no position");
    const auto near = [&item](const Place& place) -> Result<Place> {
      if (place.cwiseAbs().maxCoeff() <= kMaxDistance) return place;
      return refuse(item, fmt::format("({:.0f}, {:.0f}) m is farther than {:g} m from the origin", place.x(), place.y(),
                                      kMaxDistance));
    };
    switch (item.frame) {
      case kLocalNed: return near({item.y, item.x});
      case kLocalEnu: return near({item.x, item.y});
      case kGlobal:
      case kRelative:
      case kGlobalInt:
      case kRelativeInt: break;
      default: return refuse(item, fmt::format("frame {} is not supported", item.frame));
    }
    if (!site_.frame) return refuse(item, site_.no_frame);
    const GeodeticPoint at{item.x, item.y, site_.frame->origin().height};
    if (const std::string why = why_not_on_earth(at); !why.empty()) return refuse(item, why);
    return near(site_.frame->to_world(at).head<2>());
  }

  Result<void> corner(const Item& item, const Place& place) {
    const double count = item.params[0];
    if (missing_ == 0) {
      if (!(count >= 3.0 && count <= kMaxFenceCornersPerMessage) || count != std::floor(count))
        return refuse(item, fmt::format("{:g} corners (limit 3 to {})", count, kMaxFenceCornersPerMessage));
      missing_ = static_cast<int>(count);
      polygon_count_ = missing_;
      polygon_command_ = item.command;
      Fence fence;
      fence.is_inclusion = item.command == kPolygonInclusion;
      fence.shape = FencePolygon{};
      if (auto added = push(item, std::move(fence)); !added) return added;
    }
    if (count != polygon_count_)
      return refuse(item, fmt::format("{:g} corners, and {} at the first one", count, polygon_count_));
    if (++corners_ > kMaxFenceCornersPerMessage)
      return refuse(item, fmt::format("more than {} corners in all", kMaxFenceCornersPerMessage));
    std::get<FencePolygon>(fences_.back().shape).corners.push_back(place);
    --missing_;
    return {};
  }

  Result<void> circle(const Item& item, const Place& place) {
    const double radius = item.params[0];
    if (!(radius > 0.0 && radius <= kMaxUploadedRadius))
      return refuse(item, fmt::format("a radius of {:g} m is not in (0, {:g}] m", radius, kMaxUploadedRadius));
    Fence fence;
    fence.is_inclusion = item.command == kCircleInclusion;
    fence.shape = FenceCircle{place, radius};
    return push(item, std::move(fence));
  }

  Result<void> push(const Item& item, Fence fence) {
    if (fences_.size() == kMaxFencesPerMessage)
      return refuse(item, fmt::format("more than {} fences", kMaxFencesPerMessage));
    fences_.push_back(std::move(fence));
    return {};
  }

  const Site& site_;
  std::vector<Fence> fences_;
  int missing_ = 0;  ///< corners of the polygon that is being read
  int polygon_count_ = 0, polygon_command_ = 0;
  int corners_ = 0;  ///< of all polygons
};

}  // namespace

Result<std::vector<Fence>> fences_of(const std::vector<Item>& items, const Site& site) {
  FenceReader reader(site);
  for (const Item& item : items) {
    if (const auto added = reader.add(item); !added) return tl::unexpected(added.error());
  }
  return reader.take();
}

}  // namespace tern::mission
