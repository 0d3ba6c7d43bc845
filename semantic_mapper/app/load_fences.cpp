#include "semantic_mapper/app/load_fences.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "core/base/files.h"
#include "runtime/polygon.h"
#include "semantic_mapper/sources/fence_file.h"

namespace tern {
namespace {

/// Converts fences to W. The frame is made only if a fence needs it.
class FencesInWorld {
 public:
  explicit FencesInWorld(const Scenario& scenario) : scenario_(scenario) {}

  void add(Fence fence, const std::string& where) {
    if (fence.is_geodetic) fence = value_or_throw(to_world(std::move(fence), frame(where)), where + ": ");
    const auto* polygon = std::get_if<FencePolygon>(&fence.shape);
    if (polygon != nullptr && !is_simple_polygon(polygon->corners)) {
      throw ConfigError(where + ": the polygon touches or crosses itself");
    }
    fences_.push_back(std::move(fence));
  }
  [[nodiscard]] std::vector<Fence> take() { return std::move(fences_); }

 private:
  const LocalFrame& frame(const std::string& where) {
    if (!scenario_.world.origin) throw ConfigError(where + ": latitude and longitude need world.origin");
    if (!frame_) frame_ = value_or_throw(LocalFrame::at(*scenario_.world.origin), where + ": ");
    return *frame_;
  }

  const Scenario& scenario_;
  std::optional<LocalFrame> frame_;
  std::vector<Fence> fences_;
};

std::vector<Fence> read_file(const Scenario& scenario, const std::string& key, const std::string& file) {
  const std::filesystem::path path = std::filesystem::path(scenario.file).parent_path() / file;
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) throw ConfigError(fmt::format("{}: {}: {}", key, path.string(), error.message()));
  if (size > kMaxFenceBytes) {
    throw ConfigError(fmt::format("{}: {} has {} bytes (limit {})", key, path.string(), size, kMaxFenceBytes));
  }
  return value_or_throw(parse_fences(read_text(path.string()), path.string()), key + ": ");
}

bool may_hold_fences(const std::string& file) { return !file.empty() && !file.ends_with(".csv"); }

}  // namespace

std::vector<Fence> load_fences(const Scenario& scenario, const MapperConfig& config, std::vector<MapRemark>& remarks) {
  FencesInWorld fences(scenario);
  for (const Fence& fence : scenario.world.fences) {
    fences.add(fence, fmt::format("{}: world.fences: fence \"{}\"", scenario.file, fence.name));
  }
  for (const FenceFile& from : scenario.world.fence_files) {
    const std::vector<Fence> read = read_file(scenario, "world.fences", from.file);
    if (read.empty()) throw ConfigError(fmt::format("world.fences: {} has no fence", from.file));
    for (Fence fence : read) {
      if (!std::isfinite(fence.floor)) fence.floor = from.floor;
      if (!std::isfinite(fence.ceiling)) fence.ceiling = from.ceiling;
      fences.add(fence, fmt::format("{}: fence {}", from.file, fence.name));
    }
  }
  if (may_hold_fences(config.mission_file)) {
    for (const Fence& fence : read_file(scenario, "mission.file", config.mission_file)) {
      fences.add(fence, fmt::format("{}: fence {}", config.mission_file, fence.name));
    }
  }
  std::vector<Fence> all = fences.take();
  if (!all.empty())
    remarks.push_back({fmt::format("{} fences are in force; their voxels are of class fence", all.size())});
  return all;
}

}  // namespace tern
