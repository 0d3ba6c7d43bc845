#include "messages/form.h"
#include "tern_msgs/vehicle_status_t.hpp"

namespace tern {

template <>
struct wire::Form<VehicleStatus> {
  using Message = tern_msgs::vehicle_status_t;
  static_assert(Message::MAX_MODE_TEXT == kMaxModeText);
  static_assert(Message::MAX_WHY_TEXT == kMaxWhyText);
  static_assert(Message::LOST == static_cast<int>(EstimatorHealth::Lost));
  static constexpr Layout kLayout{
      Array{&Message::mode_count, &Message::mode, 0, kMaxModeText},
      Array{&Message::why_count, &Message::why_not, 0, kMaxWhyText},
  };
  static constexpr double kUnknown = -1.0;  // battery

  static void fields(auto& io, auto& m, auto& status) {
    io.header("header", m.header, status.header);
    io.time("at_us", m.at_us, status.at);
    io.flag("armed", m.armed, status.armed);
    io.flag("following", m.following, status.following);
    io.flag("landed", m.landed, status.landed);
    io.enumeration("estimator", m.estimator, status.estimator, EstimatorHealth::Lost);
    io.extents("position_sigma", m.position_sigma, status.position_sigma);
    io.counter("resets", m.resets, status.resets);
    io.text("mode", m.mode, status.mode);
    io.text("why_not", m.why_not, status.why_not);
  }

  static void write_rest(Message& m, const VehicleStatus& status) { m.battery = status.battery.value_or(kUnknown); }

  static void read_rest(FieldReader& read, const Message& m, VehicleStatus& status) {
    if (m.battery != kUnknown) status.battery = read.named("battery").number(m.battery, 0.0, 1.0);
    read.consistent(!status.following || status.armed);
    read.consistent(status.following == status.why_not.empty());
  }
};

template Bytes encode(const VehicleStatus& value);
template tl::expected<VehicleStatus, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<VehicleStatus>(std::span<const std::uint8_t> bytes);

}  // namespace tern
