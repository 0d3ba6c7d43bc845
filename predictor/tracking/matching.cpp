#include "predictor/tracking/matching.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "predictor/tracking/assignment.h"

namespace tern {
namespace {

constexpr double kBeyond = std::numeric_limits<double>::infinity();

void match_by_id(const std::vector<TrackedObject>& objects, const std::vector<Detection>& detections,
                 Matching& matching) {
  for (std::size_t d = 0; d < detections.size(); ++d) {
    if (detections[d].track_id == kNoTrackId || matching.taken[d] || matching.anonymous[d]) continue;
    const auto object =
        std::ranges::find_if(objects, [&](const TrackedObject& o) { return o.id == detections[d].track_id; });
    if (object == objects.end()) continue;
    int& mine = matching.detection_of[static_cast<std::size_t>(object - objects.begin())];
    if (mine != kNoDetection) continue;
    mine = static_cast<int>(d);
    matching.taken[d] = true;
  }
}

// True if a detection lies outside the gate of its id's track but inside another track's: ids were exchanged.
bool is_exchanged(const std::vector<TrackedObject>& objects, const Detection& detection, const MatchCost& match_cost) {
  const auto fits = [&](const TrackedObject& o) { return std::isfinite(match_cost(o, detection)); };
  const auto own = std::ranges::find_if(objects, [&](const TrackedObject& o) { return o.id == detection.track_id; });
  return own != objects.end() && !fits(*own) && std::ranges::any_of(objects, fits);
}

// The largest cost within the gate; 0 without such pairs.
double dearest(const Eigen::MatrixXd& cost) {
  return cost.unaryExpr([](double c) { return std::isfinite(c) ? c : 0.0; }).maxCoeff();
}

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
  Vec3 variance = Vec3::Zero();
  for (const std::size_t d : columns) variance = variance.cwiseMax(detections[d].variance);
  Eigen::MatrixXd cost = Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(rows.size()),
                                                   static_cast<Eigen::Index>(columns.size()), kBeyond);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const TrackedObject& object = objects[rows[r]];
    const Box within = gate_box(object, variance);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const Detection& detection = detections[columns[c]];
      if (!within.contains(detection.position)) continue;
      cost(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = match_cost(object, detection);
    }
  }
  const std::vector<int> column_of = assign(cost, dearest(cost) + 1.0);
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
  for (const Detection& detection : detections) {
    matching.anonymous.push_back(detection.track_id == kNoTrackId || is_exchanged(objects, detection, match_cost));
  }
  match_by_id(objects, detections, matching);
  match_by_distance(objects, detections, true, match_cost, gate_box, matching);
  match_by_distance(objects, detections, false, match_cost, gate_box, matching);
  matching.anonymous.assign(detections.size(), false);
  match_by_id(objects, detections, matching);
  return matching;
}

}  // namespace tern
