// Bytes to and from an autopilot: UDP or a serial port.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/time.h"
#include "mavlink/frame.h"

namespace tern::mavlink {

/// What has come at once.
struct Portion {
  Bytes bytes;
  /// When, µs by the system's clock, however late it is fetched; nothing: just now.
  std::optional<std::int64_t> unix_us;
};

/// One end. Never blocks: what a full buffer does not take is lost, as on any link, but never a part of a frame alone.
class Link {
 public:
  virtual ~Link() = default;
  /// The next bytes that have come. @return nullopt if there are none
  virtual std::optional<Portion> receive(UTime now) = 0;
  /// @param bytes  one frame
  virtual void send(std::span<const std::uint8_t> bytes) = 0;
  /// Whether each portion is a whole number of frames.
  [[nodiscard]] virtual bool datagrams() const = 0;
  /// Datagrams of others than the peer, which were dropped.
  [[nodiscard]] virtual std::int64_t strangers() const { return 0; }
  /// Sentences for the log since the last call.
  virtual std::vector<std::string> take_log_lines() { return {}; }
};

/// udp://ADDRESS:PORT listens there, as PX4 expects it of a companion computer. The peer is who first sends an
/// autopilot's HEARTBEAT; after 3 s of its silence the next one is. udp://ADDRESS:PORT@ADDRESS:PORT listens at the
/// first place and speaks to the second, who is the peer. It is for an autopilot that answers who speaks to it first,
/// and from then on that port alone (PX4 does). udpout://ADDRESS:PORT speaks to that place, from any port.
/// serial:///dev/NAME:BAUD is a serial port, raw, 8N1. One that is gone, as a plug that is pulled, is opened again when
/// it is back. ADDRESS is numeric.
Result<std::unique_ptr<Link>> open_link(const std::string& url);

}  // namespace tern::mavlink
