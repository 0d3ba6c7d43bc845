#include "runtime/authentication.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "messages/trailer.h"

namespace tern {
namespace {

constexpr std::int64_t kWindow = 64;

}  // namespace

bool ReplayWindow::admit(std::int64_t sequence) {
  if (sequence > highest_) {
    const std::int64_t step = sequence - highest_;
    seen_ = (step >= kWindow ? 0 : seen_ << static_cast<unsigned>(step)) | 1U;
    highest_ = sequence;
    return true;
  }
  const std::int64_t back = highest_ - sequence;
  if (back >= kWindow) return false;
  const std::uint64_t bit = std::uint64_t{1} << static_cast<unsigned>(back);
  if ((seen_ & bit) != 0) return false;
  seen_ |= bit;
  return true;
}

void sign(Bytes& message, const KeyRing& keys, std::string_view channel, std::string_view wire_name,
          const Header& header) {
  const Role role = keys.role_on(channel);
  const Key* key = keys.find(channel, role);
  if (key == nullptr) throw std::invalid_argument("no key to sign on " + std::string(channel));
  append_trailer_head(message, {static_cast<std::uint8_t>(role), header.name, header.utime, {}});
  const Tag tag = make_tag(*key, wire_name, message);
  message.insert(message.end(), tag.begin(), tag.end());
}

tl::expected<VerifiedMessage, Rejection> verify(std::span<const std::uint8_t> bytes, const KeyRing& keys,
                                                ReplayGuard& guard, std::string_view channel,
                                                std::string_view wire_name, UTime received) {
  const auto trailer = read_trailer(bytes);
  if (!trailer) return tl::make_unexpected(Rejection::Unauthenticated);
  const auto role = static_cast<Role>(trailer->role);
  const Key* key =
      std::find(std::begin(kRoles), std::end(kRoles), role) == std::end(kRoles) ? nullptr : keys.find(channel, role);
  if (key == nullptr || !equal_tags(make_tag(*key, wire_name, bytes.first(bytes.size() - kTagBytes)), trailer->tag)) {
    return tl::make_unexpected(Rejection::Unauthenticated);
  }
  const MessageName& name = trailer->name;
  const bool too_old = trailer->utime < received - kMaxTransit;
  if (too_old || name.sequence < 1 || !guard.touch({role, name.sender_epoch_us}).admit(name.sequence)) {
    return tl::make_unexpected(Rejection::Repeated);
  }
  return VerifiedMessage{bytes.first(bytes.size() - kTrailerBytes), role};
}

}  // namespace tern
