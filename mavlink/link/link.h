// Byte links to an autopilot: UDP or a serial port.
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

/// Bytes that were received together.
struct Portion {
  Bytes bytes;
  /// Receive time, µs of the system's clock, even if it is fetched later; nullopt: just now.
  std::optional<std::int64_t> unix_us;
};

/// One end of a link. It never blocks. Frames that a full buffer does not take are lost whole.
class Link {
 public:
  virtual ~Link() = default;
  /// Returns the next received bytes, or nullopt.
  virtual std::optional<Portion> receive(UTime now) = 0;
  /// Sends one frame.
  virtual void send(std::span<const std::uint8_t> bytes) = 0;
  /// Whether each portion contains whole frames only.
  [[nodiscard]] virtual bool datagrams() const = 0;
  /// Number of dropped datagrams from senders other than the peer.
  [[nodiscard]] virtual std::int64_t strangers() const { return 0; }
  /// Returns lines for the log since the last call.
  virtual std::vector<std::string> take_log_lines() { return {}; }
};

/// The sender that a listening link takes for its peer.
enum class Peer : std::uint8_t {
  Autopilot,  ///< sends an autopilot's HEARTBEAT
  Estimator,  ///< sends ODOMETRY
};

/// Opens a link.
///
/// | URL                                  | link                                                                    |
/// |--------------------------------------|-------------------------------------------------------------------------|
/// | udp://ADDRESS:PORT                   | listens there, as PX4 expects of a companion computer                   |
/// | udp://ADDRESS:PORT@ADDRESS:PORT      | listens at the first address and sends to the second, its only peer     |
/// | udpout://ADDRESS:PORT                | sends to that address, from any port                                    |
/// | serial:///dev/NAME:BAUD              | a serial port, raw, 8N1; a port that was unplugged is opened again      |
///
/// The peer of a listening link is the first sender of what `peer` says. After 3 s of its silence another sender may
/// become the peer. The second form is for an autopilot that answers only to the first port that speaks to
/// it (PX4). ADDRESS is numeric IPv4.
Result<std::unique_ptr<Link>> open_link(const std::string& url, Peer peer = Peer::Autopilot);

}  // namespace tern::mavlink
