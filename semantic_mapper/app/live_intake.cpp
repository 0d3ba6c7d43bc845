#include "semantic_mapper/app/live_intake.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace tern {

Scan scan_of(const DepthImage& image) {
  Scan scan{image.sensor_position, image.range_m, false, {}};
  scan.points.reserve(image.depths.size());
  const Eigen::Quaterniond turn(image.q_WC[0], image.q_WC[1], image.q_WC[2], image.q_WC[3]);
  const Eigen::Matrix3d R_WC = turn.normalized().toRotationMatrix();
  for (std::size_t i = 0; i < image.depths.size(); ++i) {
    if (image.depths[i] <= 0) continue;
    const double z = image.depths[i] * image.unit_m;
    const std::size_t row = idx(image.first_row) + i / idx(image.width);
    const auto u = static_cast<double>(i % idx(image.width));
    const auto v = static_cast<double>(row);
    const Vec3 p_C(z * (u - image.cx) / image.fx, z * (v - image.cy) / image.fy, z);
    const Vec3 p_W = image.sensor_position + R_WC * p_C;
    if (p_W.allFinite()) scan.points.push_back({p_W, 0});
  }
  return scan;
}

Scan scan_of(const CloudScan& cloud) {
  Scan scan{cloud.sensor_position, cloud.range_m, cloud.has_classes, {}};
  scan.points.reserve(cloud.points.size());
  for (const CloudPoint& point : cloud.points) {
    const Vec3 p_W = cloud.sensor_position + point.position.cast<double>();
    if (p_W.allFinite()) scan.points.push_back({p_W, point.class_number});
  }
  return scan;
}

LiveIntake::LiveIntake(Bus& bus) : bus_(bus) {
  bus.subscribe(channels::kPointCloud,
                [this](const CloudScan& cloud) { receive(cloud.sensor_id, cloud.at, scan_of(cloud)); });
  bus.subscribe(channels::kDepthImage,
                [this](const DepthImage& image) { receive(image.sensor_id, image.at, scan_of(image)); });
}

void LiveIntake::receive(std::int32_t sensor, UTime at, Scan part) {
  const auto pending = pending_.find(sensor);
  if (pending == pending_.end() && pending_.size() == kMaxSensors) {
    complete_.push_back(std::move(part));
    return;
  }
  const UTime now = bus_.clock().now();
  if (pending == pending_.end()) {
    pending_.emplace(sensor, Pending{at, now, std::move(part)});
    return;
  }
  Pending& scan = pending->second;
  const bool is_part = scan.at == at && scan.scan.sensor == part.sensor && scan.scan.range == part.range &&
                       scan.scan.has_classes == part.has_classes &&
                       scan.scan.points.size() + part.points.size() <= kMaxScanPoints;
  if (is_part) {
    scan.scan.points.insert(scan.scan.points.end(), part.points.begin(), part.points.end());
    scan.received = now;
  } else {
    complete_.push_back(std::exchange(scan, Pending{at, now, std::move(part)}).scan);
  }
}

int LiveIntake::add_to(LiveMap& map, UTime now) {
  std::erase_if(pending_, [&](auto& entry) {
    if (now - entry.second.received < kScanParts) return false;
    complete_.push_back(std::move(entry.second.scan));
    return true;
  });
  const std::vector<Scan> scans = std::exchange(complete_, {});
  auto first = scans.end();
  for (std::size_t points = 0; first != scans.begin(); --first) {
    points += std::prev(first)->points.size();
    if (first != scans.end() && points > kMaxScanPoints) break;
  }
  left_out_ += first - scans.begin();
  for (auto scan = first; scan != scans.end(); ++scan) map.add(*scan);
  return static_cast<int>(scans.end() - first);
}

UTime LiveIntake::next_complete() const {
  UTime next = kNever;
  for (const auto& [sensor, pending] : pending_) next = std::min(next, pending.received + kScanParts);
  return next;
}

}  // namespace tern
