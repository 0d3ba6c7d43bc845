#include "messages/form.h"
#include "tern_msgs/observation_set_t.hpp"

namespace tern {

template <>
struct wire::Form<ObservationSet> {
  using Message = tern_msgs::observation_set_t;
  static_assert(Message::MAX_DETECTIONS == kMaxDetections);
  static constexpr Layout kLayout{
      Array{&Message::detection_count, &Message::detections, 0, kMaxDetections},
  };
  static constexpr double kMaxVariance = kMaxCoordinate * kMaxCoordinate;  // m²

  static void fields(auto& io, auto& m, auto& set) {
    io.header("header", m.header, set.header);
    io.time("at_us", m.at_us, set.at);
    io.integer("sensor_id", m.sensor_id, set.sensor_id, 0, std::numeric_limits<std::int32_t>::max());
    io.number("range", m.range, set.range_m, 0.0, kMaxCoordinate);
    io.position("sensor_position", m.sensor_position, set.sensor_position);
    // A detection at no place is no obstacle. One at a place with a wrong size or variance is: without it, the vehicle
    // would fly through what is there, so the whole set is refused.
    io.list_of_placed("detections", m.detections, set.detections, [&io](auto& d, auto& detection) {
      io.position("position", d.position, detection.position);
      io.extents("half_extents", d.half_extents, detection.half_extents);
      io.vec3("variance", d.variance, detection.variance, 0.0, kMaxVariance);
      io.integer("track_id", d.track_id, detection.track_id, kNoTrackId, kMaxCounter);
    });
  }

  static void read_rest(FieldReader& read, const Message&, ObservationSet& set) {
    std::vector<std::int64_t> ids;
    for (const Detection& d : set.detections) {
      if (d.track_id != kNoTrackId) ids.push_back(d.track_id);
    }
    read.all_different(std::move(ids), "two detections have the track_id");
  }
};

template Bytes encode(const ObservationSet& value);
template tl::expected<ObservationSet, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<ObservationSet>(std::span<const std::uint8_t> bytes);
template std::int32_t left_out_elements<ObservationSet>(std::span<const std::uint8_t> bytes);

}  // namespace tern
