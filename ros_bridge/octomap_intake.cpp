#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/wire/message_limits.h"
#include "ros_bridge/intake.h"

namespace tern::ros {
namespace {

/// The largest turn of an OctoMap's frame against W, rad.
constexpr double kMaxTurn = 1e-3;
constexpr std::size_t kMaxBytes = std::size_t{kMaxMapFileParts} * kMaxMapFileBytesPerMessage;

tl::unexpected<Refusal> refuse(std::string why) { return tl::unexpected(Refusal{std::move(why), false}); }

/// The header of the file that holds the octree.
std::string header_of(const ros::Octomap& octomap) {
  return fmt::format("# Octomap OcTree {}file\nid {}\nsize {}\nres {}\ndata\n", octomap.binary ? "binary " : "",
                     octomap.id, octomap.data.empty() ? 0 : 1, octomap.resolution);
}

}  // namespace

Taken<std::vector<MapFile>> read(const ros::Octomap& octomap, const IntakeContext& context) {
  if (octomap.id != "OcTree" && octomap.id != "ColorOcTree") {
    return refuse(fmt::format("a tree of the kind \"{:.40}\": OcTree and ColorOcTree are read", octomap.id));
  }
  if (!(octomap.resolution > 0.0 && octomap.resolution <= kMaxCoordinate)) {
    return refuse(fmt::format("its resolution of {} m is not in (0, {:g}]", octomap.resolution, kMaxCoordinate));
  }
  const auto T_WF = pose_of(octomap.header.frame_id, std::nullopt, context);
  if (!T_WF) return tl::unexpected(T_WF.error());
  const double turn = T_WF->q.angularDistance(Eigen::Quaterniond::Identity());
  if (turn > kMaxTurn) {
    return refuse(
        fmt::format("its frame {:.40} is turned by {:.3f} rad against {}; an octree cannot be turned, so "
                    "build it in a frame with the axes of {}",
                    octomap.header.frame_id, turn, context.world_frame, context.world_frame));
  }
  if (!(T_WF->p.cwiseAbs().maxCoeff() <= kMaxCoordinate)) return refuse("its frame is too far away");
  std::string header = header_of(octomap);
  if (header.size() + octomap.data.size() > kMaxBytes) {
    return refuse(fmt::format("{} bytes (limit {}): send octomap_binary, or a coarser resolution", octomap.data.size(),
                              kMaxBytes));
  }
  std::vector<std::int8_t> file(header.begin(), header.end());
  file.insert(file.end(), octomap.data.begin(), octomap.data.end());
  constexpr auto kPartBytes = static_cast<std::ptrdiff_t>(kMaxMapFileBytesPerMessage);
  std::vector<MapFile> parts;
  for (auto at = file.cbegin(); at != file.cend();) {
    const auto end = at + std::min(kPartBytes, file.cend() - at);
    MapFile part;
    part.at = context.now;
    part.origin = T_WF->p;
    part.part = static_cast<std::int32_t>(parts.size());
    part.bytes.assign(at, end);
    parts.push_back(std::move(part));
    at = end;
  }
  for (MapFile& part : parts) part.parts = static_cast<std::int32_t>(parts.size());
  return parts;
}

}  // namespace tern::ros
