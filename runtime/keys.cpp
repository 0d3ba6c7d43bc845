#include "runtime/keys.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>

#include "core/base/files.h"

namespace tern {
namespace {

constexpr std::string_view kRingHead = "tern keys 1\n";
constexpr std::string_view kLabel = "tern key 1 ";
/// A ring of all keys has 2 kB.
constexpr std::size_t kMaxFileBytes = 16'384;
constexpr mode_t kOthers = 077;

std::span<std::uint8_t> writable(std::string& text) {
  return {reinterpret_cast<std::uint8_t*>(text.data()), text.size()};
}

/// A text whose memory is wiped by the destructor.
struct SecretText {
  std::string text;
  SecretText() = default;
  SecretText(SecretText&&) = default;
  SecretText(const SecretText&) = delete;
  SecretText& operator=(const SecretText&) = delete;
  ~SecretText() { wipe(writable(text)); }
};

std::optional<Key> key_of_hex(std::string_view hex) {
  if (hex.size() != 2 * kKeyBytes) return std::nullopt;
  std::array<std::uint8_t, kKeyBytes> bytes = {};
  for (std::size_t k = 0; k < hex.size(); ++k) {
    const char c = hex[k];
    const bool is_digit = c >= '0' && c <= '9', is_low = c >= 'a' && c <= 'f', is_high = c >= 'A' && c <= 'F';
    if (!is_digit && !is_low && !is_high) return std::nullopt;
    const int digit = is_digit ? c - '0' : (is_low ? c - 'a' : c - 'A') + 10;
    bytes[k / 2] = static_cast<std::uint8_t>(bytes[k / 2] << 4U | digit);
  }
  const Key key(bytes);
  wipe(bytes);
  return key;
}

std::optional<Key> master_of(std::string_view text) {
  if (text.size() == kKeyBytes) return Key({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  if (text.ends_with('\n')) text.remove_suffix(1);
  return key_of_hex(text);
}

Result<SecretText> read_all(int fd, const std::string& what) {
  SecretText read;
  read.text.resize(kMaxFileBytes);
  const ssize_t n = pread(fd, read.text.data(), read.text.size(), 0);
  if (n < 0) {
    if (errno == ESPIPE) return fail(what + ": a pipe can be read once only; use a file");
    return fail(fmt::format("{}: cannot be read: {}", what, std::strerror(errno)));
  }
  read.text.resize(static_cast<std::size_t>(n));
  return read;
}

Result<SecretText> read_private_file(const std::string& path) {
  const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (file.get() < 0) return fail(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
  struct stat status {};
  if (fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) {
    return fail(path + ": a key is read from a regular file only");
  }
  if ((status.st_mode & kOthers) != 0) {
    return fail(fmt::format("{}: mode {:03o}: readable by others than its owner; run chmod 600 {}", path,
                            static_cast<unsigned>(status.st_mode & 0777U), path));
  }
  return read_all(file.get(), path);
}

Result<KeyRing> ring_of(const Result<SecretText>& read, const std::string& what, std::string_view process) {
  if (!read) return tl::make_unexpected(read.error());
  auto ring = KeyRing::parse(read->text, process);
  if (!ring) return fail(fmt::format("{}: {}", what, ring.error().message));
  return ring;
}

}  // namespace

KeyRing KeyRing::derive(const Key& master, std::string_view process) {
  const auto known = std::find_if(process_roles().begin(), process_roles().end(),
                                  [&](const ProcessRole& p) { return p.process == process; });
  KeyRing ring(known == process_roles().end() ? Role::Observer : known->role);
  const auto add = [&](std::string_view name) {
    ring.keys_.insert_or_assign(std::string(name), derive_key(master, std::string(kLabel).append(name)));
  };
  const bool all = known == process_roles().end();
  for (const ProcessRole& entry : process_roles()) {
    if (!all && entry.process != process) continue;
    for (const std::string_view channel : entry.channels) add(channel);
  }
  for (const Role role : kRoles) add(to_string(role));
  return ring;
}

Result<KeyRing> KeyRing::parse(std::string_view text, std::string_view process) {
  if (const auto master = master_of(text)) return derive(*master, process);
  if (!text.starts_with(kRingHead)) return fail("holds no key: 32 bytes, 64 hexadecimal digits, or a ring of tern-key");
  text.remove_prefix(kRingHead.size());
  const auto take_line = [&text]() -> std::string_view {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    return line;
  };
  const auto role = role_named(take_line());
  if (!role) return fail("line 2 names no role");
  if (const auto needed = role_of_process(process); needed && *needed != *role) {
    return fail(fmt::format("holds the keys of the {}, not those of {}", to_string(*role), process));
  }
  KeyRing ring(*role);
  for (int line_number = 3; !text.empty(); ++line_number) {
    const std::string_view line = take_line();
    const std::size_t space = line.find(' ');
    const std::string_view name = line.substr(0, space);
    const auto key = space == std::string_view::npos ? std::nullopt : key_of_hex(line.substr(space + 1));
    if (!key || !(role_of(name) || role_named(name))) return fail(fmt::format("line {} holds no key", line_number));
    ring.keys_.insert_or_assign(std::string(name), *key);
  }
  return ring;
}

std::string KeyRing::to_text() const {
  std::string text(kRingHead);
  text += fmt::format("{}\n", to_string(role_));
  for (const auto& [name, key] : keys_) text += fmt::format("{} {}\n", name, to_hex(key));
  return text;
}

const Key* KeyRing::find(std::string_view channel, Role role) const {
  const auto owner = role_of(channel);
  if (owner && *owner != role) return nullptr;
  const auto found = keys_.find(owner ? channel : std::string_view(to_string(role)));
  return found == keys_.end() ? nullptr : &found->second;
}

Result<KeyRing> read_key_file(const std::string& path, std::string_view process) {
  return ring_of(read_private_file(path), path, process);
}

Result<KeyRing> read_key_fd(int fd, std::string_view process) {
  const std::string what = fmt::format("--key-fd {}", fd);
  const Descriptor file(fd);
  return ring_of(read_all(file.get(), what), what, process);
}

Result<int> seal_in_memory(const KeyRing& ring) {
  SecretText secret;
  secret.text = ring.to_text();
  const int fd = memfd_create("tern-keys", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (fd < 0 || write(fd, secret.text.data(), secret.text.size()) != std::ssize(secret.text) ||
      fcntl(fd, F_ADD_SEALS, F_SEAL_WRITE | F_SEAL_GROW | F_SEAL_SHRINK | F_SEAL_SEAL) != 0) {
    return fail(fmt::format("a file in memory for the keys cannot be made: {}", std::strerror(errno)));
  }
  return fd;
}

Result<Key> read_master_key(const std::string& path) {
  const auto read = read_private_file(path);
  if (!read) return tl::make_unexpected(read.error());
  const auto key = master_of(read->text);
  if (!key) return fail(path + ": holds no master key: 32 bytes or 64 hexadecimal digits");
  return *key;
}

std::string to_hex(const Key& key) {
  std::string hex;
  for (const std::uint8_t byte : key.bytes()) hex += fmt::format("{:02x}", byte);
  return hex;
}

}  // namespace tern
