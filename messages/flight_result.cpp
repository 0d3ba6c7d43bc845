#include <cmath>

#include "messages/codec.h"
#include "messages/fields.h"
#include "messages/wire.h"
#include "tern_msgs/flight_result_t.hpp"

namespace tern {
namespace {

using Message = tern_msgs::flight_result_t;
static_assert(Message::MAX_DETAIL_TEXT == kMaxDetailText);
static_assert(Message::MAX_REGIONS == kMaxExposures);
static_assert(Message::MAX_REGION_TEXT == kMaxRegionText);
static_assert(Message::FAILED == static_cast<int>(FlightOutcome::Failed));

const wire::Layout kLayout{
    wire::Array{&Message::detail_count, &Message::detail, 0, kMaxDetailText},
    wire::Array{&Message::exposure_count, &Message::exposure, 0, kMaxExposures},
    wire::Array{&Message::region_text_count, &Message::region_text, 0, kMaxRegionText},
};
constexpr double kMaxSeconds = 1e9;
constexpr double kMaxPath = 1e9;                         // m
constexpr double kMaxClearance = 10.0 * kMaxCoordinate;  // m

tern_msgs::exposure_t to_lcm(const Exposure& exposure) {
  tern_msgs::exposure_t m{};
  m.name_length = static_cast<std::int32_t>(exposure.region.size());
  m.seconds = exposure.seconds;
  m.metres = exposure.metres;
  m.near_seconds = exposure.near_seconds;
  m.near_metres = exposure.near_metres;
  return m;
}

Message to_lcm(const FlightResult& result) {
  Message m{};
  m.header = wire::to_lcm(result.header);
  m.outcome = wire::to_int8(result.outcome);
  m.flight_time = result.flight_time_s;
  m.first_entry = result.first_entry_s;
  m.path_length = result.path_length_m;
  m.mean_speed = result.mean_speed_mps;
  m.top_speed = result.top_speed_mps;
  m.min_clearance = result.min_clearance_m;
  m.min_map_clearance = result.min_map_clearance_m;
  m.jerk_integral = result.jerk_integral;
  m.stops = result.stops;
  m.limit_violations = result.limit_violations;
  m.contacts_moving = result.contacts_moving;
  m.contacts_at_rest = result.contacts_at_rest;
  m.obstacles = result.obstacles;
  m.obstacles_left_out = result.obstacles_left_out;
  m.detail = wire::to_lcm(result.detail);
  for (const Exposure& exposure : result.exposure) {
    m.exposure.push_back(to_lcm(exposure));
    wire::append(m.region_text, exposure.region);
  }
  return m;
}

Exposure read_exposure(wire::FieldReader& read, const tern_msgs::exposure_t& m, wire::Slices<std::uint8_t>& names) {
  const auto n = static_cast<std::size_t>(read.integer(m.name_length, 0, kMaxRegionText));
  return {read.text(names.take(n)), read.number(m.seconds, 0.0, kMaxSeconds), read.number(m.metres, 0.0, kMaxPath),
          read.number(m.near_seconds, 0.0, kMaxSeconds), read.number(m.near_metres, 0.0, kMaxPath)};
}

tl::expected<FlightResult, Rejection> from_lcm(const Message& m) {
  wire::FieldReader read;
  const auto measure = [&](double x, double low, double high) { return std::isnan(x) ? x : read.number(x, low, high); };
  FlightResult result;
  result.header = read.header(m.header);
  result.outcome = read.enumeration(m.outcome, FlightOutcome::Failed);
  result.detail = read.text(m.detail);
  result.flight_time_s = measure(m.flight_time, 0.0, kMaxSeconds);
  result.first_entry_s = measure(m.first_entry, 0.0, kMaxSeconds);
  result.path_length_m = measure(m.path_length, 0.0, kMaxPath);
  result.mean_speed_mps = measure(m.mean_speed, 0.0, kMaxSpeed);
  result.top_speed_mps = measure(m.top_speed, 0.0, kMaxSpeed);
  result.min_clearance_m = measure(m.min_clearance, -kMaxClearance, kMaxClearance);
  result.min_map_clearance_m = measure(m.min_map_clearance, -kMaxClearance, kMaxClearance);
  result.jerk_integral = measure(m.jerk_integral, 0.0, wire::kMaxNumber);
  result.stops = read.counter(m.stops);
  result.limit_violations = read.counter(m.limit_violations);
  result.contacts_moving = read.counter(m.contacts_moving);
  result.contacts_at_rest = read.counter(m.contacts_at_rest);
  result.obstacles = read.counter(m.obstacles);
  result.obstacles_left_out = read.counter(m.obstacles_left_out);
  wire::Slices names(m.region_text);
  for (const tern_msgs::exposure_t& exposure : m.exposure)
    result.exposure.push_back(read_exposure(read, exposure, names));
  read.consistent(names.complete());
  return read.accept(std::move(result));
}

}  // namespace

template <>
Bytes encode(const FlightResult& value) {
  return wire::encode(to_lcm(value), kLayout);
}

template <>
tl::expected<FlightResult, Rejection> decode(std::span<const std::uint8_t> bytes) {
  return wire::decode(bytes, kLayout, from_lcm);
}

}  // namespace tern
