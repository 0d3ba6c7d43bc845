#include <numbers>

#include "messages/form.h"
#include "tern_msgs/uav_state_t.hpp"

namespace tern {

template <>
struct wire::Form<UavState> {
  using Message = tern_msgs::uav_state_t;
  static constexpr Layout<Message> kLayout{};

  static void fields(auto& io, auto& m, auto& state) {
    io.header("header", m.header, state.header);
    io.time("at_us", m.at_us, state.at);
    io.motion("motion", m.motion, state.motion);
    // −π is accepted: atan2(−0, −1) returns it, and it is the same yaw as π.
    io.number("yaw", m.yaw, state.yaw, -std::numbers::pi, std::numbers::pi);
  }
};

template Bytes encode(const UavState& value);
template tl::expected<UavState, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<UavState>(std::span<const std::uint8_t> bytes);

}  // namespace tern
