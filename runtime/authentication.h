// Signs outgoing messages and verifies incoming ones before they are decoded: bytes in, bytes out.
//
// A tag binds a message to its channel, role, sender, sequence number and time (messages/trailer.h, runtime/mac.h). The
// tag is checked first, then whether the message is new. A refused message changes no state here.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>

#include "core/wire/header.h"
#include "core/wire/health.h"
#include "core/wire/recent_senders.h"
#include "messages/codec.h"
#include "runtime/keys.h"

namespace tern {

/// Largest age of a signed message: from its sending (the sender's clock) to its arrival at the kernel (the listener's
/// clock). Every network is faster. A receiver that restarts remembers no sequence numbers; the limit protects it from
/// recorded messages.
inline constexpr Duration kMaxTransit{2'000'000};

/// The sequence numbers of one sender that have arrived: the highest, and which of the 63 below it. A message that is
/// overtaken by up to 63 others is still accepted, and every message is accepted once.
///
/// SequenceWindow is no substitute: it forgets a number that is not confirmed by the next one. That protects against
/// noise. Here every number has a valid tag, and forgetting would allow replay.
class ReplayWindow {
 public:
  /// Marks the number as seen. @return whether it was new: above the highest, or within the window and not seen.
  /// @pre sequence > 0
  bool admit(std::int64_t sequence);

 private:
  std::int64_t highest_ = 0;
  std::uint64_t seen_ = 0;  ///< bit k: highest_ − k
};

/// The sequence numbers that arrived on one channel, by the sender's role and epoch.
using ReplayGuard = RecentSenders<std::pair<Role, std::int64_t>, ReplayWindow>;

/// A message whose tag is valid.
struct VerifiedMessage {
  std::span<const std::uint8_t> message;  ///< without its trailer
  Role role;
};

/// Appends the trailer with its tag.
/// @param channel  without suffix  @param wire_name  with it
/// @throws std::invalid_argument if the ring has no key for the channel.
void sign(Bytes& message, const KeyRing& keys, std::string_view channel, std::string_view wire_name,
          const Header& header);

/// Checks a message that carries a trailer.
/// @param received  when the kernel took it, the listener's clock
/// @return Unauthenticated for a missing trailer, a wrong tag, a role that may not send on this channel, or a role
///   whose key is missing. Repeated if the message is older than kMaxTransit, or if `guard` has seen it.
tl::expected<VerifiedMessage, Rejection> verify(std::span<const std::uint8_t> bytes, const KeyRing& keys,
                                                ReplayGuard& guard, std::string_view channel,
                                                std::string_view wire_name, UTime received);

}  // namespace tern
