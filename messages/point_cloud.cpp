#include "messages/form.h"
#include "tern_msgs/point_cloud_t.hpp"

namespace tern {

template <>
struct wire::Form<CloudScan> {
  using Message = tern_msgs::point_cloud_t;
  static_assert(Message::MAX_POINTS == kMaxCloudPointsPerMessage);
  static constexpr Layout kLayout{
      Array{&Message::point_count, &Message::points, 0, kMaxCloudPointsPerMessage},
  };

  static void fields(auto& io, auto& m, auto& scan) {
    io.header("header", m.header, scan.header);
    io.time("at_us", m.at_us, scan.at);
    io.integer("sensor_id", m.sensor_id, scan.sensor_id, 0, std::numeric_limits<std::int32_t>::max());
    io.number("range", m.range, scan.range_m, 0.0, kMaxCoordinate);
    io.position("sensor_position", m.sensor_position, scan.sensor_position);
    io.flag("has_classes", m.has_classes, scan.has_classes);
    // Every number is legal: clouds mark pixels without a measurement by NaN.
    io.list("points", m.points, scan.points, [&io](auto& p, auto& point) {
      io.any("x", p.x, point.position.x());
      io.any("y", p.y, point.position.y());
      io.any("z", p.z, point.position.z());
      io.any("class_number", p.class_number, point.class_number);
    });
  }
};

template Bytes encode(const CloudScan& value);
template tl::expected<CloudScan, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<CloudScan>(std::span<const std::uint8_t> bytes);

}  // namespace tern
