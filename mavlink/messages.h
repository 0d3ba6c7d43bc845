// The MAVLink messages that a bridge needs, with their fields in wire order.
// https://mavlink.io/en/messages/common.html
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

#include "mavlink/frame.h"

namespace tern::mavlink {

template <std::size_t N>
using Text = std::array<char, N>;  ///< zero-terminated, unless all N bytes are used

/// Each message has its id, CRC_EXTRA, length without extensions, and its fields.
struct Heartbeat {
  static constexpr std::uint32_t kId = 0;
  static constexpr std::uint8_t kCrcExtra = 50, kMinLength = 9;
  std::uint32_t custom_mode = 0;
  std::uint8_t type = 0, autopilot = 0, base_mode = 0, system_status = 0, mavlink_version = 3;
  static constexpr auto fields(auto& m) {
    return std::tie(m.custom_mode, m.type, m.autopilot, m.base_mode, m.system_status, m.mavlink_version);
  }
};

struct SysStatus {
  static constexpr std::uint32_t kId = 1;
  static constexpr std::uint8_t kCrcExtra = 124, kMinLength = 31;
  std::array<std::uint32_t, 3> sensors{};       ///< present, enabled, healthy
  std::uint16_t load = 0, voltage_battery = 0;  ///< 0.1 %, mV
  std::int16_t current_battery = -1;            ///< 10 mA
  std::array<std::uint16_t, 6> errors{};        ///< drop_rate_comm, errors_comm, errors_count1 … 4
  std::int8_t battery_remaining = -1;           ///< %; −1: unknown
  std::array<std::uint32_t, 3> sensors_extended{};
  static constexpr auto fields(auto& m) {
    return std::tie(m.sensors, m.load, m.voltage_battery, m.current_battery, m.errors, m.battery_remaining,
                    m.sensors_extended);
  }
};

struct ParamRequestRead {
  static constexpr std::uint32_t kId = 20;
  static constexpr std::uint8_t kCrcExtra = 214, kMinLength = 20;
  std::int16_t param_index = -1;  ///< −1: by its name
  std::uint8_t target_system = 0, target_component = 0;
  Text<16> param_id{};
  static constexpr auto fields(auto& m) {
    return std::tie(m.param_index, m.target_system, m.target_component, m.param_id);
  }
};

struct ParamValue {
  static constexpr std::uint32_t kId = 22;
  static constexpr std::uint8_t kCrcExtra = 220, kMinLength = 25;
  float param_value = 0.0F;
  std::uint16_t param_count = 0, param_index = 0;
  Text<16> param_id{};
  std::uint8_t param_type = 0;
  static constexpr auto fields(auto& m) {
    return std::tie(m.param_value, m.param_count, m.param_index, m.param_id, m.param_type);
  }
};

struct ParamSet {
  static constexpr std::uint32_t kId = 23;
  static constexpr std::uint8_t kCrcExtra = 168, kMinLength = 23;
  float param_value = 0.0F;
  std::uint8_t target_system = 0, target_component = 0;
  Text<16> param_id{};
  std::uint8_t param_type = 0;
  static constexpr auto fields(auto& m) {
    return std::tie(m.param_value, m.target_system, m.target_component, m.param_id, m.param_type);
  }
};

struct AttitudeQuaternion {
  static constexpr std::uint32_t kId = 31;
  static constexpr std::uint8_t kCrcExtra = 246, kMinLength = 32;
  std::uint32_t time_boot_ms = 0;
  std::array<float, 4> q{};  ///< w x y z, FRD to NED
  std::array<float, 3> rates{};
  std::array<float, 4> repr_offset_q{};
  static constexpr auto fields(auto& m) { return std::tie(m.time_boot_ms, m.q, m.rates, m.repr_offset_q); }
};

struct LocalPositionNed {
  static constexpr std::uint32_t kId = 32;
  static constexpr std::uint8_t kCrcExtra = 185, kMinLength = 28;
  std::uint32_t time_boot_ms = 0;
  std::array<float, 3> p{}, v{};
  static constexpr auto fields(auto& m) { return std::tie(m.time_boot_ms, m.p, m.v); }
};

struct GlobalPositionInt {
  static constexpr std::uint32_t kId = 33;
  static constexpr std::uint8_t kCrcExtra = 104, kMinLength = 28;
  std::uint32_t time_boot_ms = 0;
  std::int32_t lat = 0, lon = 0, alt = 0, relative_alt = 0;  ///< 1e-7 degrees; mm above sea level, and above home
  std::array<std::int16_t, 3> v{};                           ///< NED, cm/s
  std::uint16_t hdg = 65535;                                 ///< 0.01 degrees; 65535: unknown
  static constexpr auto fields(auto& m) {
    return std::tie(m.time_boot_ms, m.lat, m.lon, m.alt, m.relative_alt, m.v, m.hdg);
  }
};

// The mission protocol: https://mavlink.io/en/services/mission.html. `mission_type`: 0 mission, 1 fence, 2 rally
// points.
struct MissionRequest {
  static constexpr std::uint32_t kId = 40;
  static constexpr std::uint8_t kCrcExtra = 230, kMinLength = 4;
  std::uint16_t seq = 0;
  std::uint8_t target_system = 0, target_component = 0, mission_type = 0;
  static constexpr auto fields(auto& m) { return std::tie(m.seq, m.target_system, m.target_component, m.mission_type); }
};

struct MissionCurrent {
  static constexpr std::uint32_t kId = 42;
  static constexpr std::uint8_t kCrcExtra = 28, kMinLength = 2;
  std::uint16_t seq = 0, total = 0;
  std::uint8_t mission_state = 0, mission_mode = 0;  ///< 1 none there, 2 to be started, 3 active, 4 paused, 5 complete
  std::array<std::uint32_t, 3> ids{};                ///< mission_id, fence_id, rally_points_id
  static constexpr auto fields(auto& m) { return std::tie(m.seq, m.total, m.mission_state, m.mission_mode, m.ids); }
};

struct MissionRequestList {
  static constexpr std::uint32_t kId = 43;
  static constexpr std::uint8_t kCrcExtra = 132, kMinLength = 2;
  std::uint8_t target_system = 0, target_component = 0, mission_type = 0;
  static constexpr auto fields(auto& m) { return std::tie(m.target_system, m.target_component, m.mission_type); }
};

struct MissionCount {
  static constexpr std::uint32_t kId = 44;
  static constexpr std::uint8_t kCrcExtra = 221, kMinLength = 4;
  std::uint16_t count = 0;
  std::uint8_t target_system = 0, target_component = 0, mission_type = 0;
  std::uint32_t opaque_id = 0;
  static constexpr auto fields(auto& m) {
    return std::tie(m.count, m.target_system, m.target_component, m.mission_type, m.opaque_id);
  }
};

struct MissionClearAll {
  static constexpr std::uint32_t kId = 45;
  static constexpr std::uint8_t kCrcExtra = 232, kMinLength = 2;
  std::uint8_t target_system = 0, target_component = 0, mission_type = 0;
  static constexpr auto fields(auto& m) { return std::tie(m.target_system, m.target_component, m.mission_type); }
};

struct MissionItemReached {
  static constexpr std::uint32_t kId = 46;
  static constexpr std::uint8_t kCrcExtra = 11, kMinLength = 2;
  std::uint16_t seq = 0;
  static constexpr auto fields(auto& m) { return std::tie(m.seq); }
};

struct MissionAck {
  static constexpr std::uint32_t kId = 47;
  static constexpr std::uint8_t kCrcExtra = 153, kMinLength = 3;
  std::uint8_t target_system = 0, target_component = 0, type = 0, mission_type = 0;
  std::uint32_t opaque_id = 0;
  static constexpr auto fields(auto& m) {
    return std::tie(m.target_system, m.target_component, m.type, m.mission_type, m.opaque_id);
  }
};

struct MissionRequestInt {
  static constexpr std::uint32_t kId = 51;
  static constexpr std::uint8_t kCrcExtra = 196, kMinLength = 4;
  std::uint16_t seq = 0;
  std::uint8_t target_system = 0, target_component = 0, mission_type = 0;
  static constexpr auto fields(auto& m) { return std::tie(m.seq, m.target_system, m.target_component, m.mission_type); }
};

struct MissionItemInt {
  static constexpr std::uint32_t kId = 73;
  static constexpr std::uint8_t kCrcExtra = 38, kMinLength = 37;
  std::array<float, 4> param{};
  std::int32_t x = 0, y = 0;  ///< 1e-7 degrees; in a local frame 1e-4 m
  float z = 0.0F;             ///< m
  std::uint16_t seq = 0, command = 0;
  std::uint8_t target_system = 0, target_component = 0, frame = 0, current = 0, autocontinue = 0, mission_type = 0;
  static constexpr auto fields(auto& m) {
    return std::tie(m.param, m.x, m.y, m.z, m.seq, m.command, m.target_system, m.target_component, m.frame, m.current,
                    m.autocontinue, m.mission_type);
  }
};

struct GpsGlobalOrigin {
  static constexpr std::uint32_t kId = 49;
  static constexpr std::uint8_t kCrcExtra = 39, kMinLength = 12;
  std::int32_t latitude = 0, longitude = 0, altitude = 0;  ///< 1e-7 degrees, mm
  std::uint64_t time_usec = 0;
  static constexpr auto fields(auto& m) { return std::tie(m.latitude, m.longitude, m.altitude, m.time_usec); }
};

struct CommandLong {
  static constexpr std::uint32_t kId = 76;
  static constexpr std::uint8_t kCrcExtra = 152, kMinLength = 33;
  std::array<float, 7> param{};
  std::uint16_t command = 0;
  std::uint8_t target_system = 0, target_component = 0, confirmation = 0;
  static constexpr auto fields(auto& m) {
    return std::tie(m.param, m.command, m.target_system, m.target_component, m.confirmation);
  }
};

struct CommandAck {
  static constexpr std::uint32_t kId = 77;
  static constexpr std::uint8_t kCrcExtra = 143, kMinLength = 3;
  std::uint16_t command = 0;
  std::uint8_t result = 0, progress = 0;
  std::int32_t result_param2 = 0;
  std::uint8_t target_system = 0, target_component = 0;
  static constexpr auto fields(auto& m) {
    return std::tie(m.command, m.result, m.progress, m.result_param2, m.target_system, m.target_component);
  }
};

struct SetPositionTargetLocalNed {
  static constexpr std::uint32_t kId = 84;
  static constexpr std::uint8_t kCrcExtra = 143, kMinLength = 53;
  std::uint32_t time_boot_ms = 0;
  std::array<float, 3> p{}, v{}, a{};
  float yaw = 0.0F, yaw_rate = 0.0F;
  std::uint16_t type_mask = 0;  ///< a set bit: that field is ignored
  std::uint8_t target_system = 0, target_component = 0, coordinate_frame = 0;
  static constexpr auto fields(auto& m) {
    return std::tie(m.time_boot_ms, m.p, m.v, m.a, m.yaw, m.yaw_rate, m.type_mask, m.target_system, m.target_component,
                    m.coordinate_frame);
  }
};

/// The abilities of a vehicle, for ground stations.
struct AutopilotVersion {
  static constexpr std::uint32_t kId = 148;
  static constexpr std::uint8_t kCrcExtra = 178, kMinLength = 60;
  std::uint64_t capabilities = 0, uid = 0;  ///< MAV_PROTOCOL_CAPABILITY
  std::array<std::uint32_t, 4> versions{};  ///< flight, middleware, operating system, board
  std::uint16_t vendor_id = 0, product_id = 0;
  std::array<std::uint8_t, 24> custom_versions{};  ///< flight, middleware, operating system
  std::array<std::uint8_t, 18> uid2{};
  static constexpr auto fields(auto& m) {
    return std::tie(m.capabilities, m.uid, m.versions, m.vendor_id, m.product_id, m.custom_versions, m.uid2);
  }
};

struct Timesync {
  static constexpr std::uint32_t kId = 111;
  static constexpr std::uint8_t kCrcExtra = 34, kMinLength = 16;
  std::int64_t tc1 = 0, ts1 = 0;  ///< ns; tc1 = 0: a request. The answer has the own time in tc1, and ts1 copied
  std::uint8_t target_system = 0, target_component = 0;
  static constexpr auto fields(auto& m) { return std::tie(m.tc1, m.ts1, m.target_system, m.target_component); }
};

struct HilStateQuaternion {
  static constexpr std::uint32_t kId = 115;
  static constexpr std::uint8_t kCrcExtra = 4, kMinLength = 64;
  std::uint64_t time_usec = 0;
  std::array<float, 4> q{};  ///< w x y z
  std::array<float, 3> rates{};
  std::int32_t lat = 0, lon = 0, alt = 0;  ///< 1e-7 degrees, mm
  std::array<std::int16_t, 3> v{};         ///< NED, cm/s
  std::uint16_t ind_airspeed = 0, true_airspeed = 0;
  std::array<std::int16_t, 3> acc{};  ///< milli-g
  static constexpr auto fields(auto& m) {
    return std::tie(m.time_usec, m.q, m.rates, m.lat, m.lon, m.alt, m.v, m.ind_airspeed, m.true_airspeed, m.acc);
  }
};

struct EstimatorStatus {
  static constexpr std::uint32_t kId = 230;
  static constexpr std::uint8_t kCrcExtra = 163, kMinLength = 42;
  std::uint64_t time_usec = 0;
  std::array<float, 6> ratios{};  ///< vel, pos_horiz, pos_vert, mag, hagl, tas: innovation over its gate
  float pos_horiz_accuracy = 0.0F, pos_vert_accuracy = 0.0F;  ///< m
  std::uint16_t flags = 0;
  static constexpr auto fields(auto& m) {
    return std::tie(m.time_usec, m.ratios, m.pos_horiz_accuracy, m.pos_vert_accuracy, m.flags);
  }
};

struct ExtendedSysState {
  static constexpr std::uint32_t kId = 245;
  static constexpr std::uint8_t kCrcExtra = 130, kMinLength = 2;
  std::uint8_t vtol_state = 0, landed_state = 0;
  static constexpr auto fields(auto& m) { return std::tie(m.vtol_state, m.landed_state); }
};

struct StatusText {
  static constexpr std::uint32_t kId = 253;
  static constexpr std::uint8_t kCrcExtra = 83, kMinLength = 51;
  std::uint8_t severity = 6;  ///< 0 emergency … 7 debug
  Text<50> text{};
  std::uint16_t id = 0;
  std::uint8_t chunk_seq = 0;
  static constexpr auto fields(auto& m) { return std::tie(m.severity, m.text, m.id, m.chunk_seq); }
};

struct Odometry {
  static constexpr std::uint32_t kId = 331;
  static constexpr std::uint8_t kCrcExtra = 91, kMinLength = 230;
  std::uint64_t time_usec = 0;
  std::array<float, 3> p{};
  std::array<float, 4> q{};  ///< w x y z
  std::array<float, 3> v{}, rates{};
  std::array<float, 21> pose_covariance{}, velocity_covariance{};
  std::uint8_t frame_id = 0, child_frame_id = 0, reset_counter = 0, estimator_type = 0;
  std::int8_t quality = 0;
  static constexpr auto fields(auto& m) {
    return std::tie(m.time_usec, m.p, m.q, m.v, m.rates, m.pose_covariance, m.velocity_covariance, m.frame_id,
                    m.child_frame_id, m.reset_counter, m.estimator_type, m.quality);
  }
};

using AllMessages =
    std::tuple<Heartbeat, SysStatus, ParamRequestRead, ParamValue, ParamSet, AttitudeQuaternion, LocalPositionNed,
               GlobalPositionInt, GpsGlobalOrigin, CommandLong, CommandAck, SetPositionTargetLocalNed, Timesync,
               HilStateQuaternion, EstimatorStatus, ExtendedSysState, StatusText, Odometry, MissionRequest,
               MissionCurrent, MissionRequestList, MissionCount, MissionClearAll, MissionItemReached, MissionAck,
               MissionRequestInt, MissionItemInt, AutopilotVersion>;

/// The length of a message's fields in bytes, with extensions.
template <class M>
constexpr std::size_t length_of() {
  M message;
  return std::apply([](const auto&... field) { return (sizeof(field) + ...); }, M::fields(message));
}

/// Encodes a message: the payload is little-endian and untruncated.
template <class M>
Frame to_frame(const M& message, Address from, std::uint8_t sequence) {
  static_assert(std::endian::native == std::endian::little);
  Frame frame{from, sequence, M::kId, Bytes(length_of<M>())};
  std::size_t at = 0;
  const auto put = [&](const auto& field) {
    std::memcpy(frame.payload.data() + at, &field, sizeof(field));
    at += sizeof(field);
  };
  std::apply([&](const auto&... field) { (put(field), ...); }, M::fields(message));
  return frame;
}

/// Decodes a frame. @return nullopt if it is another message
template <class M>
std::optional<M> from_frame(const Frame& frame) {
  if (frame.id != M::kId || frame.payload.size() != length_of<M>()) return std::nullopt;
  M message;
  std::size_t at = 0;
  const auto take = [&](auto& field) {
    std::memcpy(&field, frame.payload.data() + at, sizeof(field));
    at += sizeof(field);
  };
  std::apply([&](auto&... field) { (take(field), ...); }, M::fields(message));
  return message;
}

template <std::size_t N>
Text<N> text_of(std::string_view words) {
  Text<N> text{};
  words.copy(text.data(), N);
  return text;
}
/// The bytes up to the first zero.
template <std::size_t N>
std::string_view bytes_of(const Text<N>& text) {
  return {text.data(), static_cast<std::size_t>(std::find(text.begin(), text.end(), '\0') - text.begin())};
}
/// Replaces characters that are not printable ASCII by '?'. Removes a tab at the end, by which PX4 marks texts that it
/// sends as events as well.
std::string printable(std::string words);
template <std::size_t N>
std::string string_of(const Text<N>& text) {
  return printable(std::string(bytes_of(text)));
}

}  // namespace tern::mavlink
