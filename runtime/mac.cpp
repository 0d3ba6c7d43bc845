#include "runtime/mac.h"

#include <sodium.h>

#include <algorithm>
#include <stdexcept>

namespace tern {
namespace {

/// Chooses the fastest code for this CPU, once.
void start_sodium() {
  static const bool kStarted = sodium_init() >= 0;
  if (!kStarted) throw std::runtime_error("libsodium cannot start");
}

const std::uint8_t* bytes_of(std::string_view text) { return reinterpret_cast<const std::uint8_t*>(text.data()); }

}  // namespace

Key::Key(std::span<const std::uint8_t> bytes) {
  if (bytes.size() != kKeyBytes) throw std::invalid_argument("a key has 32 bytes");
  std::copy(bytes.begin(), bytes.end(), bytes_.begin());
}

Key::~Key() { wipe(bytes_); }

Key random_key() {
  start_sodium();
  std::array<std::uint8_t, kKeyBytes> bytes;
  randombytes_buf(bytes.data(), bytes.size());
  const Key key(bytes);
  wipe(bytes);
  return key;
}

Key derive_key(const Key& master, std::string_view label) {
  start_sodium();
  std::array<std::uint8_t, kKeyBytes> bytes;
  crypto_generichash(bytes.data(), bytes.size(), bytes_of(label), label.size(), master.bytes().data(), kKeyBytes);
  const Key key(bytes);
  wipe(bytes);
  return key;
}

Tag make_tag(const Key& key, std::string_view wire_name, std::span<const std::uint8_t> signed_bytes) {
  start_sodium();
  const auto name_bytes = static_cast<std::uint8_t>(wire_name.size());
  crypto_generichash_state state;
  crypto_generichash_init(&state, key.bytes().data(), kKeyBytes, kTagBytes);
  crypto_generichash_update(&state, &name_bytes, 1);
  crypto_generichash_update(&state, bytes_of(wire_name), wire_name.size());
  crypto_generichash_update(&state, signed_bytes.data(), signed_bytes.size());
  Tag tag;
  crypto_generichash_final(&state, tag.data(), tag.size());
  wipe({reinterpret_cast<std::uint8_t*>(&state), sizeof(state)});
  return tag;
}

bool equal_tags(const Tag& a, const Tag& b) { return sodium_memcmp(a.data(), b.data(), kTagBytes) == 0; }

std::array<std::uint8_t, 32> sha256(std::span<const std::uint8_t> bytes) {
  std::array<std::uint8_t, crypto_hash_sha256_BYTES> digest;
  crypto_hash_sha256(digest.data(), bytes.data(), bytes.size());
  return digest;
}

void wipe(std::span<std::uint8_t> bytes) { sodium_memzero(bytes.data(), bytes.size()); }

}  // namespace tern
