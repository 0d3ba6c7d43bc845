// One question that the auditor asks of a flight, and its answer.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/base/time.h"

namespace tern::audit {

/// No track, no obstacle.
inline constexpr std::int64_t kNoObstacle = INT64_MIN;

/// One thing that was broken.
struct Finding {
  UTime at;                             ///< vehicle's clock
  std::string what;                     ///< in words, with value and limit
  std::int64_t request = 0;             ///< 0: none in particular
  std::int64_t obstacle = kNoObstacle;  ///< track or obstacle
};
/// Findings of one check that are kept, the first ones; the others are counted.
inline constexpr std::size_t kMaxFindings = 50;

enum class Verdict { Held, Broken, NotChecked };
/// "held", "broken", "not checked".
const char* to_string(Verdict verdict);

struct Check {
  std::string name;          ///< one word: "clearance"
  std::string claim;         ///< what is true if it held
  std::string summary = {};  ///< the numbers, in words
  std::int64_t checked = 0, broken = 0;
  std::vector<Finding> findings = {};
  std::map<std::string, std::int64_t> unchecked = {};  ///< what could not be checked, and how often
  std::vector<std::pair<std::string, double>> measures =
      {};  ///< named numbers with their unit in the name; none is NaN

  void fail(Finding finding) {
    ++broken;
    if (findings.size() < kMaxFindings) findings.push_back(std::move(finding));
  }
  [[nodiscard]] Verdict verdict() const {
    if (broken > 0) return Verdict::Broken;
    return checked > 0 ? Verdict::Held : Verdict::NotChecked;
  }
};

}  // namespace tern::audit
