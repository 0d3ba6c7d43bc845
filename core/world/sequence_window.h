// Which of a sender's messages are new, and how many were lost, by their sequence numbers.
#pragma once

#include <cstdint>
#include <optional>

namespace tern {

/// The sequence numbers of one sender on one channel, in the order of arrival. Pure.
///
/// An honest sender counts its messages by one. What a number at most kShortGap ahead leaves out is lost, until it
/// comes after all. The newest kRemembered numbers are known one by one. What lies farther ahead is believed only when
/// the next number continues it: one false number moves nothing. What lies behind all that is remembered is refused,
/// until restart(). The former numbering is remembered until the new one is established. Its next number brings it
/// back, and takes back what was counted as lost meanwhile.
class SequenceWindow {
 public:
  static constexpr std::int64_t kRemembered = 64;
  static constexpr std::int64_t kShortGap = 8;
  /// A hundred seconds at 100 Hz: a listener that was stopped for so long does not refuse the next message.
  static constexpr std::int64_t kMaxGap = 10'000;
  static constexpr std::int64_t kEstablished = 5;

  enum class Verdict {
    New,
    Repeated,  ///< came already, or so old that nobody knows
    Jump,      ///< farther ahead than any loss explains
  };
  /// @param sequence  ≥ 1. The first one begins the count: a listener that joined late has lost nothing.
  Verdict add(std::int64_t sequence);

  /// The sender's numbers may begin anywhere again; what was lost stays counted.
  void restart();

  [[nodiscard]] std::int64_t newest() const { return now_.newest; }  ///< 0: none yet
  /// 0 for a sender that was heard fewer than kEstablished times: it may be noise.
  [[nodiscard]] std::int64_t lost() const { return heard_ < kEstablished ? 0 : now_.lost - now_.unsure; }
  /// How many numbers lie below the least that came: senders count from 1. 0 for a sender that may be noise.
  [[nodiscard]] std::int64_t before_first() const { return heard_ < kEstablished ? 0 : least_ - 1; }

 private:
  struct Numbering {
    std::int64_t newest = 0;  ///< 0: none yet
    std::uint64_t seen = 0;   ///< bit k: newest − k has come
    std::int64_t lost = 0;    ///< of this one and those that were believed before it
    std::int64_t gap = 0;     ///< numbers that newest left out …
    std::int64_t unsure = 0;  ///< … and that are missing still
  };
  Verdict judge(std::int64_t sequence);
  Verdict judge_near(std::int64_t behind);
  static bool has_come(const Numbering& numbering, std::int64_t sequence);
  void advance(std::int64_t ahead);
  void continue_at(std::int64_t candidate, std::int64_t sequence);

  Numbering now_;
  std::int64_t heard_ = 0;                 ///< messages that were new
  std::int64_t least_ = 0;                 ///< of all numbers that came; 0: none yet
  std::optional<std::int64_t> candidate_;  ///< newest of another numbering
  std::optional<Numbering> former_;
  std::int64_t continued_ = 0;  ///< messages of this numbering since it replaced the former one
};

}  // namespace tern
