// Promised against kept: how many predictions held, and how wide they were. Counts that can be summed over flights.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "campaign/statistics/grouped_share.h"
#include "core/world/track.h"

namespace tern {

/// What predictions have in common, by what is known when they are made: nothing of what came of them.
enum class PredictionClass : std::uint8_t {
  Declared = 0,  ///< promised by its owner, or static: certain
  Unseen = 1,    ///< estimated; no detection met its box in the last 0.3 s
  AtRest = 2,  ///< estimated and in view; the centre is predicted to stay within kRestingWay of its place for a second
  New = 3,     ///< in view, estimated to move; its track is in PREDICTIONS for at most 0.1 s
  Young = 4,   ///< at most 0.3 s
  Grown = 5,   ///< at most 1 s
  Old = 6,     ///< longer
};
inline constexpr std::size_t kPredictionClasses = 7;
inline constexpr double kRestingWay = 0.1;  ///< m
/// "declared", "unseen", "at rest", "new", "young", "grown", "old".
const char* to_string(PredictionClass kind);

/// A promise is judged at all times from its making up to so long ahead, s; the last one up to its own end.
inline constexpr std::array<double, 5> kCoveredAhead{0.25, 0.5, 1.0, 2.0, std::numeric_limits<double>::infinity()};
inline constexpr std::size_t kHorizons = kCoveredAhead.size();
/// "0.25", "0.5", "1", "2", "whole".
std::string horizon_name(std::size_t horizon);

/// Promises of one class up to one horizon. A promise is a prediction of one track in one set of PREDICTIONS.
struct PromiseCount {
  std::int64_t made = 0;
  std::array<std::int64_t, kLevels> kept{};  ///< of these, by level of confidence, with the α of that level
  double half_sum_m = 0.0;                   ///< Σ of α at the horizon as promised, mean of the axes, m
  PromiseCount& operator+=(const PromiseCount& other);
  friend bool operator==(const PromiseCount&, const PromiseCount&) = default;
};

/// What plans claimed at one level: a claim is that one track that a plan keeps clear of stays, from t_s until the
/// plan's end and hold, within the box that the plan counted.
struct ClaimCount {
  std::int64_t made = 0, kept = 0;
  ClaimCount& operator+=(const ClaimCount& other);
  friend bool operator==(const ClaimCount&, const ClaimCount&) = default;
};

/// Of one flight, or of one obstacle in it.
struct Coverage {
  double confidence = 1.0;                                                   ///< the least that a set promised
  std::map<std::pair<PredictionClass, std::size_t>, PromiseCount> promises;  ///< by class and horizon
  std::array<ClaimCount, kLevels> claims{};
  Coverage& operator+=(const Coverage& other);
  friend bool operator==(const Coverage&, const Coverage&) = default;
};

/// {"confidence": 0.99, "old": {"0.25": [made, mean half-width, kept, kept, …], …}, "claims": [[made, kept], …]}; "" if
/// nothing was promised.
std::string to_text(const Coverage& coverage);
/// What to_text wrote, widths to 0.1 mm. @return nullopt for other texts.
std::optional<Coverage> parse_coverage(std::string_view text);

inline constexpr const char* kPlans = "plans";

/// A promise and what became of it. Groups are independent of each other, within one anything goes: the obstacles of a
/// flight, or the flights of a campaign.
struct KeptShare {
  std::string what;         ///< a class, or kPlans
  std::string horizon;      ///< horizon_name(); of plans "whole"
  double confidence = 0.0;  ///< promised
  std::int64_t groups = 0, made = 0, kept = 0;
  Interval interval;                                         ///< share_interval() at 5 %
  double greatest = 1.0;                                     ///< greatest_share() at kFalseAlarm/kJudgedShares
  double half_m = std::numeric_limits<double>::quiet_NaN();  ///< mean half-width as promised; of plans NaN

  [[nodiscard]] double share() const { return static_cast<double>(kept) / static_cast<double>(made); }
  /// The promise cannot have been true.
  [[nodiscard]] bool is_broken() const { return greatest < confidence; }
};

/// With at most this probability any of the shares of a flight (or campaign) whose promises are all true is_broken():
/// each of kJudgedShares tests has its part of it (Bonferroni). What is declared is not among them; it is certain.
inline constexpr double kFalseAlarm = 1e-3;
inline constexpr double kJudgedShares = (kPredictionClasses - 1) * kHorizons * kLevels + kLevels;

/// By class, horizon and level, then the claims of plans by level; only what was promised at all.
std::vector<KeptShare> kept_shares(const std::vector<Coverage>& groups);

/// A table for people: of each class and of plans the share kept with its interval, and the half-widths. Of the lower
/// levels those that are broken; "!" marks what is broken. "" when there is nothing.
std::string to_text(const std::vector<KeptShare>& shares);

}  // namespace tern
