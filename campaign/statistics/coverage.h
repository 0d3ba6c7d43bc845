// Coverage of prediction intervals: counts that can be summed over flights, and shares with bounds.
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
#include "core/world/track_class.h"

namespace tern {

/// The class of a prediction when it is made. A receiver of PREDICTIONS can tell the age of a track in view, and
/// whether it rests. The predictor also knows the kind of its motion (TrackClass).
enum class PredictionClass : std::uint8_t {
  Declared = 0,  ///< declared by its owner, or static: certain
  Unseen = 1,    ///< estimated; no detection met its box in the last 0.3 s
  AtRest = 2,    ///< estimated and in view; the predicted centre stays within kRestingWay of its place for a second
  New = 3,       ///< estimated, in view and moving; the track's age_in_predictions() is TrackAge::New
  Young = 4,     ///< the same, TrackAge::Young
  Grown = 5,     ///< the same, TrackAge::Grown
  Old = 6,       ///< the same, TrackAge::Old
};
inline constexpr std::size_t kPredictionClasses = 3 + kTrackAges;
constexpr PredictionClass prediction_class(TrackAge moving) { return static_cast<PredictionClass>(3 + idx(moving)); }
inline constexpr double kRestingWay = 0.1;  ///< m
/// "declared", "unseen", "at rest", "new", "young", "grown", "old".
const char* to_string(PredictionClass kind);

/// A prediction interval is checked up to each of kCoverageHorizons after it was made. The last of them stands for the
/// interval's own end, wherever that is.
inline constexpr std::size_t kToItsEnd = kHorizons - 1;
/// "0.25", "0.5", "1", "2", "whole".
std::string horizon_name(std::size_t horizon);

/// The prediction intervals of one class up to one horizon. Each is the prediction of one track in one set of
/// PREDICTIONS.
struct IntervalCount {
  std::int64_t made = 0;
  std::array<std::int64_t, kLevels> covered{};  ///< by level of confidence, with that level's α
  double half_width_sum_m = 0.0;                ///< Σ of α at the horizon, level 0, mean of the axes, m
  IntervalCount& operator+=(const IntervalCount& other);
  friend bool operator==(const IntervalCount&, const IntervalCount&) = default;
};

/// The claims of plans at one level. A plan makes one claim for each track that it keeps clear of. The claim is that
/// from t_s until the plan's end and hold the track stays within the box that the plan used.
struct ClaimCount {
  std::int64_t made = 0, covered = 0;
  ClaimCount& operator+=(const ClaimCount& other);
  friend bool operator==(const ClaimCount&, const ClaimCount&) = default;
};

/// The counts of one flight, or of one obstacle in it.
struct Coverage {
  double confidence = 1.0;                                                     ///< the least of all sets, at level 0
  std::map<std::pair<PredictionClass, std::size_t>, IntervalCount> intervals;  ///< by class and horizon
  std::array<ClaimCount, kLevels> claims{};
  Coverage& operator+=(const Coverage& other);
  friend bool operator==(const Coverage&, const Coverage&) = default;
};

/// {"confidence": 0.99, "old": {"0.25": [made, mean half-width, covered, covered, …], …},
///  "claims": [[made, covered], …]}; "" without intervals.
std::string to_text(const Coverage& coverage);
/// Parses the text of to_text(), with widths to 0.1 mm. @return nullopt for other texts.
std::optional<Coverage> parse_coverage(std::string_view text);

inline constexpr const char* kPlans = "plans";

/// The covered share of one class and horizon, or of the claims of plans. Groups must be independent of each other;
/// within a group nothing is assumed. A group is an obstacle of a flight, or a flight of a campaign.
struct CoverageShare {
  std::string what;         ///< a class, or kPlans
  std::string horizon;      ///< horizon_name(); for plans "whole"
  double confidence = 0.0;  ///< the stated one
  std::int64_t groups = 0, made = 0, covered = 0;
  Interval interval;                                         ///< share_interval() at 5 %
  double upper_bound = 1.0;                                  ///< share_upper_bound() at kFalseAlarm/kTestedShares
  double half_m = std::numeric_limits<double>::quiet_NaN();  ///< mean half-width; for plans NaN

  [[nodiscard]] double share() const { return static_cast<double>(covered) / static_cast<double>(made); }
  /// True if the stated confidence is too high for what was observed.
  [[nodiscard]] bool is_refuted() const { return upper_bound < confidence; }
};

/// The probability that any share of a flight or campaign is_refuted() although all confidences are true. It is divided
/// equally among kTestedShares tests (Bonferroni). Declared tracks are not tested, because they are certain.
inline constexpr double kFalseAlarm = 1e-3;
inline constexpr double kTestedShares = (kPredictionClasses - 1) * kHorizons * kLevels + kLevels;

/// Returns the shares by class, horizon and level, then those of plans by level, as far as intervals were made.
std::vector<CoverageShare> coverage_shares(const std::vector<Coverage>& groups);

/// A table for people: for each class and for plans the covered share with its interval, then the half-widths. Lower
/// levels appear only if refuted; "!" marks a refuted share. "" if there are no shares.
std::string to_text(const std::vector<CoverageShare>& shares);

}  // namespace tern
