#include "semantic_mapper/sources/fence_file.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "core/base/plain_text.h"
#include "geodesy/json_values.h"

namespace tern {
namespace {

using Json = nlohmann::json;
using Place = Eigen::Vector2d;

std::optional<double> finite(const Json& json) {
  if (!json.is_number() || !std::isfinite(json.get<double>())) return std::nullopt;
  return json.get<double>();
}

/// Reads two coordinates; with `is_reversed` the longitude comes first, as in GeoJSON.
Result<Place> read_place(const Json& json, bool is_reversed) {
  if (!json.is_array() || json.size() < 2 || json.size() > 3) {
    return fail("a place is not a list of two or three numbers");
  }
  const auto first = finite(json[0]), second = finite(json[1]);
  if (!first || !second) return fail("a coordinate is not a finite number");
  const Place place = is_reversed ? Place(*second, *first) : Place(*first, *second);
  if (const std::string why = why_not_on_earth({place.x(), place.y(), 0.0}); !why.empty()) return fail(why);
  return place;
}

Result<FencePolygon> read_polygon(const Json& json, bool is_reversed) {
  if (!json.is_array() || json.size() < 3 || json.size() > kMaxFenceCorners) {
    return fail(fmt::format("{} corners (limit 3 to {})", json.is_array() ? json.size() : 0, kMaxFenceCorners));
  }
  FencePolygon polygon;
  for (const Json& corner : json) {
    const auto place = read_place(corner, is_reversed);
    if (!place) return tl::unexpected(place.error());
    polygon.corners.push_back(*place);
  }
  return polygon;
}

Result<FenceCircle> read_circle(const Json& centre, const Json& radius, bool is_reversed) {
  const auto place = read_place(centre, is_reversed);
  if (!place) return tl::unexpected(place.error());
  const auto metres = finite(radius);
  if (!metres || !(*metres > 0.0 && *metres <= kMaxFenceRadius)) {
    return fail(fmt::format("its radius is not a number in (0, {}] m", kMaxFenceRadius));
  }
  return FenceCircle{*place, *metres};
}

template <class Shape>
Result<Fence> with_shape(Fence fence, const Result<Shape>& shape) {
  if (!shape) return tl::unexpected(shape.error());
  fence.shape = *shape;
  fence.is_geodetic = true;
  return fence;
}

Result<Fence> read_plan_fence(const Json& json, bool is_circle) {
  Fence fence;
  const Json& inclusion = member(json, "inclusion");
  if (!inclusion.is_boolean()) return fail("inclusion is neither true nor false");
  fence.is_inclusion = inclusion.get<bool>();
  if (!is_circle) return with_shape(fence, read_polygon(member(json, "polygon"), false));
  const Json& circle = member(json, "circle");
  return with_shape(fence, read_circle(member(circle, "center"), member(circle, "radius"), false));
}

Result<std::vector<Fence>> parse_plan_fences(const Json& json) {
  if (short_text(member(json, "fileType")) != "Plan") return fail("fileType is not \"Plan\"");
  const Json& all = member(json, "geoFence");
  std::vector<Fence> fences;
  for (const char* kind : {"polygons", "circles"}) {
    const Json& list = member(all, kind);
    if (list.is_null()) continue;
    if (!list.is_array()) return fail(fmt::format("geoFence.{} is not a list", kind));
    for (std::size_t k = 0; k < list.size(); ++k) {
      auto fence = read_plan_fence(list[k], kind[0] == 'c');
      if (!fence) return fail(fmt::format("geoFence.{}[{}]: {}", kind, k, fence.error().message));
      fence->name = fmt::format("{}[{}]", kind, k);
      fences.push_back(std::move(*fence));
    }
  }
  return fences;
}

Result<Fence> read_feature(const Json& feature) {
  const Json& properties = member(feature, "properties");
  Fence fence;
  fence.name = short_text(member(properties, "name"));
  const std::string kind = short_text(member(properties, "fence"));
  if (kind != "inclusion" && kind != "exclusion") return fail("fence is neither \"inclusion\" nor \"exclusion\"");
  fence.is_inclusion = kind == "inclusion";
  for (auto [name, level] : {std::pair{"floor", &fence.floor}, std::pair{"ceiling", &fence.ceiling}}) {
    const Json& json = member(properties, name);
    if (json.is_null()) continue;
    const auto value = finite(json);
    if (!value || std::abs(*value) > kMaxFenceRadius) return fail(fmt::format("{} is not a height in m", name));
    *level = *value;
  }
  if (!(fence.floor < fence.ceiling)) return fail("its floor is not below its ceiling");
  const Json& geometry = member(feature, "geometry");
  const Json& coordinates = member(geometry, "coordinates");
  const std::string type = short_text(member(geometry, "type"));
  if (type == "Point") return with_shape(fence, read_circle(coordinates, member(properties, "radius_m"), true));
  if (type != "Polygon") return fail(fmt::format("geometry \"{}\" cannot be a fence; give a Polygon or a Point", type));
  if (!coordinates.is_array() || coordinates.size() != 1) return fail("a polygon with holes cannot be used");
  auto polygon = read_polygon(coordinates[0], true);
  if (polygon && polygon->corners.size() > 3 && polygon->corners.front() == polygon->corners.back()) {
    polygon->corners.pop_back();  // a ring of GeoJSON ends where it begins
  }
  return with_shape(fence, polygon);
}

Result<std::vector<Fence>> parse_geojson_fences(const Json& json) {
  const Json& features = member(json, "features");
  if (short_text(member(json, "type")) != "FeatureCollection" || !features.is_array()) {
    return fail("is no FeatureCollection with features");
  }
  std::vector<Fence> fences;
  for (std::size_t k = 0; k < features.size(); ++k) {
    if (member(member(features[k], "properties"), "fence").is_null()) continue;
    auto fence = read_feature(features[k]);
    if (!fence) return fail(fmt::format("features[{}]: {}", k, fence.error().message));
    if (fence->name.empty()) fence->name = fmt::format("features[{}]", k);
    fences.push_back(std::move(*fence));
  }
  return fences;
}

}  // namespace

Result<std::vector<Fence>> parse_fences(std::string_view text, const std::string& file) {
  const auto explain = [&](const std::string& why) { return fail(plain_text(fmt::format("{}: {}", file, why))); };
  if (text.size() > kMaxFenceBytes) {
    return explain(fmt::format("has {} bytes (limit {})", text.size(), kMaxFenceBytes));
  }
  const bool is_plan = file.ends_with(".plan");
  if (!is_plan && !file.ends_with(".geojson") && !file.ends_with(".json")) {
    return explain("the name of a file with fences must end in .plan, .geojson or .json");
  }
  const auto json = parse_json(text);
  if (!json) return explain(json.error().message);
  auto fences = is_plan ? parse_plan_fences(*json) : parse_geojson_fences(*json);
  if (!fences) return explain(fences.error().message);
  if (fences->size() > kMaxFencesOfFile) {
    return explain(fmt::format("has {} fences (limit {})", fences->size(), kMaxFencesOfFile));
  }
  return fences;
}

Result<Fence> to_world(Fence fence, const LocalFrame& frame) {
  std::string wrong;
  const auto convert = [&](Place& place) {
    const GeodeticPoint at{place.x(), place.y(), frame.origin().height};
    if (const std::string why = why_not_on_earth(at); !why.empty()) wrong = why;
    if (wrong.empty()) place = frame.to_world(at).head<2>();
  };
  if (auto* polygon = std::get_if<FencePolygon>(&fence.shape)) {
    for (Place& corner : polygon->corners) convert(corner);
  } else {
    convert(std::get<FenceCircle>(fence.shape).centre);
  }
  if (!wrong.empty()) return fail(wrong);
  fence.is_geodetic = false;
  return fence;
}

}  // namespace tern
