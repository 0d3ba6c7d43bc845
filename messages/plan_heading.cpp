#include "core/world/plan_heading.h"

#include "messages/form.h"
#include "tern_msgs/plan_heading_t.hpp"

namespace tern {

template <>
struct wire::Form<PlanHeading> {
  using Message = tern_msgs::plan_heading_t;
  static_assert(Message::MIN_CONTROL_POINTS == kMinControlPoints && Message::MAX_CONTROL_POINTS == kMaxControlPoints);
  static constexpr Layout kLayout{
      Array{&Message::control_point_count, &Message::control_points, kMinControlPoints, kMaxControlPoints},
  };
  static constexpr double kMaxAngle = 1e6;  // rad, rad/s, rad/s²

  static void fields(auto& io, auto& m, auto& heading) {
    io.header("header", m.header, heading.header);
    io.integer("request_id", m.request_id, heading.request_id, 1, kMaxCounter);
    io.name("request", m.request, heading.request);
    io.time("start_us", m.start_us, heading.start);
    io.duration("interval_us", m.interval_us, heading.interval, kMinIntervalDuration, kMaxIntervalDuration);
    io.number("rate_max", m.rate_max, heading.rate_max, kAboveZero, kMaxAngle);
    io.number("acceleration_max", m.acceleration_max, heading.acceleration_max, kAboveZero, kMaxAngle);
    io.number("path_term", m.path_term, heading.path_term, -kMaxNumber, kMaxNumber);
    io.number("track_term", m.track_term, heading.track_term, -kMaxNumber, kMaxNumber);
    io.number("unseen_term", m.unseen_term, heading.unseen_term, -kMaxNumber, kMaxNumber);
    io.number("texture_term", m.texture_term, heading.texture_term, -kMaxNumber, kMaxNumber);
    io.list("control_points", m.control_points, heading.control_points,
            [&io](auto& point, auto& yaw) { io.number("yaw", point, yaw, -kMaxAngle, kMaxAngle); });
  }
};

template Bytes encode(const PlanHeading& value);
template tl::expected<PlanHeading, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<PlanHeading>(std::span<const std::uint8_t> bytes);

}  // namespace tern
