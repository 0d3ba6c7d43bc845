#include "messages/codec.h"
#include "messages/fields.h"
#include "messages/wire.h"
#include "tern_msgs/observation_set_t.hpp"

namespace tern {
namespace {

using Message = tern_msgs::observation_set_t;
static_assert(Message::MAX_DETECTIONS == kMaxDetections);

const wire::Layout kLayout{
    wire::Array{&Message::detection_count, &Message::detections, 0, kMaxDetections},
};
constexpr double kMaxVariance = kMaxCoordinate * kMaxCoordinate;  // m²

tern_msgs::detection_t to_lcm(const Detection& detection) {
  tern_msgs::detection_t m{};
  m.position = wire::to_lcm(detection.position);
  m.half_extents = wire::to_lcm(detection.half_extents);
  m.variance = wire::to_lcm(detection.variance);
  m.track_id = detection.track_id;
  return m;
}

Message to_lcm(const ObservationSet& set) {
  Message m{};
  m.header = wire::to_lcm(set.header);
  m.at_us = set.at.us;
  m.sensor_id = set.sensor_id;
  m.range = set.range_m;
  m.sensor_position = wire::to_lcm(set.sensor_position);
  for (const Detection& detection : set.detections) m.detections.push_back(to_lcm(detection));
  return m;
}

bool ids_differ(const std::vector<Detection>& detections) {
  std::vector<std::int64_t> ids;
  for (const Detection& d : detections) {
    if (d.track_id != kNoTrackId) ids.push_back(d.track_id);
  }
  return wire::all_different(std::move(ids));
}

tl::expected<ObservationSet, Rejection> from_lcm(const Message& m) {
  wire::FieldReader read;
  ObservationSet set;
  set.header = read.header(m.header);
  set.at = read.time(m.at_us);
  set.sensor_id = read.integer(m.sensor_id, 0, std::numeric_limits<std::int32_t>::max());
  set.range_m = read.number(m.range, 0.0, kMaxCoordinate);
  set.sensor_position = read.position(m.sensor_position);
  set.detections.reserve(m.detections.size());
  for (const tern_msgs::detection_t& d : m.detections) {
    set.detections.push_back({read.position(d.position), read.extents(d.half_extents),
                              read.vec3(d.variance, 0.0, kMaxVariance),
                              read.integer(d.track_id, kNoTrackId, wire::kMaxCounter)});
  }
  read.consistent(ids_differ(set.detections));
  return read.accept(std::move(set));
}

}  // namespace

template <>
Bytes encode(const ObservationSet& value) {
  return wire::encode(to_lcm(value), kLayout);
}

template <>
tl::expected<ObservationSet, Rejection> decode(std::span<const std::uint8_t> bytes) {
  return wire::decode(bytes, kLayout, from_lcm);
}

}  // namespace tern
