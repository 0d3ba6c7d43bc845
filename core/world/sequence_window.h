// Which of a sender's messages are new, and how many were lost, by their sequence numbers.
#pragma once

#include <cstdint>
#include <optional>

namespace tern {

/// The sequence numbers of one sender on one channel, in the order of arrival. Pure.
///
/// An honest sender counts its messages by one. What is missing up to kShortGap ahead is lost until it comes after all
/// (the newest kRemembered numbers are known one by one). What lies farther ahead, or behind all that is remembered, is
/// believed to be the sender's numbering only when the next number continues it: one false number moves nothing. When
/// the former numbering goes on after all, what was counted as lost because of the other is taken back.
class SequenceWindow {
 public:
  static constexpr std::int64_t kRemembered = 64;
  static constexpr std::int64_t kShortGap = 8;
  /// A hundred seconds at 100 Hz: a listener that was stopped for so long does not refuse the next message.
  static constexpr std::int64_t kLongestGap = 10'000;
  static constexpr std::int64_t kEstablished = 5;

  enum class Verdict {
    New,
    Repeated,  ///< came already, or so old that nobody knows
    Jump,      ///< farther ahead than any loss explains
  };
  /// @param sequence  ≥ 1. The first one begins the count: a listener that joined late has lost nothing.
  Verdict add(std::int64_t sequence);

  /// The sender's numbers may begin anywhere again; what was lost stays counted.
  void begin_anew();

  [[nodiscard]] std::int64_t newest() const { return newest_; }  ///< 0: none yet
  /// 0 for a sender that was heard fewer than kEstablished times: it may be noise.
  [[nodiscard]] std::int64_t lost() const { return heard_ < kEstablished ? 0 : lost_; }

 private:
  Verdict judge(std::int64_t sequence);
  Verdict judge_near(std::int64_t behind);
  void continue_at(std::int64_t candidate, std::int64_t sequence);

  std::int64_t newest_ = 0;
  std::uint64_t seen_ = 0;  ///< bit k: newest_ − k has come
  std::int64_t heard_ = 0;  ///< messages that were new
  std::int64_t lost_ = 0;
  std::optional<std::int64_t> candidate_;  ///< newest of another numbering
  std::optional<std::int64_t> former_;     ///< newest of the numbering that was left …
  std::int64_t counted_ = 0;               ///< … and what was counted as lost then
};

}  // namespace tern
