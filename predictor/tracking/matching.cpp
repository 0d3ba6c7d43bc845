#include "predictor/tracking/matching.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "predictor/tracking/assignment.h"

namespace tern {
namespace {

// The index of the object with this id; objects.size() if there is none. @pre objects ascend by id
std::size_t find_object(const std::vector<TrackedObject>& objects, std::int64_t id) {
  const auto found = std::ranges::lower_bound(objects, id, {}, &TrackedObject::id);
  return found != objects.end() && found->id == id ? static_cast<std::size_t>(found - objects.begin()) : objects.size();
}

void match_by_id(const std::vector<TrackedObject>& objects, const std::vector<Detection>& detections,
                 Matching& matching) {
  for (std::size_t d = 0; d < detections.size(); ++d) {
    if (detections[d].track_id == kNoTrackId || matching.taken[d] || matching.anonymous[d]) continue;
    const std::size_t o = find_object(objects, detections[d].track_id);
    if (o == objects.size() || matching.detection_of[o] != kNoDetection) continue;
    matching.detection_of[o] = static_cast<int>(d);
    matching.taken[d] = true;
  }
}

Vec3 largest_variance(const std::vector<Detection>& detections, const std::vector<std::size_t>& of) {
  Vec3 variance = Vec3::Zero();
  for (const std::size_t d : of) variance = variance.cwiseMax(detections[d].variance);
  return variance;
}

// For each detection: whether ids were exchanged, because it lies outside the gate of its id's track but inside another
// track's.
std::vector<bool> exchanged(const std::vector<TrackedObject>& objects, const std::vector<Detection>& detections,
                            const MatchCost& match_cost, const GateBox& gate_box) {
  std::vector<bool> is_exchanged(detections.size(), false);
  const auto fits = [&](const TrackedObject& o, std::size_t d) { return std::isfinite(match_cost(o, detections[d])); };
  std::vector<std::size_t> outside;
  for (std::size_t d = 0; d < detections.size(); ++d) {
    if (detections[d].track_id == kNoTrackId) continue;
    const std::size_t own = find_object(objects, detections[d].track_id);
    if (own != objects.size() && !fits(objects[own], d)) outside.push_back(d);
  }
  if (outside.empty()) return is_exchanged;
  const Vec3 variance = largest_variance(detections, outside);
  for (const TrackedObject& object : objects) {
    const Box within = gate_box(object, variance);
    for (const std::size_t d : outside) {
      if (is_exchanged[d] || !within.contains(detections[d].position)) continue;
      is_exchanged[d] = fits(object, d);
    }
  }
  return is_exchanged;
}

// Detections in order of x, so that a box is searched without looking at all.
class Candidates {
 public:
  // @param columns  indices of the detections to search
  Candidates(const std::vector<Detection>& detections, const std::vector<std::size_t>& columns) {
    for (std::size_t c = 0; c < columns.size(); ++c) by_x_.push_back({detections[columns[c]].position, c});
    std::ranges::sort(by_x_, {}, [](const Candidate& a) { return std::pair(a.position.x(), a.column); });
  }

  // The columns within a box, ascending: all, or the kMaxCandidates nearest to its centre (by its extents).
  const std::vector<std::size_t>& within(const Box& box) {
    near_.clear();
    const Vec3 centre = box.center(), half = 0.5 * box.sizes();
    auto next = std::ranges::lower_bound(by_x_, box.min().x(), {}, [](const Candidate& a) { return a.position.x(); });
    for (; next != by_x_.end() && next->position.x() <= box.max().x(); ++next) {
      if (!box.contains(next->position)) continue;
      near_.emplace_back((next->position - centre).cwiseQuotient(half).squaredNorm(), next->column);
    }
    if (near_.size() > kMaxCandidates) {
      std::ranges::nth_element(near_, near_.begin() + static_cast<std::ptrdiff_t>(kMaxCandidates));
      near_.resize(kMaxCandidates);
    }
    columns_.clear();
    for (const auto& [distance, column] : near_) columns_.push_back(column);
    std::ranges::sort(columns_);
    return columns_;
  }

 private:
  struct Candidate {
    Vec3 position;
    std::size_t column;
  };
  std::vector<Candidate> by_x_;
  std::vector<std::pair<double, std::size_t>> near_;
  std::vector<std::size_t> columns_;
};

// Matches free objects with the given confirmation and free anonymous detections.
void match_by_distance(const std::vector<TrackedObject>& objects, const std::vector<Detection>& detections,
                       bool confirmed, const MatchCost& match_cost, const GateBox& gate_box, Matching& matching) {
  std::vector<std::size_t> rows, columns;
  for (std::size_t o = 0; o < objects.size(); ++o) {
    if (objects[o].confirmed == confirmed && matching.detection_of[o] == kNoDetection) rows.push_back(o);
  }
  for (std::size_t d = 0; d < detections.size(); ++d) {
    if (!matching.taken[d] && matching.anonymous[d]) columns.push_back(d);
  }
  if (rows.empty() || columns.empty()) return;
  const Vec3 variance = largest_variance(detections, columns);
  Candidates candidates(detections, columns);
  std::vector<Pairing> pairings;
  double dearest = 0.0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const TrackedObject& object = objects[rows[r]];
    for (const std::size_t c : candidates.within(gate_box(object, variance))) {
      const double cost = match_cost(object, detections[columns[c]]);
      if (!std::isfinite(cost)) continue;
      pairings.push_back({r, c, cost});
      dearest = std::max(dearest, cost);
    }
  }
  const std::vector<int> column_of = assign(rows.size(), columns.size(), pairings, dearest + 1.0);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (column_of[r] == kUnassigned) continue;
    const std::size_t d = columns[static_cast<std::size_t>(column_of[r])];
    matching.detection_of[rows[r]] = static_cast<int>(d);
    matching.taken[d] = true;
  }
}

}  // namespace

Matching match(const std::vector<TrackedObject>& objects, const std::vector<Detection>& detections,
               const MatchCost& match_cost, const GateBox& gate_box) {
  Matching matching{std::vector<int>(objects.size(), kNoDetection), std::vector<bool>(detections.size(), false), {}};
  matching.anonymous = exchanged(objects, detections, match_cost, gate_box);
  for (std::size_t d = 0; d < detections.size(); ++d) {
    if (detections[d].track_id == kNoTrackId) matching.anonymous[d] = true;
  }
  match_by_id(objects, detections, matching);
  match_by_distance(objects, detections, true, match_cost, gate_box, matching);
  match_by_distance(objects, detections, false, match_cost, gate_box, matching);
  matching.anonymous.assign(detections.size(), false);
  match_by_id(objects, detections, matching);
  return matching;
}

}  // namespace tern
