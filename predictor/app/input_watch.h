// Watches the predictor's inputs, and reports silent inputs and troubles in words for HEARTBEAT and the log.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "core/base/time.h"

namespace tern {

/// An input is silent if it was not used for longer than this. The planner calls a world of that age stale.
inline constexpr Duration kInputsStopped{300'000};
/// A trouble is reported on HEARTBEAT until it has not happened for this long.
inline constexpr Duration kTroubleReported{5'000'000};
/// The number of inputs that are watched; forged sensors must not fill the memory.
inline constexpr std::size_t kMaxInputs = 64;
/// The number of silent inputs that are named, so that they fit into a heartbeat with all troubles. The rest is
/// counted.
inline constexpr std::size_t kMaxNamed = 6;

/// An input is expected to continue once it was used this often. A false sensor that was received once is not missed.
inline constexpr std::int64_t kExpectedAfter = 3;

/// Inputs are named in words: "obstacle observations of sensor 2". Not thread-safe.
class InputWatch {
 public:
  /// Notes that a message of `input` was used.
  void used(const std::string& input, UTime now);
  /// Notes a trouble of this kind. Logs it as a warning unless one of its kind happened within kTroubleReported.
  /// @param text  at most 150 bytes
  void trouble(const std::string& kind, const std::string& text, UTime now);

  /// Returns the expected inputs that are silent, by name: "declared motions (silent for 0.8 s), …". Empty if none is.
  [[nodiscard]] std::string silent(UTime now) const;
  /// Returns the newest text of each kind within kTroubleReported, separated by "; ".
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
