// What is amiss with the predictor's inputs and its sets, in words for HEARTBEAT and the log.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "core/base/time.h"

namespace tern {

/// An input that was used and then was not for longer is silent (the planner calls a world of that age stale).
inline constexpr Duration kInputsStopped{300'000};
/// HEARTBEAT, at 2 Hz, tells of a trouble until it has not happened for so long.
inline constexpr Duration kTroubleSaid{5'000'000};
/// Inputs that are watched; forged sensors must not fill the memory.
inline constexpr std::size_t kMaxInputs = 64;
/// Silent inputs that are named, so that they fit into a heartbeat with all troubles; the others are counted.
inline constexpr std::size_t kMaxNamed = 6;

/// What was used less often is not expected to come again: a false sensor that was heard once is not missed.
inline constexpr std::int64_t kExpectedAfter = 3;

/// An input is named in words: "obstacle observations of sensor 2". What was used kExpectedAfter times is expected for
/// ever. Not thread-safe.
class InputWatch {
 public:
  /// A message of `input` was used.
  void used(const std::string& input, UTime now);
  /// Something of this kind happened. Logged as a warning unless the last of its kind is at most kTroubleSaid ago.
  /// @param text  at most 150 bytes
  void trouble(const std::string& kind, const std::string& text, UTime now);

  /// "declared motions (silent for 0.8 s), …", by name; empty when none is.
  [[nodiscard]] std::string silent(UTime now) const;
  /// The newest text of each kind, separated by "; "; empty when nothing happened within kTroubleSaid.
  [[nodiscard]] std::string troubles(UTime now) const;

 private:
  struct Trouble {
    std::string text;
    UTime at;
  };
  struct Use {
    UTime last;
    std::int64_t times = 0;
  };
  std::map<std::string, Use> used_;
  std::map<std::string, Trouble> troubles_;
};

}  // namespace tern
