#include <numbers>

#include "messages/codec.h"
#include "messages/fields.h"
#include "messages/wire.h"
#include "tern_msgs/uav_state_t.hpp"

namespace tern {
namespace {

using Message = tern_msgs::uav_state_t;

const wire::Layout<Message> kLayout;

Message to_lcm(const UavState& state) {
  Message m{};
  m.header = wire::to_lcm(state.header);
  m.at_us = state.at.us;
  m.motion = wire::to_lcm(state.motion);
  m.yaw = state.yaw;
  return m;
}

tl::expected<UavState, Rejection> from_lcm(const Message& m) {
  wire::FieldReader read;
  UavState state;
  state.header = read.header(m.header);
  state.at = read.time(m.at_us);
  state.motion = read.motion(m.motion);
  // −π too: atan2(−0, −1) gives it, and it is the same heading.
  state.yaw = read.number(m.yaw, -std::numbers::pi, std::numbers::pi);
  return read.accept(std::move(state));
}

}  // namespace

template <>
Bytes encode(const UavState& value) {
  return wire::encode(to_lcm(value), kLayout);
}

template <>
tl::expected<UavState, Rejection> decode(std::span<const std::uint8_t> bytes) {
  return wire::decode(bytes, kLayout, from_lcm);
}

}  // namespace tern
