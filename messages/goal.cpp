#include "messages/codec.h"
#include "messages/fields.h"
#include "messages/wire.h"
#include "tern_msgs/goal_t.hpp"

namespace tern {
namespace {

using Message = tern_msgs::goal_t;
static_assert(Message::STOP == static_cast<int>(GoalMode::Stop));

const wire::Layout<Message> kLayout;

Message to_lcm(const Goal& goal) {
  Message m{};
  m.header = wire::to_lcm(goal.header);
  m.id = goal.id;
  m.mode = wire::to_int8(goal.mode);
  m.position = wire::to_lcm(goal.position);
  return m;
}

tl::expected<Goal, Rejection> from_lcm(const Message& m) {
  wire::FieldReader read;
  Goal goal;
  goal.header = read.header(m.header);
  goal.id = read.integer<std::int64_t>(m.id, 1, wire::kMaxCounter);
  goal.mode = read.enumeration(m.mode, GoalMode::Stop);
  goal.position = read.position(m.position);
  return read.accept(std::move(goal));
}

}  // namespace

template <>
Bytes encode(const Goal& value) {
  return wire::encode(to_lcm(value), kLayout);
}

template <>
tl::expected<Goal, Rejection> decode(std::span<const std::uint8_t> bytes) {
  return wire::decode(bytes, kLayout, from_lcm);
}

}  // namespace tern
