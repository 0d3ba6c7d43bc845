#include "campaign/experiments/figure_data.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace tern {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kCurveSamples = 24;

double rounded(double x) { return std::round(x * 1e4) / 1e4; }

Json to_json(const Vec3& p) { return {rounded(p.x()), rounded(p.y()), rounded(p.z())}; }
Json to_json(const Box& box) { return {to_json(Vec3(box.min())), to_json(Vec3(box.max()))}; }

Json to_json(const Points& points) {
  Json rows = Json::array();
  for (Eigen::Index k = 0; k < points.cols(); ++k) rows.push_back(to_json(Vec3(points.col(k))));
  return rows;
}

Json regions_of(const SemanticsSpec& semantics) {
  Json regions = Json::array();
  if (!semantics.enabled) return regions;
  for (const Region& region : semantics.regions) {
    const auto label = std::find_if(semantics.classes.begin(), semantics.classes.end(),
                                    [&](const auto& c) { return c.first == region.class_name; });
    regions.push_back({{"name", region.name}, {"label", label->second}, {"box", to_json(region.bounds())}});
  }
  return regions;
}

Json segments_of(const SearchOutcome& outcome) {
  const ClampedSpline spline = outcome.trajectory.spline();
  Json segments = Json::array();
  for (int j = 0; j < spline.intervals(); ++j) {
    const SearchSegment& segment = outcome.segments[idx(j)];
    Json curve = Json::array();
    for (int k = 0; k <= kCurveSamples; ++k) {
      const double t = spline.interval_s() * (j + static_cast<double>(k) / kCurveSamples);
      curve.push_back(to_json(spline.sample(std::min(t, spline.duration_s())).p));
    }
    const UTime middle = outcome.trajectory.start + Duration::from_seconds((j + 0.5) * spline.interval_s());
    Json plane = nullptr;
    if (segment.gap_m > 0.0) plane = {to_json(segment.plane.n), -segment.plane.d};
    segments.push_back({{"curve", std::move(curve)},
                        {"curve_hull", to_json(segment.curve_hull)},
                        {"obstacle_hull", to_json(segment.obstacle_hull)},
                        {"plane", std::move(plane)},
                        {"gap_m", rounded(segment.gap_m)},
                        {"obstacle", to_json(Vec3(outcome.obstacle.bounds(middle, middle).center()))}});
  }
  return segments;
}

/// Returns the time at which the flight passes x.
double time_at(const FlightTrack& track, double x) {
  const auto nearer = [x](const TrackPoint& a, const TrackPoint& b) {
    return std::abs(a.p.x() - x) < std::abs(b.p.x() - x);
  };
  return std::min_element(track.points.begin(), track.points.end(), nearer)->t_s;
}

Json flight_of(const FlightTrack& track) {
  Json rows = Json::array();
  for (const TrackPoint& point : track.points) {
    rows.push_back({rounded(point.t_s), rounded(point.p.x()), rounded(point.p.y()), rounded(point.p.z()),
                    rounded(point.speed_mps)});
  }
  return rows;
}

}  // namespace

std::string search_data(const std::vector<SearchOutcome>& outcomes) {
  Json cases = Json::array();
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    const SearchOutcome& outcome = outcomes[k];
    cases.push_back({{"title", search_cases().at(k).title},
                     {"start", to_json(outcome.scenario.uav.start)},
                     {"goal", to_json(outcome.scenario.uav.goal)},
                     {"regions", regions_of(outcome.scenario.semantics)},
                     {"half_extents", to_json(outcome.obstacle.half_extents)},
                     {"segments", outcome.found ? segments_of(outcome) : Json::array()}});
  }
  return cases.dump() + "\n";
}

std::string corridor_data(const FlightTrack& without, const FlightTrack& with) {
  Json obstacles = Json::array();
  for (const WorldObstacle& o : with.world.obstacles) {
    // Two iterations find where a moving obstacle is when the vehicle passes it.
    double t = time_at(with, o.at(0.0).p.x());
    if (o.moves()) t = time_at(with, o.at(t).p.x());
    obstacles.push_back({{"moves", o.moves()}, {"box", to_json(o.box(t))}});
  }
  const Json data = {{"regions", regions_of(with.scenario.semantics)},
                     {"obstacles", std::move(obstacles)},
                     {"without", flight_of(without)},
                     {"with", flight_of(with)}};
  return data.dump() + "\n";
}

}  // namespace tern
