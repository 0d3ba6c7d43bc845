// The keys that a process holds: those of the channels that it says or hears, no others.
//
// All are derived from one master key of a flight, or of a fleet of hosts. Each channel that is one role's has a key,
// under the label "tern key 1 PLAN". For all other channels each role has one, "tern key 1 planner". A MAC's key signs
// as well as it verifies, so who hears a channel could sign on it; who does not, cannot (docs/security.md).
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "runtime/mac.h"
#include "runtime/roles.h"

namespace tern {

/// Keys by channel, and the role in which their holder speaks. A value; copies are wiped as keys are.
class KeyRing {
 public:
  /// The ring of one of Tern's processes (roles.h); of a process of another name: all keys, as Observer.
  static KeyRing derive(const Key& master, std::string_view process);
  /// Reads what to_text() wrote. Or derives `process`'s ring from a master key: 32 bytes, or 64 hexadecimal digits and
  /// an end of line.
  /// @return an Error that says what is wrong, and nothing of the contents.
  static Result<KeyRing> parse(std::string_view text, std::string_view process);

  /// As lines of text: "tern keys 1", the role, and per key its name and 64 hexadecimal digits.
  [[nodiscard]] std::string to_text() const;

  [[nodiscard]] Role role() const { return role_; }
  /// The role in which the holder speaks on a channel: the channel's, or its own.
  [[nodiscard]] Role role_on(std::string_view channel) const { return role_of(channel).value_or(role_); }
  /// The key of messages on `channel` by `role`; nullptr when the ring has none, or the channel is another role's.
  /// @param channel  without a vehicle's suffix
  [[nodiscard]] const Key* find(std::string_view channel, Role role) const;

 private:
  explicit KeyRing(Role role) : role_(role) {}
  Role role_;
  std::map<std::string, Key, std::less<>> keys_;  ///< by channel, or by role's name
};

/// A file with a master key, or a ring for `process`.
/// @return an Error that names the path and what is wrong: unreadable, no regular file, readable by others (mode &
/// 077), no key in it.
Result<KeyRing> read_key_file(const std::string& path, std::string_view process);

/// The same of an open file without a name (memfd, an unlinked file), from its beginning, wherever its offset is;
/// closes it. A pipe is refused: a process that is started again would find it empty.
Result<KeyRing> read_key_fd(int fd, std::string_view process);

/// Writes a ring into a sealed file in memory without a name, for read_key_fd of a program that inherits it. @return
/// its descriptor, close-on-exec.
Result<int> seal_in_memory(const KeyRing& ring);

/// A master key of a file, as above but for rings.
Result<Key> read_master_key(const std::string& path);

/// 64 lower-case hexadecimal digits.
std::string to_hex(const Key& key);

}  // namespace tern
