// Noise that resembles messages: copies of true messages with one or two changes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "core/base/digest.h"
#include "core/base/random.h"

namespace tern::testing {

/// Sends copies of recently received messages of any channel. Each copy has one or two changes of a bit, a byte, or
/// eight bytes. It ignores its own copies. All is a function of seed and traffic.
class TrafficMutator {
 public:
  struct Message {
    std::string channel;
    std::vector<std::uint8_t> bytes;
  };

  explicit TrafficMutator(std::uint64_t seed) : rng_(seed) {}

  void hear(std::string_view channel, std::span<const std::uint8_t> bytes) {
    if (bytes.empty() || own_.contains(digest_of(bytes))) return;
    heard_.push_back({std::string(channel), {bytes.begin(), bytes.end()}});
    if (heard_.size() > kRemembered) heard_.pop_front();
  }

  [[nodiscard]] bool has_heard() const { return !heard_.empty(); }

  /// @pre has_heard()
  Message next() {
    Message copy = heard_[below(heard_.size())];
    for (std::size_t places = 1 + below(2); places > 0; --places) change(copy.bytes);
    own_.insert(digest_of(copy.bytes));
    return copy;
  }

 private:
  static constexpr std::size_t kRemembered = 400;  // messages of about a second

  static std::uint64_t digest_of(std::span<const std::uint8_t> bytes) {
    return digest({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(rng_.uniform(0.0, static_cast<double>(n))); }
  std::uint8_t byte() { return static_cast<std::uint8_t>(below(256)); }

  void change(std::vector<std::uint8_t>& bytes) {
    const std::size_t at = below(bytes.size());
    switch (below(3)) {
      case 0: bytes[at] ^= static_cast<std::uint8_t>(1U << below(8)); break;
      case 1: bytes[at] = byte(); break;
      default:
        std::generate_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), std::min<std::size_t>(8, bytes.size() - at),
                        [this] { return byte(); });
    }
  }

  Rng rng_;
  std::deque<Message> heard_;
  std::unordered_set<std::uint64_t> own_;
};

}  // namespace tern::testing
