#include <cmath>

#include "messages/form.h"
#include "tern_msgs/flight_result_t.hpp"

namespace tern {

template <>
struct wire::Form<FlightResult> {
  using Message = tern_msgs::flight_result_t;
  static_assert(Message::MAX_DETAIL_TEXT == kMaxDetailText);
  static_assert(Message::MAX_REGIONS == kMaxExposures);
  static_assert(Message::MAX_REGION_TEXT == kMaxRegionText);
  static_assert(Message::FAILED == static_cast<int>(FlightOutcome::Failed));
  static constexpr Layout kLayout{
      Array{&Message::detail_count, &Message::detail, 0, kMaxDetailText},
      Array{&Message::exposure_count, &Message::exposure, 0, kMaxExposures},
      Array{&Message::region_text_count, &Message::region_text, 0, kMaxRegionText},
  };
  static constexpr double kMaxSeconds = 1e9;
  static constexpr double kMaxPath = 1e9;                         // m
  static constexpr double kMaxClearance = 10.0 * kMaxCoordinate;  // m

  static void fields(auto& io, auto& m, auto& result) {
    const auto measure = [&io](const char* name, auto& field, auto& x, double low, double high) {
      std::isnan(field) ? io.any(name, field, x) : io.number(name, field, x, low, high);
    };
    io.header("header", m.header, result.header);
    io.enumeration("outcome", m.outcome, result.outcome, FlightOutcome::Failed);
    io.text("detail", m.detail, result.detail);
    measure("flight_time", m.flight_time, result.flight_time_s, 0.0, kMaxSeconds);
    measure("first_entry", m.first_entry, result.first_entry_s, 0.0, kMaxSeconds);
    measure("path_length", m.path_length, result.path_length_m, 0.0, kMaxPath);
    measure("mean_speed", m.mean_speed, result.mean_speed_mps, 0.0, kMaxSpeed);
    measure("top_speed", m.top_speed, result.top_speed_mps, 0.0, kMaxSpeed);
    measure("min_clearance", m.min_clearance, result.min_clearance_m, -kMaxClearance, kMaxClearance);
    measure("min_map_clearance", m.min_map_clearance, result.min_map_clearance_m, -kMaxClearance, kMaxClearance);
    measure("jerk_integral", m.jerk_integral, result.jerk_integral, 0.0, kMaxNumber);
    io.counter("stops", m.stops, result.stops);
    io.counter("limit_violations", m.limit_violations, result.limit_violations);
    io.counter("contacts_moving", m.contacts_moving, result.contacts_moving);
    io.counter("contacts_at_rest", m.contacts_at_rest, result.contacts_at_rest);
    io.counter("obstacles", m.obstacles, result.obstacles);
    io.counter("obstacles_left_out", m.obstacles_left_out, result.obstacles_left_out);
    io.list("exposure", m.exposure, result.exposure, [&io](auto& e, auto& exposure) {
      io.number("seconds", e.seconds, exposure.seconds, 0.0, kMaxSeconds);
      io.number("metres", e.metres, exposure.metres, 0.0, kMaxPath);
      io.number("near_seconds", e.near_seconds, exposure.near_seconds, 0.0, kMaxSeconds);
      io.number("near_metres", e.near_metres, exposure.near_metres, 0.0, kMaxPath);
    });
  }

  static void write_rest(Message& m, const FlightResult& result) {
    for (std::size_t k = 0; k < result.exposure.size(); ++k) {
      m.exposure[k].name_length = static_cast<std::int32_t>(result.exposure[k].region.size());
      append(m.region_text, result.exposure[k].region);
    }
  }

  static void read_rest(FieldReader& read, const Message& m, FlightResult& result) {
    Slices names(m.region_text);
    for (std::size_t k = 0; k < result.exposure.size(); ++k) {
      const auto length = static_cast<std::size_t>(read.integer(m.exposure[k].name_length, 0, kMaxRegionText));
      result.exposure[k].region = read.text(names.take(length));
    }
    read.consistent(names.complete());
  }
};

template Bytes encode(const FlightResult& value);
template tl::expected<FlightResult, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<FlightResult>(std::span<const std::uint8_t> bytes);

}  // namespace tern
