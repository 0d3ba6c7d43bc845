// The keys that a process holds: those of the channels that it publishes or receives.
//
// All keys are derived from one master key of a flight, or of a fleet of hosts. A channel that belongs to one role has
// a key of its own, under the label "tern key 1 PLAN". For the other channels each role has a key, "tern key 1
// planner". The key of a MAC both signs and verifies. So a receiver of a channel could also sign on it
// (docs/security.md).
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "runtime/mac.h"
#include "runtime/roles.h"

namespace tern {

/// Keys by channel, and the role of their holder. Copies are independent; each wipes its keys when it is destroyed.
class KeyRing {
 public:
  /// The ring of one of Tern's processes (roles.h). A process of another name gets all keys, in the role Observer.
  static KeyRing derive(const Key& master, std::string_view process);
  /// Reads the text that to_text() wrote. Or derives `process`'s ring from a master key: 32 bytes, or 64 hexadecimal
  /// digits and an optional end of line.
  /// @return an Error that describes the problem without quoting the contents.
  static Result<KeyRing> parse(std::string_view text, std::string_view process);

  /// Lines of text: "tern keys 1", the role, then for each key its name and 64 hexadecimal digits.
  [[nodiscard]] std::string to_text() const;

  [[nodiscard]] Role role() const { return role_; }
  /// The role in which the holder publishes on a channel: the channel's owner, or its own role.
  [[nodiscard]] Role role_on(std::string_view channel) const { return role_of(channel).value_or(role_); }
  /// The key for messages of `role` on `channel`; nullptr if the ring has none, or if the channel belongs to another
  /// role.
  /// @param channel  without a vehicle's suffix
  [[nodiscard]] const Key* find(std::string_view channel, Role role) const;

 private:
  explicit KeyRing(Role role) : role_(role) {}
  Role role_;
  std::map<std::string, Key, std::less<>> keys_;  ///< by channel, or by a role's name
};

/// Reads a file with a master key, or with a ring for `process`.
/// @return an Error that names the path and the problem: unreadable, no regular file, readable by others (mode & 077),
///   or no key in it.
Result<KeyRing> read_key_file(const std::string& path, std::string_view process);

/// Reads the same from an open file without a name (memfd, an unlinked file), from its beginning, and closes it. A pipe
/// is refused: a restarted process would find it empty.
Result<KeyRing> read_key_fd(int fd, std::string_view process);

/// Writes a ring into a sealed, nameless file in memory, for read_key_fd of a program that inherits it.
/// @return its descriptor, close-on-exec.
Result<int> seal_in_memory(const KeyRing& ring);

/// Reads a master key from a file, with the checks of read_key_file. A ring is refused.
Result<Key> read_master_key(const std::string& path);

/// 64 lower-case hexadecimal digits.
std::string to_hex(const Key& key);

}  // namespace tern
