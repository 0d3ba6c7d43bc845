#include "messages/form.h"
#include "messages/quaternion_fields.h"
#include "tern_msgs/depth_image_t.hpp"

namespace tern {

template <>
struct wire::Form<DepthImage> {
  using Message = tern_msgs::depth_image_t;
  static_assert(Message::MAX_DEPTHS == kMaxDepthsPerMessage);
  static constexpr Layout kLayout{
      Array{&Message::depth_count, &Message::depths, 0, kMaxDepthsPerMessage},
  };
  static constexpr double kMaxUnit = 1e3;  // m
  static constexpr std::int32_t kMaxRow = 1'000'000;

  static void fields(auto& io, auto& m, auto& image) {
    io.header("header", m.header, image.header);
    io.time("at_us", m.at_us, image.at);
    io.integer("sensor_id", m.sensor_id, image.sensor_id, 0, std::numeric_limits<std::int32_t>::max());
    io.number("range", m.range, image.range_m, 0.0, kMaxCoordinate);
    io.position("sensor_position", m.sensor_position, image.sensor_position);
    quaternion_fields(io, m, image.q_WC);
    io.number("fx", m.fx, image.fx, kAboveZero, kMaxCoordinate);
    io.number("fy", m.fy, image.fy, kAboveZero, kMaxCoordinate);
    io.number("cx", m.cx, image.cx, -kMaxCoordinate, kMaxCoordinate);
    io.number("cy", m.cy, image.cy, -kMaxCoordinate, kMaxCoordinate);
    io.number("unit", m.unit, image.unit_m, kAboveZero, kMaxUnit);
    io.integer("width", m.width, image.width, 1, kMaxDepthsPerMessage);
    io.integer("first_row", m.first_row, image.first_row, 0, kMaxRow);
    io.any("depths", m.depths, image.depths);
  }

  static void read_rest(FieldReader& read, const Message&, DepthImage& image) {
    read.consistent(is_unit(image.q_WC), "the quaternion has not the length 1");
    read.consistent(std::ssize(image.depths) % image.width == 0, "the last row is not complete");
  }
};

template Bytes encode(const DepthImage& value);
template tl::expected<DepthImage, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<DepthImage>(std::span<const std::uint8_t> bytes);

}  // namespace tern
