#include "campaign/statistics/coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace tern {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, kPredictionClasses> kClassNames = [] {
  std::array<const char*, kPredictionClasses> names{"declared", "unseen", "at rest"};
  std::ranges::copy(kWords<TrackAge>, names.begin() + 3);
  return names;
}();

std::optional<PredictionClass> class_named(const std::string& name) {
  const auto found = std::ranges::find(kClassNames, name);
  if (found == kClassNames.end()) return std::nullopt;
  return static_cast<PredictionClass>(found - kClassNames.begin());
}

std::optional<std::size_t> horizon_named(const std::string& name) {
  for (std::size_t h = 0; h < kHorizons; ++h) {
    if (horizon_name(h) == name) return h;
  }
  return std::nullopt;
}

// Adds the bounds, which follow from the groups that have intervals.
CoverageShare bounded(CoverageShare share, std::vector<GroupShare> groups) {
  std::erase_if(groups, [](const GroupShare& g) { return g.all <= 0.0; });
  share.groups = static_cast<std::int64_t>(groups.size());
  share.interval = share_interval(groups);
  share.upper_bound = share_upper_bound(std::move(groups), kFalseAlarm / kTestedShares);
  return share;
}

GroupShare group_of(std::int64_t made, std::int64_t covered) {
  return {static_cast<double>(made), static_cast<double>(covered)};
}

CoverageShare class_share(const std::vector<Coverage>& groups, const Coverage& sum, PredictionClass kind, std::size_t h,
                          int level) {
  const IntervalCount& all = sum.intervals.at({kind, h});
  const bool certain = kind == PredictionClass::Declared;
  CoverageShare share;
  share.what = to_string(kind);
  share.horizon = horizon_name(h);
  share.made = all.made;
  share.confidence = certain ? 1.0 : confidence_at(sum.confidence, level);
  share.covered = all.covered[idx(level)];
  share.half_m = all.half_width_sum_m / static_cast<double>(all.made);
  std::vector<GroupShare> counts;
  for (const Coverage& group : groups) {
    const auto one = group.intervals.find({kind, h});
    if (one == group.intervals.end()) continue;
    counts.push_back(group_of(one->second.made, one->second.covered[idx(level)]));
  }
  return bounded(std::move(share), std::move(counts));
}

CoverageShare claim_share(const std::vector<Coverage>& groups, const Coverage& sum, int level) {
  const ClaimCount& all = sum.claims[idx(level)];
  CoverageShare share;
  share.what = kPlans;
  share.horizon = horizon_name(kToItsEnd);
  share.made = all.made;
  share.covered = all.covered;
  share.confidence = confidence_at(sum.confidence, level);
  std::vector<GroupShare> counts;
  for (const Coverage& group : groups) {
    const ClaimCount& one = group.claims[idx(level)];
    counts.push_back(group_of(one.made, one.covered));
  }
  return bounded(std::move(share), std::move(counts));
}

// The shares of one class, or those of plans at one level.
using Row = std::vector<const CoverageShare*>;

std::string heading(const char* title) {
  std::string text = fmt::format("  {:<28}", title);
  for (std::size_t h = 0; h < kHorizons; ++h) {
    const std::string name = horizon_name(h);
    text += fmt::format("{:<20}", h == kToItsEnd ? name : "to " + name + " s");
  }
  return text + "\n";
}

// The confidence of level 0, and lower ones that are refuted.
std::vector<double> confidences(const Row& row) {
  std::vector<double> all{row.front()->confidence};
  for (const CoverageShare* s : row) {
    if (s->is_refuted() && std::ranges::find(all, s->confidence) == all.end()) all.push_back(s->confidence);
  }
  return all;
}

template <class Format>
std::string line(const std::string& title, const Row& row, double confidence, const Format& format) {
  std::string text = fmt::format("  {:<28}", title);
  for (std::size_t h = 0; h < kHorizons; ++h) {
    const auto here = std::ranges::find_if(
        row, [&](const CoverageShare* s) { return s->confidence == confidence && s->horizon == horizon_name(h); });
    text += fmt::format("{:<20}", here == row.end() ? "" : format(**here));
  }
  return text + "\n";
}

std::string coverage_line(const Row& row, double confidence) {
  return line(fmt::format("{:<12}{}", row.front()->what, confidence), row, confidence, [](const CoverageShare& s) {
    return fmt::format("{:.3f} [{:.3f} {:.3f}]{}", s.share(), s.interval.low, s.interval.high,
                       s.is_refuted() ? "!" : "");
  });
}

std::string width_line(const Row& row) {
  return line(row.front()->what, row, row.front()->confidence,
              [](const CoverageShare& s) { return fmt::format("{:.3f}", s.half_m); });
}

IntervalCount interval_count(const Json& numbers) {
  IntervalCount count;
  count.made = numbers.at(0);
  count.half_width_sum_m = numbers.at(1).get<double>() * static_cast<double>(count.made);
  for (std::size_t level = 0; level < count.covered.size(); ++level) count.covered[level] = numbers.at(level + 2);
  return count;
}

}  // namespace

const char* to_string(PredictionClass kind) { return kClassNames[idx(kind)]; }

std::string horizon_name(std::size_t horizon) {
  return horizon == kToItsEnd ? "whole" : fmt::format("{}", kCoverageHorizons[horizon]);
}

IntervalCount& IntervalCount::operator+=(const IntervalCount& other) {
  made += other.made;
  half_width_sum_m += other.half_width_sum_m;
  for (std::size_t level = 0; level < covered.size(); ++level) covered[level] += other.covered[level];
  return *this;
}

ClaimCount& ClaimCount::operator+=(const ClaimCount& other) {
  made += other.made;
  covered += other.covered;
  return *this;
}

Coverage& Coverage::operator+=(const Coverage& other) {
  confidence = std::min(confidence, other.confidence);
  for (const auto& [key, count] : other.intervals) intervals[key] += count;
  for (std::size_t level = 0; level < claims.size(); ++level) claims[level] += other.claims[level];
  return *this;
}

std::string to_text(const Coverage& coverage) {
  if (coverage.intervals.empty()) return "";
  Json json = {{"confidence", coverage.confidence}};
  for (const auto& [key, count] : coverage.intervals) {
    const double half_m = count.half_width_sum_m / static_cast<double>(count.made);
    Json numbers = {count.made, std::round(half_m * 1e4) * 1e-4};
    for (const std::int64_t covered : count.covered) numbers.push_back(covered);
    json[to_string(key.first)][horizon_name(key.second)] = std::move(numbers);
  }
  json["claims"] = Json::array();
  for (const ClaimCount& claim : coverage.claims) json["claims"].push_back({claim.made, claim.covered});
  return json.dump();
}

std::optional<Coverage> parse_coverage(std::string_view text) try {
  Coverage coverage;
  if (text.empty()) return coverage;
  const Json json = Json::parse(text);
  coverage.confidence = json.at("confidence");
  for (std::size_t level = 0; level < coverage.claims.size(); ++level) {
    coverage.claims[level] = {json.at("claims").at(level).at(0), json.at("claims").at(level).at(1)};
  }
  for (const auto& [name, horizons] : json.items()) {
    if (name == "confidence" || name == "claims") continue;
    const auto kind = class_named(name);
    if (!kind) return std::nullopt;
    for (const auto& [ahead, numbers] : horizons.items()) {
      const auto horizon = horizon_named(ahead);
      if (!horizon) return std::nullopt;
      coverage.intervals[{*kind, *horizon}] = interval_count(numbers);
    }
  }
  return coverage;
} catch (const Json::exception&) {
  return std::nullopt;
}

std::vector<CoverageShare> coverage_shares(const std::vector<Coverage>& groups) {
  Coverage sum;
  for (const Coverage& group : groups) sum += group;
  std::vector<CoverageShare> shares;
  for (const auto& [key, count] : sum.intervals) {
    const int levels = key.first == PredictionClass::Declared ? 1 : kLevels;
    for (int level = 0; level < levels; ++level) {
      shares.push_back(class_share(groups, sum, key.first, key.second, level));
    }
  }
  for (int level = 0; level < kLevels; ++level) {
    if (sum.claims[idx(level)].made > 0) shares.push_back(claim_share(groups, sum, level));
  }
  return shares;
}

std::string to_text(const std::vector<CoverageShare>& shares) {
  if (shares.empty()) return "";
  std::vector<Row> rows;
  for (const CoverageShare& s : shares) {
    if (rows.empty() || rows.back().front()->what != s.what || s.what == kPlans) rows.emplace_back();
    rows.back().push_back(&s);
  }
  std::string shares_text = heading("covered, share [95 %]");
  std::string widths = heading("half-width, m");
  for (const Row& row : rows) {
    for (const double confidence : confidences(row)) shares_text += coverage_line(row, confidence);
    if (row.front()->what != kPlans) widths += width_line(row);
  }
  return shares_text + widths;
}

}  // namespace tern
