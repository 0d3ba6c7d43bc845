#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "campaign/experiments/search_experiment.h"
#include "campaign/experiments/svg.h"

namespace tern {
namespace {

constexpr double kRow = 362.0;       // pixels per case
constexpr double kOverview = 470.0;  // width of the path's panel
constexpr double kSide = 136.0;      // of a segment's panel
constexpr const char* kCurve = "#1357a6";
constexpr const char* kObstacle = "#c98a1b";

/// Places on the page of points of space, seen from the direction `towards_viewer`.
struct View {
  Vec3 right, up;
  [[nodiscard]] XY of(const Vec3& p) const { return {right.dot(p), up.dot(p)}; }

  /// Along the plane, as nearly from above as it allows, so that the plane is a line; planes that are nearly level are
  /// seen from the side.
  static View along(const Plane& plane) {
    const Vec3 n = plane.n;
    const Vec3 wanted = std::abs(n.z()) < 0.9 ? Vec3(0, 0, 1) : Vec3(0, -1, 0);
    const Vec3 towards = (wanted - wanted.dot(n) * n).normalized();
    const Vec3 right = (Vec3(1, 0, 0) - towards.x() * towards).normalized();
    return {right, towards.cross(right)};
  }
};

double cross(const XY& o, const XY& a, const XY& b) {
  return (a.first - o.first) * (b.second - o.second) - (a.second - o.second) * (b.first - o.first);
}

/// Monotone chain.
std::vector<XY> outline(std::vector<XY> points) {
  std::sort(points.begin(), points.end());
  std::vector<XY> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const XY& p : points) {
      while (hull.size() >= first + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0.0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

std::vector<XY> seen(const View& view, const Points& points) {
  std::vector<XY> places;
  for (Eigen::Index k = 0; k < points.cols(); ++k) places.push_back(view.of(points.col(k)));
  return outline(places);
}

std::vector<XY> on_page(const PlotFrame& frame, const std::vector<XY>& points) {
  std::vector<XY> places;
  for (const XY& p : points) places.push_back(frame.at(p));
  return places;
}

std::string segment_colour(std::size_t j, std::size_t count) {
  return viridis(0.85 * static_cast<double>(j) / static_cast<double>(count - 1));
}

std::vector<XY> curve_of(const ClampedSpline& spline, int j, const View& view) {
  constexpr int kSamples = 24;
  std::vector<XY> points;
  for (int k = 0; k <= kSamples; ++k) {
    const double t = spline.interval_s() * (j + static_cast<double>(k) / kSamples);
    points.push_back(view.of(spline.sample(std::min(t, spline.duration_s())).p));
  }
  return points;
}

void draw_region(Svg& page, const PlotFrame& frame, const Region& region, bool attracts) {
  const Box box = region.bounds();
  const XY from = frame.at(box.min().x(), box.max().y());
  const XY to = frame.at(box.max().x(), box.min().y());
  page.rect(from, to.first - from.first, to.second - from.second,
            attracts ? "fill=\"#2e9e5b\" fill-opacity=\"0.22\" stroke=\"#2e9e5b\""
                     : "fill=\"#d9413e\" fill-opacity=\"0.18\" stroke=\"#d9413e\"");
}

/// The obstacle's way during the plan, and its box in the middle of every segment.
void draw_obstacle(Svg& page, const PlotFrame& frame, const SearchOutcome& outcome) {
  const ClampedSpline spline = outcome.trajectory.spline();
  const auto centre = [&](double t_s) -> Vec3 {
    return outcome.obstacle
        .bounds(outcome.trajectory.start + Duration::from_seconds(t_s),
                outcome.trajectory.start + Duration::from_seconds(t_s))
        .center();
  };
  std::vector<XY> way;
  for (double t = 0.0; t <= spline.duration_s(); t += 0.02) way.push_back(frame.at(centre(t).x(), centre(t).y()));
  for (int j = 0; j < spline.intervals(); ++j) {
    const Vec3 c = centre((j + 0.5) * spline.interval_s());
    const XY from = frame.at(c.x() - 0.4, c.y() + 0.4);
    const XY to = frame.at(c.x() + 0.4, c.y() - 0.4);
    page.rect(from, to.first - from.first, to.second - from.second,
              fmt::format("fill=\"{}\" fill-opacity=\"0.10\" stroke=\"{}\" stroke-opacity=\"0.6\"", kObstacle,
                          segment_colour(static_cast<std::size_t>(j), outcome.segments.size())));
  }
  page.polyline(way, fmt::format("fill=\"none\" stroke=\"{}\" stroke-dasharray=\"4 3\"", kObstacle));
}

void draw_overview(Svg& page, const SearchOutcome& outcome, double top) {
  PlotFrame frame;
  frame.corner = {60, top + 34};
  frame.width = kOverview - 90;
  frame.x_range = {-0.4, 4.4};
  frame.height = 275;
  const double half = 0.5 * frame.height / frame.width * 4.8;
  frame.y_range = {0.4 - half, 0.4 + half};
  frame.draw_axes(page, "x, m", "y, m");
  const std::string clip = fmt::format("overview{:.0f}", top);
  page.clip_rect(clip, frame.corner, frame.width, frame.height);
  page.open_group(fmt::format("clip-path=\"url(#{})\"", clip));
  const SemanticsSpec& semantics = outcome.scenario.semantics;
  for (const Region& region : semantics.enabled ? semantics.regions : std::vector<Region>{})
    draw_region(page, frame, region, region.class_name == "texture");
  draw_obstacle(page, frame, outcome);
  const View above{Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const ClampedSpline spline = outcome.trajectory.spline();
  for (int j = 0; j < spline.intervals(); ++j) {
    const auto k = static_cast<std::size_t>(j);
    page.polyline(on_page(frame, curve_of(spline, j, above)),
                  fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"4\" stroke-linecap=\"round\"",
                              segment_colour(k, outcome.segments.size())));
  }
  page.close_group();
  page.circle(frame.at(outcome.scenario.uav.start.x(), outcome.scenario.uav.start.y()), 4, "fill=\"#222\"");
  const XY goal = frame.at(outcome.scenario.uav.goal.x(), outcome.scenario.uav.goal.y());
  page.circle(goal, 6, "fill=\"none\" stroke=\"#222\" stroke-width=\"2\"");
}

void draw_segment(Svg& page, const SearchOutcome& outcome, int j, const XY& corner) {
  const SearchSegment& segment = outcome.segments[static_cast<std::size_t>(j)];
  const View view = View::along(segment.plane);
  const std::vector<XY> curve = seen(view, segment.curve_hull);
  const std::vector<XY> obstacle = seen(view, segment.obstacle_hull);
  const Vec3 middle = segment.curve_hull.rowwise().mean();
  const XY centre = view.of(0.5 * (middle + Vec3(segment.obstacle_hull.rowwise().mean())));
  double half = 0.7;
  for (const std::vector<XY>* shape : {&curve, &obstacle}) {
    for (const XY& p : *shape) {
      half = std::max({half, 1.08 * std::abs(p.first - centre.first), 1.08 * std::abs(p.second - centre.second)});
    }
  }
  PlotFrame frame;
  frame.corner = corner;
  frame.width = frame.height = kSide;
  frame.x_range = {centre.first - half, centre.first + half};
  frame.y_range = {centre.second - half, centre.second + half};
  const std::string clip = fmt::format("segment{:.0f}_{}", corner.second, j);
  page.clip_rect(clip, corner, kSide, kSide);
  page.open_group(fmt::format("clip-path=\"url(#{})\"", clip));
  page.polygon(on_page(frame, obstacle),
               fmt::format("fill=\"{0}\" fill-opacity=\"0.25\" stroke=\"{0}\" stroke-width=\"1.2\"", kObstacle));
  if (segment.gap_m > 0.0) {
    // The plane as a line: through its point nearest to the middle, at right angles to the normal's image.
    const Vec3 foot = middle - segment.plane.signed_distance(middle) * segment.plane.n;
    const XY n = view.of(segment.plane.n);
    const XY at = view.of(foot);
    page.line(frame.at(at.first - 20 * n.second, at.second + 20 * n.first),
              frame.at(at.first + 20 * n.second, at.second - 20 * n.first), "stroke=\"#444\" stroke-dasharray=\"5 3\"");
  }
  page.polygon(on_page(frame, curve), fmt::format("fill=\"{0}\" fill-opacity=\"0.18\" stroke=\"{0}\"", kCurve));
  page.polyline(on_page(frame, curve_of(outcome.trajectory.spline(), j, view)),
                fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"3\" stroke-linecap=\"round\"",
                            segment_colour(static_cast<std::size_t>(j), outcome.segments.size())));
  page.close_group();
  page.rect(corner, kSide, kSide, "fill=\"none\" stroke=\"#aaa\"");
  page.text({corner.first + 6, corner.second + 15}, fmt::format("{}", j + 1), "font-weight=\"bold\"");
  page.text({corner.first + kSide - 5, corner.second + kSide - 6},
            segment.gap_m > 0.0 ? fmt::format("gap {:.2f} m", segment.gap_m) : "separated in parts",
            "text-anchor=\"end\" font-size=\"10\" fill=\"#555\"");
}

}  // namespace

std::string draw_search(const std::vector<SearchOutcome>& outcomes) {
  constexpr double kTop = 24.0;
  Svg page(kOverview + 3 * (kSide + 14) + 10, kTop + kRow * static_cast<double>(outcomes.size()) + 40);
  double top = kTop;
  for (std::size_t k = 0; k < outcomes.size(); ++k, top += kRow) {
    page.text({60, top + 20}, search_cases().at(k).title, "font-size=\"15\" font-weight=\"bold\"");
    if (!outcomes[k].found) {
      page.text({60, top + 60}, "nothing found");
      continue;
    }
    draw_overview(page, outcomes[k], top);
    for (int j = 0; j < static_cast<int>(outcomes[k].segments.size()); ++j) {
      draw_segment(page, outcomes[k], j, {kOverview + (j % 3) * (kSide + 14), top + 6 + (j / 3) * (kSide + 14)});
    }
  }
  page.text({60, top + 12}, "Left: from above, with the obstacle's box in the middle of each segment.",
            "font-size=\"11\" fill=\"#555\"");
  page.text(
      {60, top + 28},
      "Right: the hull of each segment (blue) and of the obstacle, its motion and α (amber), seen along the plane "
      "between them.",
      "font-size=\"11\" fill=\"#555\"");
  return page.finish();
}

}  // namespace tern
