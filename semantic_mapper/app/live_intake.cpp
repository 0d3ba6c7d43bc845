#include "semantic_mapper/app/live_intake.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "runtime/log.h"

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
  bus.subscribe(channels::kPointCloud, [this](const CloudScan& cloud) { receive(channels::kPointCloud.name, cloud); });
  bus.subscribe(channels::kDepthImage, [this](const DepthImage& image) { receive(channels::kDepthImage.name, image); });
}

template <class M>
void LiveIntake::receive(const std::string& channel, const M& part) {
  const UTime now = bus_.clock().now();
  const std::int32_t sensor = part.sensor_id;
  if (now - part.at > kOldestScan) {
    return note(fmt::format("sensor {}: its {} is {:.0f} s old when it comes, not used; check its clock", sensor,
                            channel, (now - part.at).seconds()));
  }
  Pending given{part.at, now, scan_of(part), {}};
  given.measured.add(part);
  const auto waiting = pending_.find(sensor);
  if (waiting == pending_.end() && pending_.size() == kMaxSensors) return finish(sensor, std::move(given));
  if (waiting == pending_.end()) return void(pending_.emplace(sensor, std::move(given)));
  Pending& before = waiting->second;
  const bool is_part = before.at == given.at && before.scan.sensor == given.scan.sensor &&
                       before.scan.range == given.scan.range && before.scan.has_classes == given.scan.has_classes &&
                       before.scan.points.size() + given.scan.points.size() <= kMaxScanPoints;
  if (!is_part) return finish(sensor, std::exchange(before, std::move(given)));
  before.scan.points.insert(before.scan.points.end(), given.scan.points.begin(), given.scan.points.end());
  before.measured.add(part);
  before.received = now;
}

void LiveIntake::finish(std::int32_t sensor, Pending pending) {
  if (frozen_.is_frozen(sensor, std::move(pending.measured))) {
    return note(fmt::format("sensor {} is frozen: the same depths from another place, not used", sensor));
  }
  complete_.push_back({sensor, std::move(pending.scan)});
}

void LiveIntake::note(std::string trouble) {
  if (this->trouble().empty()) log::warn("{}", trouble);
  trouble_ = std::move(trouble);
  trouble_at_ = bus_.clock().now();
}

std::string LiveIntake::trouble() const {
  return trouble_at_ && bus_.clock().now() - *trouble_at_ < kScanTrouble ? trouble_ : "";
}

int LiveIntake::add_to(LiveMap& map, UTime now) {
  for (auto entry = pending_.begin(); entry != pending_.end();) {
    if (now - entry->second.received < kScanParts) {
      ++entry;
      continue;
    }
    finish(entry->first, std::move(entry->second));
    entry = pending_.erase(entry);
  }
  const std::vector<Complete> scans = std::exchange(complete_, {});
  auto first = scans.end();
  for (std::size_t points = 0; first != scans.begin(); --first) {
    points += std::prev(first)->scan.points.size();
    if (first != scans.end() && points > kMaxScanPoints) break;
  }
  left_out_ += first - scans.begin();
  int used = 0;
  for (auto complete = first; complete != scans.end(); ++complete) {
    if (map.add(complete->scan) > 0) {
      ++used;
      continue;
    }
    note(
        fmt::format("sensor {}: scans without a measured point: a covered lens, or all nearer than "
                    "mapper.live.min_range_m",
                    complete->sensor));
  }
  return used;
}

UTime LiveIntake::next_complete() const {
  UTime next = kNever;
  for (const auto& [sensor, pending] : pending_) next = std::min(next, pending.received + kScanParts);
  return next;
}

}  // namespace tern
