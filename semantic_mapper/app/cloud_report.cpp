#include "semantic_mapper/app/cloud_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/wire/message_limits.h"
#include "core/world/names.h"
#include "runtime/log.h"
#include "semantic_mapper/sources/class_names.h"

namespace tern {
namespace {

/// Float32 coordinates are warned of where neighbouring numbers lie farther apart than this share of a voxel: rounding
/// then moves a point by up to an eighth of a voxel.
constexpr double kMaxSpacingShare = 0.25;
constexpr std::size_t kClassesShown = 12;
constexpr const char* kNotNear = "lies in or near uav.flight_box";
constexpr const char* kCheckFrame = "check origin and metres_per_unit";

/// Whether a source may lie beside the flight box: the extents say that the map reaches beyond the box. Without such
/// extents a source that is far from the box is most likely in another frame.
bool may_lie_beside(const MapperConfig& config, const Box& flight_box) {
  return config.extents && config.extents->intersects(flight_box);
}

struct Census {
  std::array<std::int64_t, 256> of_class{};
  std::int64_t meant = 0;         ///< points of a class with a meaning
  std::int64_t in_extents = 0;    ///< of these
  std::int64_t near_box = 0;      ///< of these
  std::int64_t unclassified = 0;  ///< points of class 0 or 1 without a meaning, in the extents and near the box
  Box bounds;                     ///< of all that can be used, W
};

Census census_of(const CloudFile& cloud, const ClassMeanings& classes, const MapperConfig& config, const Box& near) {
  Census census;
  for (const LabelledPoint& point : cloud.points) {
    ++census.of_class[point.class_number];
    census.bounds.extend(point.position);
    const bool is_meant = classes[point.class_number].has_value();
    census.meant += is_meant ? 1 : 0;
    if (config.extents && !config.extents->contains(point.position)) continue;
    census.in_extents += is_meant ? 1 : 0;
    if (!near.contains(point.position)) continue;
    census.near_box += is_meant ? 1 : 0;
    census.unclassified += !is_meant && point.class_number <= 1 ? 1 : 0;
  }
  return census;
}

/// "ground (2) 1891 occupied, class_31 (31) 3": the classes with the most points first.
std::string classes_text(const Census& census, const ClassMeanings& classes) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < census.of_class.size(); ++k) {
    if (census.of_class[k] > 0) order.push_back(k);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return census.of_class[a] > census.of_class[b]; });
  std::string text;
  for (std::size_t i = 0; i < std::min(order.size(), kClassesShown); ++i) {
    const auto number = static_cast<std::uint8_t>(order[i]);
    const auto& meaning = classes[number];
    text += fmt::format("{}{} ({}) {}{}", text.empty() ? "" : ", ", meaning ? meaning->name : class_name(number),
                        number, census.of_class[number], meaning ? fmt::format(" {}", to_string(meaning->label)) : "");
  }
  if (order.size() > kClassesShown) text += fmt::format(" and {} more", order.size() - kClassesShown);
  return text.empty() ? "none" : text;
}

std::string left_out_text(const CloudFile& cloud) {
  std::string text;
  const auto add = [&](std::int64_t count, const std::string& why) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, why);
  };
  add(cloud.not_finite, "are not finite");
  const Vec3& far = cloud.first_too_far;
  add(cloud.too_far, fmt::format("lie beyond {:g} m of the world's origin, the first at ({:.10g}, {:.10g}, {:.10g}) in "
                                 "the file",
                                 kMaxCoordinate, far.x(), far.y(), far.z()));
  add(cloud.not_a_class, "have a label that is no class number (0 to 255)");
  return text;
}

std::string box_text(const Box& box) {
  if (box.isEmpty()) return "nowhere";
  return fmt::format("from ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}) m", box.min().x(), box.min().y(),
                     box.min().z(), box.max().x(), box.max().y(), box.max().z());
}

std::string not_near_text(const Census& census) {
  return fmt::format("no point {}: the cloud reaches {}", kNotNear, box_text(census.bounds));
}

/// Why no point marks a voxel, and the keys that may help; "" if one does.
/// @param beside  points beside the flight box mark voxels as well
std::string reason_for_nothing(const CloudFile& cloud, const Census& census, const ClassMeanings& classes,
                               bool beside) {
  if (census.near_box > 0 || (beside && census.in_extents > 0)) return "";
  const std::string properties =
      cloud.properties.empty() ? "" : fmt::format(" (the file's properties: {})", listed(cloud.properties));
  if (cloud.points.empty()) return "no point can be used: check origin, metres_per_unit and `label`" + properties;
  if (census.meant == 0) {
    return fmt::format(
        "no point has a class with a meaning; classes present: {}. Say what the numbers mean by `classes`{}",
        classes_text(census, classes),
        properties.empty() ? "" : ", or which property is the class by `label`" + properties);
  }
  if (census.in_extents == 0) {
    return fmt::format("no point lies inside mapper.extents: the cloud reaches {}: {}", box_text(census.bounds),
                       kCheckFrame);
  }
  return fmt::format("{}: {}; a cloud beside the box needs mapper.extents that contain both", not_near_text(census),
                     kCheckFrame);
}

}  // namespace

std::string warnings_of(const std::vector<MapRemark>& remarks) {
  std::string text;
  for (const MapRemark& remark : remarks) {
    if (remark.is_warning) text += (text.empty() ? "" : "; ") + remark.text;
  }
  return text;
}

void log_remarks(const std::vector<MapRemark>& remarks) {
  for (const MapRemark& remark : remarks) {
    log::write(remark.is_warning ? log::Level::Warning : log::Level::Info, "{}", remark.text);
  }
}

std::vector<MapRemark> report_cloud(const CloudSource& source, const CloudFile& cloud, const ClassMeanings& classes,
                                    const MapperConfig& config, const Box& flight_box) {
  Box near = grown(flight_box, Vec3::Constant(source.point_radius + config.resolution));
  if (!source.fill_below.empty()) near.max().z() = kMaxCoordinate;  // a roof above the box fills the column below it
  const Census census = census_of(cloud, classes, config, near);
  const auto total =
      static_cast<std::int64_t>(cloud.points.size()) + cloud.not_finite + cloud.too_far + cloud.not_a_class;
  const std::string left_out = left_out_text(cloud);
  const bool beside = may_lie_beside(config, flight_box);
  if (const std::string why = reason_for_nothing(cloud, census, classes, beside); !why.empty()) {
    throw source.section.error("file", fmt::format("{}: {} points{}, but none marks a voxel: {}", source.file, total,
                                                   left_out.empty() ? "" : fmt::format(" ({})", left_out), why));
  }
  std::vector<MapRemark> remarks{{fmt::format("{}: {} points, {} of them used: {}", source.file, total,
                                              census.in_extents, classes_text(census, classes))}};
  if (!left_out.empty()) {
    remarks.push_back({fmt::format("{}: of {} points {}; they are left out", source.file, total, left_out), true});
  }
  if (!cloud.warning.empty()) remarks.push_back({fmt::format("{}: {}", source.file, cloud.warning), true});
  if (census.in_extents < census.meant) {
    remarks.push_back({fmt::format("{}: {} of {} points lie outside mapper.extents and are left out", source.file,
                                   census.meant - census.in_extents, census.meant)});
  }
  if (census.near_box == 0) {
    remarks.push_back(
        {fmt::format("{}: {}; if it should be there, {}", source.file, not_near_text(census), kCheckFrame), true});
  }
  if (census.unclassified > 0) {
    remarks.push_back(
        {fmt::format("{}: {} points in or near uav.flight_box have class 0 or 1, to which no meaning is given, "
                     "and leave no mark: `classes: {{0: occupied, 1: occupied}}` makes them obstacles",
                     source.file, census.unclassified),
         true});
  }
  if (cloud.spacing > kMaxSpacingShare * config.resolution) {
    remarks.push_back(
        {fmt::format("{}: its float32 coordinates are exact to {:.2g} m, and voxels have {:g} m: walls may "
                     "get holes; write the file with double coordinates or near its origin",
                     source.file, cloud.spacing, config.resolution),
         true});
  }
  return remarks;
}

std::vector<MapRemark> report_octomap(const CloudSource& source, const OctoMapFile& octomap, const MapperConfig& config,
                                      const Box& flight_box) {
  const Box near = grown(flight_box, Vec3::Constant(config.resolution));
  std::int64_t occupied = 0;
  std::int64_t in_extents = 0;
  std::int64_t near_box = 0;  // of these
  Box bounds;
  for (const OctoLeaf& leaf : octomap.leaves) {
    const Box box = octomap.box(leaf);
    occupied += leaf.is_occupied ? 1 : 0;
    bounds.extend(box);
    if (config.extents && !config.extents->intersects(box)) continue;
    ++in_extents;
    near_box += near.intersects(box) ? 1 : 0;
  }
  const std::string counts =
      fmt::format("{}: {} cubes of space, {} occupied and {} free, {}", source.file, octomap.leaves.size(), occupied,
                  std::ssize(octomap.leaves) - occupied, box_text(bounds));
  if (near_box == 0 && (in_extents == 0 || !may_lie_beside(config, flight_box))) {
    throw source.section.error("file", fmt::format("{}; none {}{}: {}", counts, kNotNear,
                                                   config.extents ? " and inside mapper.extents" : "", kCheckFrame));
  }
  std::vector<MapRemark> remarks{{counts}};
  if (near_box == 0) {
    remarks.push_back(
        {fmt::format("{}: no cube {}; if some should be there, {}", source.file, kNotNear, kCheckFrame), true});
  }
  if (octomap.too_far > 0) {
    remarks.push_back({fmt::format("{}: {} cubes lie beyond {:g} m of the world's origin and are left out", source.file,
                                   octomap.too_far, kMaxCoordinate),
                       true});
  }
  if (config.resolution > octomap.resolution * (1.0 + 1e-6)) {
    remarks.push_back(
        {fmt::format("{}: its voxels have {:g} m, the map's {:g} m: what is occupied grows by up to that. "
                     "`mapper.resolution_m: {:g}` keeps its shape",
                     source.file, octomap.resolution, config.resolution, octomap.resolution)});
  }
  return remarks;
}

}  // namespace tern
