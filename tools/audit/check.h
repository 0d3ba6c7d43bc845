// One check of the audit: what it claims, how often it was checked, and what was found.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/base/time.h"

namespace tern::audit {

/// Stands for a missing track or obstacle.
inline constexpr std::int64_t kNoObstacle = INT64_MIN;

/// One violation.
struct Finding {
  UTime at;                             ///< vehicle's clock
  std::string what;                     ///< in words, with value and limit
  std::int64_t request = 0;             ///< id; 0: belongs to no request
  std::int64_t obstacle = kNoObstacle;  ///< id of a track or obstacle
};
/// A check stores its first kMaxFindings findings and counts the others.
inline constexpr std::size_t kMaxFindings = 50;

/// A check has one of the first three. The verdict on a flight is Held, Broken, or one of the last two:
///
/// * Incomplete: all is well in the part of the flight that the log holds.
/// * NotJudged: the log holds no flight, or too little of one.
enum class Verdict { Held, Broken, NotChecked, Incomplete, NotJudged };
/// Returns the verdict in lower-case words.
const char* to_string(Verdict verdict);

struct Check {
  std::string name;          ///< one word: "clearance"
  std::string claim;         ///< the statement that holds if nothing is broken
  std::string summary = {};  ///< the result in words
  std::int64_t checked = 0, broken = 0;
  std::vector<Finding> findings = {};
  std::map<std::string, std::int64_t> unchecked = {};  ///< reason → how often something could not be checked for it
  std::vector<std::pair<std::string, double>> measures = {};  ///< name with unit → value; never NaN

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
