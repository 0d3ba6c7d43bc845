#include "messages/codec.h"
#include "messages/fields.h"
#include "messages/wire.h"
#include "tern_msgs/vehicle_status_t.hpp"

namespace tern {
namespace {

using Message = tern_msgs::vehicle_status_t;
static_assert(Message::MAX_MODE_TEXT == kMaxModeText);
static_assert(Message::MAX_WHY_TEXT == kMaxWhyText);
static_assert(Message::LOST == static_cast<int>(EstimatorHealth::Lost));

constexpr double kUnknown = -1.0;

const wire::Layout kLayout{
    wire::Array{&Message::mode_count, &Message::mode, 0, kMaxModeText},
    wire::Array{&Message::why_count, &Message::why_not, 0, kMaxWhyText},
};

Message to_lcm(const VehicleStatus& status) {
  Message m{};
  m.header = wire::to_lcm(status.header);
  m.at_us = status.at.us;
  m.armed = wire::to_int8(status.armed);
  m.following = wire::to_int8(status.following);
  m.landed = wire::to_int8(status.landed);
  m.battery = status.battery.value_or(kUnknown);
  m.estimator = wire::to_int8(status.estimator);
  m.position_sigma = wire::to_lcm(status.position_sigma);
  m.resets = status.resets;
  m.mode = wire::to_lcm(status.mode);
  m.why_not = wire::to_lcm(status.why_not);
  return m;
}

tl::expected<VehicleStatus, Rejection> from_lcm(const Message& m) {
  wire::FieldReader read;
  VehicleStatus status;
  status.header = read.header(m.header);
  status.at = read.time(m.at_us);
  status.armed = read.flag(m.armed);
  status.following = read.flag(m.following);
  status.landed = read.flag(m.landed);
  if (m.battery != kUnknown) status.battery = read.number(m.battery, 0.0, 1.0);
  status.estimator = read.enumeration(m.estimator, EstimatorHealth::Lost);
  status.position_sigma = read.extents(m.position_sigma);
  status.resets = read.counter(m.resets);
  status.mode = read.text(m.mode);
  status.why_not = read.text(m.why_not);
  read.consistent(!status.following || status.armed);
  read.consistent(status.following == status.why_not.empty());
  return read.accept(std::move(status));
}

}  // namespace

template <>
Bytes encode(const VehicleStatus& value) {
  return wire::encode(to_lcm(value), kLayout);
}

template <>
tl::expected<VehicleStatus, Rejection> decode(std::span<const std::uint8_t> bytes) {
  return wire::decode(bytes, kLayout, from_lcm);
}

}  // namespace tern
