// Decides by sequence numbers which messages of a sender are new and how many were lost.
#pragma once

#include <cstdint>
#include <optional>

namespace tern {

/// Judges the sequence numbers of one sender on one channel, in the order of arrival.
///
/// | number, relative to the newest             | verdict  | effect                                             |
/// |--------------------------------------------|----------|----------------------------------------------------|
/// | the first one                              | New      | it is the newest                                   |
/// | 1 … kShortGap ahead                        | New      | it is the newest; the numbers between are lost     |
/// | kShortGap + 1 … kMaxGap ahead              | New      | it is the candidate of a new numbering             |
/// | more than kMaxGap ahead                    | Jump     | it is the candidate of a new numbering             |
/// | 1 … kShortGap ahead of the candidate       | New      | the new numbering is used; the gap to it is lost   |
/// | fewer than kRemembered behind, not seen    | New      | it is no longer lost                               |
/// | the candidate again, seen, farther behind  | Repeated | none                                               |
///
/// So a single false number changes nothing. The old numbering is remembered until kEstablished messages have
/// continued the new one. If a number of the old one arrives before that, the old numbering returns with its count of
/// losses.
class SequenceWindow {
 public:
  static constexpr std::int64_t kRemembered = 64;
  static constexpr std::int64_t kShortGap = 8;
  /// 100 s at 100 Hz: a receiver that was stopped for this long still accepts the next message.
  static constexpr std::int64_t kMaxGap = 10'000;
  static constexpr std::int64_t kEstablished = 5;

  enum class Verdict {
    New,
    Repeated,  ///< it arrived already, or is too old to tell
    Jump,      ///< it is farther ahead than losses explain
  };
  /// Judges one number. Losses count from the first number on, so a receiver that joins late has no losses.
  /// @pre sequence ≥ 1
  Verdict add(std::int64_t sequence);

  /// Lets the sender's numbers begin anywhere again. Losses stay counted.
  void restart();

  [[nodiscard]] std::int64_t newest() const { return now_.newest; }  ///< 0: none yet
  /// Returns the number of lost messages. The numbers skipped just below the newest one are not included, because those
  /// messages may still arrive. It is 0 before kEstablished messages, because the sender may be noise.
  [[nodiscard]] std::int64_t lost() const { return received_ < kEstablished ? 0 : now_.lost - now_.unsure; }
  /// Returns how many numbers lie below the smallest one that arrived; senders count from 1. It is 0 before
  /// kEstablished messages.
  [[nodiscard]] std::int64_t before_first() const { return received_ < kEstablished ? 0 : smallest_ - 1; }

 private:
  struct Numbering {
    std::int64_t newest = 0;  ///< 0: none yet
    std::uint64_t seen = 0;   ///< bit k: newest − k has arrived
    std::int64_t lost = 0;    ///< in this numbering and those that it replaced
    std::int64_t gap = 0;     ///< numbers that `newest` left out
    std::int64_t unsure = 0;  ///< those of them that are still missing
  };
  Verdict judge(std::int64_t sequence);
  Verdict judge_near(std::int64_t behind);
  static bool has_come(const Numbering& numbering, std::int64_t sequence);
  void advance(std::int64_t ahead);
  void continue_at(std::int64_t candidate, std::int64_t sequence);

  Numbering now_;
  std::int64_t received_ = 0;              ///< new messages
  std::int64_t smallest_ = 0;              ///< the smallest number that arrived; 0: none yet
  std::optional<std::int64_t> candidate_;  ///< newest number of a possible new numbering
  std::optional<Numbering> former_;        ///< the replaced numbering, until the new one is established
  std::int64_t continued_ = 0;             ///< messages of the numbering since it replaced the former one
};

}  // namespace tern
