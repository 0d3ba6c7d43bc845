// A link of tern-mission to a ground station that is the test itself.
#pragma once

#include <cmath>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "mavlink/link/link.h"
#include "mission/upload/mission_server.h"

namespace tern::mission::testing {

/// The frames of a ground station, on their way. They outlive the processes that receive them.
using Cable = std::deque<mavlink::Bytes>;

class StationLink final : public mavlink::Link {
 public:
  StationLink(Cable& cable, std::vector<mavlink::Frame>& sent) : cable_(cable), sent_(sent) {}
  std::optional<mavlink::Portion> receive(UTime) override {
    if (cable_.empty()) return std::nullopt;
    mavlink::Portion portion{cable_.front(), std::nullopt};
    cable_.pop_front();
    return portion;
  }
  void send(std::span<const std::uint8_t> bytes) override {
    for (const mavlink::Frame& frame : parser_.push(bytes)) sent_.push_back(frame);
  }
  [[nodiscard]] bool datagrams() const override { return true; }

 private:
  Cable& cable_;
  mavlink::Parser parser_;
  std::vector<mavlink::Frame>& sent_;
};

template <class M>
void send(Cable& cable, const M& message) {
  cable.push_back(mavlink::to_bytes(mavlink::to_frame(message, {255, 190}, 0)));
}

/// Sends items as an upload, without waiting for the requests.
inline void upload(Cable& cable, std::vector<mavlink::MissionItemInt> items, std::uint8_t type) {
  send(cable, mavlink::MissionCount{static_cast<std::uint16_t>(items.size()), 1, 1, type, 0});
  for (std::size_t k = 0; k < items.size(); ++k) {
    items[k].seq = static_cast<std::uint16_t>(k);
    items[k].target_system = items[k].target_component = 1;
    items[k].mission_type = type;
    send(cable, items[k]);
  }
}

/// An item of a fence at (x, y) m in W, or at (latitude, longitude) in degrees with another frame.
inline mavlink::MissionItemInt fence_item(std::uint16_t command, float size, double x, double y,
                                          std::uint8_t frame = 4) {
  const double unit = frame == 4 ? 1e-4 : 1e-7;
  mavlink::MissionItemInt item;
  item.command = command;
  item.frame = frame;
  item.param[0] = size;
  item.x = static_cast<std::int32_t>(std::lround(x / unit));
  item.y = static_cast<std::int32_t>(std::lround(y / unit));
  item.mission_type = kFenceType;
  return item;
}

/// MAV_CMD_NAV_FENCE_
inline constexpr std::uint16_t kReturnPoint = 5000, kPolygonInclusion = 5001, kPolygonExclusion = 5002,
                               kCircleInclusion = 5003, kCircleExclusion = 5004;

/// The corners of a rectangle in W.
inline std::vector<mavlink::MissionItemInt> rectangle(std::uint16_t command, double x0, double y0, double x1,
                                                      double y1) {
  return {fence_item(command, 4, x0, y0), fence_item(command, 4, x1, y0), fence_item(command, 4, x1, y1),
          fence_item(command, 4, x0, y1)};
}

}  // namespace tern::mission::testing
