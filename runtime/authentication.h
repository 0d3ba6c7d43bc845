// Signs what leaves, and checks what comes in, before anything is decoded: bytes in, bytes out.
//
// A tag binds a message to its channel, role, sender, number and time (messages/trailer.h, runtime/mac.h). It is
// checked first; then the message must be new. Whose message is refused has changed nothing here.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>

#include "core/world/header.h"
#include "core/world/health.h"
#include "core/world/recent_senders.h"
#include "messages/codec.h"
#include "runtime/keys.h"

namespace tern {

/// With keys nothing is accepted that was on its way for longer, by the sender's clock and the time at which the kernel
/// took it. Any network is faster; a receiver that starts anew, and so remembers nothing, can be shown no older
/// message.
inline constexpr Duration kMaxTransit{2'000'000};

/// Which numbers of one sender have come: the highest, and the 64 up to it. So messages may overtake each other by 63
/// places and still count once each. SequenceWindow is no substitute: it forgets a number that no next one confirmed,
/// which is right against noise and wrong against replay. Here each number is true, since its tag was.
class ReplayWindow {
 public:
  /// @return whether the number is new: higher than all, or within the window and not yet seen. Then it is seen.
  /// @pre sequence > 0
  bool admit(std::int64_t sequence);

 private:
  std::int64_t highest_ = 0;
  std::uint64_t seen_ = 0;  ///< bit k: highest_ − k
};

/// What has come on one channel, by role and epoch of the sender.
using ReplayGuard = RecentSenders<std::pair<Role, std::int64_t>, ReplayWindow>;

struct VerifiedMessage {
  std::span<const std::uint8_t> message;  ///< without its trailer
  Role role;
};

/// Appends the trailer with its tag. @param channel  without suffix  @param wire_name  with it
/// @throws std::invalid_argument when the ring has no key for it.
void sign(Bytes& message, const KeyRing& keys, std::string_view channel, std::string_view wire_name,
          const Header& header);

/// Unauthenticated: no trailer, another role's channel, no key of that role, another tag. Repeated: kMaxTransit,
/// or not new by `guard`. @param received  when the kernel took it
tl::expected<VerifiedMessage, Rejection> verify(std::span<const std::uint8_t> bytes, const KeyRing& keys,
                                                ReplayGuard& guard, std::string_view channel,
                                                std::string_view wire_name, UTime received);

}  // namespace tern
