#include "campaign/experiments/corridor_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "campaign/experiments/svg.h"
#include "core/world/names.h"

namespace tern {
namespace {

constexpr double kWidth = 1100.0;
constexpr const char* kTitle = "font-size=\"15\" font-weight=\"bold\"";

std::string colour_of(const std::string& method) {
  if (method == "off") return "#7d838c";
  if (method == "mean_distance") return "#e07b00";
  if (method == "mean_distance+path") return "#b5432a";
  return method == "exposure" ? "#4aa3df" : "#1357a6";
}

bool attracts(const Scenario& scenario, const Region& region) {
  for (const auto& [name, label] : scenario.semantics.classes) {
    if (name == region.class_name) return label == to_string(VoxelLabel::Attractive);
  }
  return false;
}

/// The map's frame: equal scales, the width of the page.
PlotFrame frame_of(const FlightTrack& a, const FlightTrack& b, double top) {
  Box box;
  for (const FlightTrack* t : {&a, &b}) {
    for (const TrackPoint& p : t->points) box.extend(p.p);
  }
  for (const Region& r : a.scenario.semantics.regions) box.extend(r.bounds());
  for (const WorldObstacle& o : a.world.obstacles) box.extend(o.at(0.0).p);
  PlotFrame frame;
  frame.corner = {62, top};
  frame.width = kWidth - 62 - 24;
  frame.x_range = {box.min().x() - 1.5, box.max().x() + 1.5};
  frame.y_range = {box.min().y() - 1.0, box.max().y() + 1.0};
  frame.height =
      frame.width * (frame.y_range.second - frame.y_range.first) / (frame.x_range.second - frame.x_range.first);
  return frame;
}

/// Seen from above (axis 1: y upwards) or from the side (axis 2: z upwards).
void draw_box(Svg& page, const PlotFrame& frame, int axis, const Box& box, const std::string& attributes) {
  const XY from = frame.at(box.min().x(), box.max()[axis]);
  const XY to = frame.at(box.max().x(), box.min()[axis]);
  page.rect(from, to.first - from.first, to.second - from.second, attributes);
}

void draw_regions(Svg& page, const PlotFrame& frame, int axis, const Scenario& scenario) {
  for (const Region& region : scenario.semantics.regions) {
    const bool good = attracts(scenario, region);
    const Box box = region.bounds();
    draw_box(page, frame, axis, box,
             good ? "fill=\"#2e9e5b\" fill-opacity=\"0.20\" stroke=\"#2e9e5b\""
                  : "fill=\"#d9413e\" fill-opacity=\"0.18\" stroke=\"#d9413e\"");
    const XY at = frame.at(box.min().x(), box.min()[axis]);
    page.text({at.first + 5, at.second - 5}, region.name, good ? "fill=\"#1d7a42\"" : "fill=\"#a82825\"");
  }
}

/// When the flight passes x.
double time_at(const FlightTrack& track, double x) {
  const auto nearer = [x](const TrackPoint& a, const TrackPoint& b) {
    return std::abs(a.p.x() - x) < std::abs(b.p.x() - x);
  };
  return std::min_element(track.points.begin(), track.points.end(), nearer)->t_s;
}

void draw_obstacles(Svg& page, const PlotFrame& frame, int axis, const FlightTrack& track) {
  for (const WorldObstacle& o : track.world.obstacles) {
    // Where a mover is as the vehicle passes it: two steps come close enough.
    double t = time_at(track, o.at(0.0).p.x());
    if (o.moves()) t = time_at(track, o.at(t).p.x());
    draw_box(page, frame, axis, box_around(o.at(t).p, o.half_extents()),
             o.moves() ? "fill=\"#e9b44c\" fill-opacity=\"0.45\" stroke=\"#b98a2a\" stroke-width=\"0.6\""
                       : "fill=\"#8893a3\" fill-opacity=\"0.75\" stroke=\"none\"");
  }
}

std::vector<XY> on_page(const PlotFrame& frame, int axis, const FlightTrack& track) {
  std::vector<XY> points;
  for (const TrackPoint& p : track.points) points.push_back(frame.at(p.p.x(), p.p[axis]));
  return points;
}

/// Runs of one colour, each from the last one's end.
void draw_by_speed(Svg& page, const PlotFrame& frame, int axis, const FlightTrack& track, double top_speed) {
  page.polyline(on_page(frame, axis, track), "fill=\"none\" stroke=\"white\" stroke-width=\"5.5\"");
  constexpr double kSteps = 24.0;
  const auto colour = [&](const TrackPoint& p) {
    return viridis(std::round(p.speed_mps / top_speed * kSteps) / kSteps);
  };
  std::vector<XY> run;
  for (std::size_t i = 0; i < track.points.size(); ++i) {
    const TrackPoint& p = track.points[i];
    run.push_back(frame.at(p.p.x(), p.p[axis]));
    const bool ends = i + 1 == track.points.size() || colour(track.points[i + 1]) != colour(p);
    if (!ends) continue;
    if (i + 1 < track.points.size()) run.push_back(frame.at(track.points[i + 1].p.x(), track.points[i + 1].p[axis]));
    page.polyline(run,
                  fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"3\" stroke-linecap=\"round\"", colour(p)));
    run.clear();
  }
}

void draw_legend(Svg& page, double y, double top_speed) {
  page.line({62, y - 4}, {92, y - 4}, "stroke=\"#7d838c\" stroke-width=\"2.5\" stroke-dasharray=\"6 3\"");
  page.text({98, y}, "without semantics");
  page.text({240, y}, "with semantics, by speed:");
  constexpr int kCells = 60;
  for (int k = 0; k < kCells; ++k) {
    page.rect({414 + 2.5 * k, y - 11}, 2.7, 12, fmt::format("fill=\"{}\"", viridis((k + 0.5) / kCells)));
  }
  page.text({410, y}, "0", "text-anchor=\"end\"");
  page.text({570, y}, fmt::format("{:g} m/s", top_speed));
  page.rect({660, y - 10}, 11, 11, "fill=\"#8893a3\"");
  page.text({677, y}, "static");
  page.rect({740, y - 10}, 11, 11, "fill=\"#e9b44c\" fill-opacity=\"0.6\" stroke=\"#b98a2a\"");
  page.text({757, y}, "moving, as the flight with semantics passes");
}

/// Two panels, what attracts on the left.
PlotFrame panel(std::size_t k) {
  PlotFrame frame;
  frame.corner = {70 + 535.0 * static_cast<double>(k), 62};
  frame.width = 440;
  frame.height = 330;
  return frame;
}

std::vector<std::string> methods_of(const std::vector<ExposureSummary>& summaries) {
  std::vector<std::string> methods;
  for (const SemanticMethod& method : semantic_methods()) {
    const bool flown = std::any_of(summaries.begin(), summaries.end(),
                                   [&](const ExposureSummary& s) { return s.method == method.name; });
    if (flown) methods.push_back(method.name);
  }
  return methods;
}

void draw_methods(Svg& page, const std::vector<std::string>& methods, double y) {
  double x = 70;
  for (const std::string& name : methods) {
    page.circle({x, y - 4}, 5, fmt::format("fill=\"{}\"", colour_of(name)));
    const std::string& title = semantic_method(name).title;
    page.text({x + 10, y}, title);
    x += 34 + 6.7 * static_cast<double>(title.size());
  }
}

/// A mean with its two intervals.
void draw_mean(Svg& page, const PlotFrame& frame, const MeanInterval& x, const MeanInterval& y,
               const std::string& colour) {
  const std::string bar = fmt::format("stroke=\"{}\" stroke-width=\"1.5\"", colour);
  page.line(frame.at(x.mean - x.half, y.mean), frame.at(x.mean + x.half, y.mean), bar);
  page.line(frame.at(x.mean, y.mean - y.half), frame.at(x.mean, y.mean + y.half), bar);
  page.circle(frame.at(x.mean, y.mean), 4.5, fmt::format("fill=\"{}\" stroke=\"white\"", colour));
}

}  // namespace

std::string draw_corridor(const FlightTrack& without, const FlightTrack& with, const std::string& title) {
  constexpr double kTop = 44.0;
  constexpr double kBetween = 50.0;
  const PlotFrame above = frame_of(without, with, kTop);
  PlotFrame side = above;
  side.corner.second += above.height + kBetween;
  side.y_range = {-0.5, 4.5};
  side.height = above.width * 5.0 / (above.x_range.second - above.x_range.first);
  double top_speed = 1.0;
  for (const TrackPoint& p : with.points) top_speed = std::max(top_speed, std::ceil(p.speed_mps));
  const double bottom = side.corner.second + side.height;
  Svg page(kWidth, bottom + 76);
  page.text({62, 26}, title, kTitle);
  for (const int axis : {1, 2}) {
    const PlotFrame& frame = axis == 1 ? above : side;
    frame.draw_axes(page, axis == 1 ? "" : "x, m", axis == 1 ? "y, m" : "z, m");
    page.clip_rect(fmt::format("map{}", axis), frame.corner, frame.width, frame.height);
    page.open_group(fmt::format("clip-path=\"url(#map{})\"", axis));
    draw_regions(page, frame, axis, with.scenario);
    if (axis == 1) draw_obstacles(page, frame, axis, with);
    page.polyline(on_page(frame, axis, without),
                  "fill=\"none\" stroke=\"#7d838c\" stroke-width=\"2.5\" stroke-dasharray=\"6 3\"");
    draw_by_speed(page, frame, axis, with, top_speed);
    page.close_group();
  }
  draw_legend(page, bottom + 62, top_speed);
  return page.finish();
}

std::string draw_exposure(const std::vector<SemanticFlight>& flights, const std::vector<ExposureSummary>& summaries) {
  Svg page(kWidth, 470);
  for (std::size_t k = 0; k < semantic_worlds().size(); ++k) {
    const SemanticWorld& world = semantic_worlds()[k];
    PlotFrame frame = panel(k);
    std::vector<double> x, y;
    for (const SemanticFlight& f : flights) {
      if (f.flown.world != world.scenario || f.outcome != FlightOutcome::Reached) continue;
      x.push_back(f.path_length_m);
      y.push_back(f.exposure.metres);
    }
    frame.x_range = padded_range(x, 0.05);
    frame.y_range = padded_range(y, 0.08);
    page.text({frame.corner.first, 40},
              world.attracts ? "paper_attract: more is better" : "paper_repel: less is better", kTitle);
    frame.draw_axes(page, "path length, m", "metres inside the region");
    for (const SemanticFlight& f : flights) {
      if (f.flown.world != world.scenario || f.outcome != FlightOutcome::Reached) continue;
      page.circle(frame.at(f.path_length_m, f.exposure.metres), 3,
                  fmt::format("fill=\"{}\" fill-opacity=\"0.3\"", colour_of(f.flown.method)));
    }
    for (const ExposureSummary& s : summaries) {
      if (s.world == world.scenario) draw_mean(page, frame, s.path_length_m, s.inside_m, colour_of(s.method));
    }
  }
  draw_methods(page, methods_of(summaries), 456);
  return page.finish();
}

std::string draw_sweep(const std::vector<ExposureSummary>& summaries) {
  Svg page(kWidth, 470);
  for (std::size_t k = 0; k < semantic_worlds().size(); ++k) {
    const SemanticWorld& world = semantic_worlds()[k];
    PlotFrame frame = panel(k);
    std::vector<double> x{0.0}, y{0.0};
    for (const ExposureSummary& s : summaries) {
      if (s.world != world.scenario) continue;
      for (const double sign : {-1.0, 1.0}) {
        x.push_back(s.longer_m.mean + sign * s.longer_m.half);
        y.push_back(s.gained_m.mean + sign * s.gained_m.half);
      }
    }
    frame.x_range = padded_range(x, 0.05);
    frame.y_range = padded_range(y, 0.06);
    page.text({frame.corner.first, 40},
              world.attracts ? "paper_attract: metres gained inside" : "paper_repel: metres avoided", kTitle);
    frame.draw_axes(page, "longer path, m", world.attracts ? "gained, m" : "avoided, m");
    for (const std::string& method : methods_of(summaries)) {
      if (method == "off") continue;
      std::vector<XY> line{frame.at(0.0, 0.0)};
      for (const ExposureSummary& s : summaries) {
        if (s.world == world.scenario && s.method == method) line.push_back(frame.at(s.longer_m.mean, s.gained_m.mean));
      }
      page.polyline(line, fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"", colour_of(method)));
    }
    for (const ExposureSummary& s : summaries) {
      if (s.world != world.scenario || s.method == "off") continue;
      draw_mean(page, frame, s.longer_m, s.gained_m, colour_of(s.method));
      const XY at = frame.at(s.longer_m.mean, s.gained_m.mean);
      page.text({at.first + 6, at.second - 6}, fmt::format("{:g}", s.lambda),
                fmt::format("font-size=\"10\" fill=\"{}\"", colour_of(s.method)));
    }
  }
  auto methods = methods_of(summaries);
  std::erase(methods, "off");
  draw_methods(page, methods, 456);
  return page.finish();
}

}  // namespace tern
