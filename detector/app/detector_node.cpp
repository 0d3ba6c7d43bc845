#include "detector/app/detector_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/world/box_cover.h"
#include "messages/channels.h"
#include "messages/codec.h"
#include "perception/from_scan.h"
#include "runtime/log.h"

namespace tern {
namespace {

/// The occupied voxels that a sensor can see. A fence is none: it is occupied as far as it forbids.
std::vector<Box> surfaces_of(const VoxelMap& map) {
  const auto fence = std::ranges::find(map.class_names, "fence") - map.class_names.begin();
  std::vector<bool> surface(map.labels.size());
  for (std::size_t i = 0; i < surface.size(); ++i) {
    surface[i] = map.labels[i] == VoxelLabel::Occupied && map.classes[i] != fence;
  }
  return cover_with_boxes(map.grid, std::move(surface));
}

}  // namespace

DetectorNode::DetectorNode(Bus& bus, const DetectorConfig& config) : bus_(bus), config_(config) {
  bus_.subscribe(channels::kDepthImage, [this](const DepthImage& part) {
    if (images_.add(part, bus_.clock().now())) return;
    bus_.count_late(channels::kDepthImage);
    refused(channels::kDepthImage.name);
  });
  bus_.subscribe(channels::kPointCloud, [this](const CloudScan& part) {
    if (clouds_.add(part, bus_.clock().now())) return;
    bus_.count_late(channels::kPointCloud);
    refused(channels::kPointCloud.name);
  });
  bus_.subscribe(channels::kSemanticMap, [this](const MapChunk& chunk) { on_map(chunk); });
}

void DetectorNode::on_map(const MapChunk& chunk) {
  const Result<bool> complete = map_.add(chunk);
  if (!complete) return log::error("map {:016x}: {}", chunk.version, complete.error().message);
  if (*complete) occupied_ = surfaces_of(map_.take());
}

void DetectorNode::refused(const char* channel) {
  note(fmt::format("{} is refused: more than {} sensors send it, or a measurement has more than {} values", channel,
                   ScanParts<DepthImage>::kMaxSensors, ScanParts<DepthImage>::kMaxValues));
}

UTime DetectorNode::next_wakeup() const {
  if (images_.any_ready() || clouds_.any_ready()) return UTime{0};
  return std::min(images_.next_complete().value_or(kNever), clouds_.next_complete().value_or(kNever));
}

void DetectorNode::step(UTime now) {
  for (const auto& image : images_.take(now)) detect(image);
  for (const auto& cloud : clouds_.take(now)) detect(cloud);
  const std::int64_t left_out = images_.left_out() + clouds_.left_out();
  if (std::exchange(left_out_, left_out) != left_out) left_out_at_ = now;
}

template <class M>
bool DetectorNode::is_frozen(const std::vector<M>& parts) {
  MeasuredDepths measured;
  for (const M& part : parts) measured.add(part);
  const std::int32_t sensor = parts.front().sensor_id;
  if (!frozen_.is_frozen(sensor, std::move(measured))) return false;
  note(fmt::format("sensor {} is frozen: the same depths from another place", sensor));
  return true;
}

void DetectorNode::detect(const ScanParts<DepthImage>::Whole& image) {
  const DepthImage& first = image.parts.front();
  last_scan_ = bus_.clock().now();
  const Result<DepthPicture> picture = picture_of(image.parts, image.rows, config_.noise, config_.least_range_m);
  if (picture && is_frozen(image.parts)) return;
  publish(picture, first.at, first.sensor_id);
}

void DetectorNode::detect(const ScanParts<CloudScan>::Whole& cloud) {
  const CloudScan& first = cloud.parts.front();
  last_scan_ = bus_.clock().now();
  const Result<DepthPicture> picture = picture_of(cloud.parts, config_.cloud_noise, config_.least_range_m);
  if (picture && is_frozen(cloud.parts)) return;
  publish(picture, first.at, first.sensor_id);
}

void DetectorNode::publish(const Result<DepthPicture>& picture, UTime at, std::int32_t sensor) {
  if (!picture) return note(picture.error().message);
  KnownSurroundings known;
  known.boxes = occupied_;
  if (config_.ground) known.ground_z = config_.ground_z;
  bus_.publish(channels::kObstacleSightings, frame_of(*picture, detector_.detect(*picture, known), at, sensor));
}

void DetectorNode::note(std::string trouble) {
  if (trouble != trouble_) log::warn("{}", trouble);
  trouble_ = std::move(trouble);
  trouble_at_ = bus_.clock().now();
}

NodeHealth DetectorNode::health() const {
  const UTime now = bus_.clock().now();
  const bool troubled = trouble_at_ && now - *trouble_at_ <= kTroubleShown;
  if (!last_scan_ || now - *last_scan_ > kSilence) {
    return {ProcessState::Waiting, "a scan on DEPTH_IMAGE or POINT_CLOUD"};
  }
  if (troubled) return {ProcessState::Waiting, trouble_};
  if (left_out_at_ && now - *left_out_at_ <= kTroubleShown) {
    return {ProcessState::Ready, fmt::format("left out {} scans: they come faster than they are handled", left_out_)};
  }
  return {ProcessState::Ready, ""};
}

}  // namespace tern
