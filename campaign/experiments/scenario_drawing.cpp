#include "campaign/experiments/scenario_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "campaign/experiments/svg.h"
#include "core/world/body.h"
#include "core/world/names.h"

namespace tern {
namespace {

constexpr double kLeft = 62.0, kTop = 52.0;  // pixels, margin of the frames and the texts
constexpr double kLowest = 90.0;             // pixels, least height of the view from the side
constexpr double kStep = 0.1;                // m, between samples of a path
constexpr double kWayStep = 0.1;             // s, between samples of a mover's way
constexpr double kWayPixels = 2.0;           // least distance between two drawn points of a way
constexpr int kMostNames = 60;
// Advance of a character in font sizes, rounded up: these texts measure 0.50 in DejaVu Sans, 0.57 in bold.
constexpr double kAdvance = 0.55, kBoldAdvance = 0.62;
constexpr double kTitleSize = 15.0, kKeySize = 12.0, kNameSize = 11.0;  // pixels

constexpr char kMap[] = "fill=\"#4a5560\" fill-opacity=\"0.75\"";
constexpr char kStatic[] = "fill=\"#7d838c\" fill-opacity=\"0.8\"";
constexpr char kElsewhere[] = "fill=\"none\" stroke=\"#b4b9c0\"";
constexpr char kMover[] = "fill=\"#e07b00\" fill-opacity=\"0.65\"";
constexpr char kWay[] = "fill=\"none\" stroke=\"#e07b00\" stroke-opacity=\"0.45\"";
constexpr char kShortest[] = "fill=\"none\" stroke=\"#7d838c\" stroke-width=\"2\" stroke-dasharray=\"5 3\"";
constexpr char kWeighted[] = "fill=\"none\" stroke=\"#1357a6\" stroke-width=\"2.5\"";
constexpr char kFlightBox[] = "fill=\"none\" stroke=\"#1f2933\" stroke-dasharray=\"6 4\"";
constexpr char kStart[] = "fill=\"white\" stroke=\"#1f2933\" stroke-width=\"2\"";
constexpr char kGoal[] = "fill=\"#1357a6\" stroke=\"white\"";

const char* fill_of(const std::string& label) {
  if (label == to_string(VoxelLabel::Attractive)) return "fill=\"#2e9e5b\" fill-opacity=\"0.20\" stroke=\"#2e9e5b\"";
  if (label == to_string(VoxelLabel::Repulsive)) return "fill=\"#d9413e\" fill-opacity=\"0.18\" stroke=\"#d9413e\"";
  return "fill=\"#7d838c\" fill-opacity=\"0.30\" stroke=\"#7d838c\"";
}

/// Returns the points of the shortest path, or of the straight line without one, kStep apart.
std::vector<Vec3> samples_of_path(const ScenarioView& view) {
  const UavSpec& uav = view.scenario.uav;
  const std::vector<Vec3> corners = view.shortest ? view.shortest->points : std::vector<Vec3>{uav.start, uav.goal};
  std::vector<Vec3> samples = {corners.front()};
  for (std::size_t k = 1; k < corners.size(); ++k) {
    const Vec3 leg = corners[k] - corners[k - 1];
    const int steps = std::max(1, static_cast<int>(std::ceil(leg.norm() / kStep)));
    for (int i = 1; i <= steps; ++i) samples.push_back(corners[k - 1] + leg * (static_cast<double>(i) / steps));
  }
  return samples;
}

/// A view: axis u of W to the right, axis v upwards.
struct View {
  PlotFrame frame;
  int u = 0, v = 1;

  [[nodiscard]] XY at(const Vec3& p) const { return frame.at(p[u], p[v]); }
  void box(Svg& page, const Box& box, const std::string& attributes) const {
    const XY from = frame.at(box.min()[u], box.max()[v]), to = frame.at(box.max()[u], box.min()[v]);
    page.rect(from, to.first - from.first, to.second - from.second, attributes);
  }
  void path(Svg& page, const std::optional<PlannedPath>& way, const std::string& attributes) const {
    if (!way) return;
    std::vector<XY> points;
    for (const Vec3& p : way->points) points.push_back(at(p));
    page.polyline(points, attributes);
  }
  void ends(Svg& page, const UavSpec& uav) const {
    page.circle(at(uav.start), 6.0, kStart);
    page.circle(at(uav.goal), 6.0, kGoal);
  }
};

/// Draws at equal scales. Where the flight box is unbounded, the view is cut near the scenario's contents.
View view_from_above(const ScenarioView& view) {
  const UavSpec& uav = view.scenario.uav;
  Box box(uav.start);
  box.extend(uav.goal);
  for (const Region& r : view.scenario.semantics.regions) box.extend(r.bounds());
  for (const WorldObstacle& o : view.world.obstacles) {
    if (o.present(0.0)) box.extend(o.box(0.0));
  }
  for (const Box& b : view.occupied) box.extend(b);
  for (const auto* way : {&view.shortest, &view.weighted}) {
    for (const Vec3& p : *way ? (*way)->points : std::vector<Vec3>()) box.extend(p);
  }
  PlotFrame frame;
  frame.corner = {kLeft, kTop};
  const double x = box.sizes().x() + 4.0, y = box.sizes().y() + 4.0;
  const double scale = std::min(1000.0 / x, 700.0 / y);
  frame.width = scale * x;
  frame.height = scale * y;
  frame.x_range = {box.min().x() - 2.0, box.max().x() + 2.0};
  frame.y_range = {box.min().y() - 2.0, box.max().y() + 2.0};
  return {frame, 0, 1};
}

/// The boxes that the body passes over, under or through.
class Section {
 public:
  explicit Section(const ScenarioView& view) : body_(body_box(view.scenario.uav.body)) {
    for (const Vec3& p : samples_of_path(view)) path_.push_back(p.head<2>());
  }
  [[nodiscard]] bool shows(const Box& box) const {
    const Eigen::Vector2d low = box.min().head<2>() - body_.max().head<2>();
    const Eigen::Vector2d high = box.max().head<2>() - body_.min().head<2>();
    return std::ranges::any_of(path_, [&](const Eigen::Vector2d& p) {
      return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
    });
  }

 private:
  Box body_;
  std::vector<Eigen::Vector2d> path_;
};

View view_from_the_side(const ScenarioView& view, const View& above, const Section& section) {
  const UavSpec& uav = view.scenario.uav;
  const Vec3 way = (uav.goal - uav.start).cwiseAbs();
  const int u = way.x() >= way.y() ? 0 : 1;
  double low = std::min(uav.start.z(), uav.goal.z()), high = std::max(uav.start.z(), uav.goal.z());
  const auto extend = [&](double from, double to) {
    low = std::min(low, from);
    high = std::max(high, to);
  };
  for (const Vec3& p : samples_of_path(view)) extend(p.z(), p.z());
  for (const Box& b : view.occupied) {
    if (section.shows(b)) extend(b.min().z(), b.max().z());
  }
  for (const WorldObstacle& o : view.world.obstacles) {
    if (o.present(0.0) && section.shows(o.box(0.0))) extend(o.box(0.0).min().z(), o.box(0.0).max().z());
  }
  PlotFrame frame;
  frame.corner = {kLeft, above.frame.corner.second + above.frame.height + 80.0};
  frame.x_range = u == 0 ? above.frame.x_range : above.frame.y_range;
  frame.y_range = {low - 1.0, high + 1.0};
  const double scale = above.frame.width / (above.frame.x_range.second - above.frame.x_range.first);
  frame.width = scale * (frame.x_range.second - frame.x_range.first);
  frame.height = std::max(scale * (frame.y_range.second - frame.y_range.first), kLowest);
  return {frame, u, 2};
}

/// Returns true for a region that is drawn as one; occupied and free ones are parts of the map.
bool is_drawn(const std::string& label) {
  return label != to_string(VoxelLabel::Occupied) && label != to_string(VoxelLabel::Free);
}

void draw_region(Svg& page, const View& view, const Region& region, const std::string& label) {
  if (!is_drawn(label)) return;
  const std::string attributes = fill_of(label);
  const auto* prism = std::get_if<PrismRegion>(&region.shape);
  const auto* ball = std::get_if<BallRegion>(&region.shape);
  const double scale = view.frame.width / (view.frame.x_range.second - view.frame.x_range.first);
  if (prism != nullptr && view.v == 1) {
    std::vector<XY> corners;
    for (const auto& c : prism->corners) corners.push_back(view.frame.at(c.x(), c.y()));
    page.polygon(corners, attributes);
  } else if (ball != nullptr && view.v == 1) {
    page.circle(view.at(ball->centre), ball->radius * scale, attributes);
  } else {
    view.box(page, region.bounds(), attributes);
  }
}

/// Draws the ways of moving obstacles, while they are present.
void draw_ways(Svg& page, const View& view, const World& world) {
  for (const WorldObstacle& o : world.obstacles) {
    if (!o.moves()) continue;
    std::vector<XY> points;
    const double to_s = std::min(kWaySeconds, o.last_s());
    for (double t = std::max(0.0, o.first_s()); t <= to_s; t += kWayStep) {
      const XY p = view.at(o.at(t).p);
      const bool is_far =
          points.empty() || std::hypot(p.first - points.back().first, p.second - points.back().second) >= kWayPixels;
      if (is_far) points.push_back(p);
    }
    if (points.size() > 1) page.polyline(points, kWay);
  }
}

/// Writes a text that stands out from the drawing below it.
void write_name(Svg& page, const XY& at, const std::string& name, const std::string& colour) {
  page.text({at.first + 4.0, at.second - 3.0}, name,
            fmt::format("font-size=\"{:g}\" fill=\"{}\" stroke=\"white\" stroke-width=\"3\" paint-order=\"stroke\"",
                        kNameSize, colour));
}

void draw_names(Svg& page, const View& view, const ScenarioView& scenario) {
  const UavSpec& uav = scenario.scenario.uav;
  int names = 0;
  const auto is_listed = [&](const std::string& name) {  // recorded obstacles have a name that the file gives them
    return !name.empty() && std::ranges::any_of(scenario.scenario.world.obstacles,
                                                [&](const ObstacleSpec& spec) { return spec.name == name; });
  };
  for (const WorldObstacle& o : scenario.world.obstacles) {
    if (!is_listed(o.spec().name) || !o.present(0.0) || ++names > kMostNames) continue;
    const Box box = o.box(0.0);
    write_name(page, view.frame.at(box.min()[view.u], box.max()[view.v]), o.spec().name,
               o.moves() ? "#a85c00" : "#444");
  }
  for (const Region& r : scenario.scenario.semantics.regions) {
    const Box box = r.bounds();
    const XY at = view.frame.at(box.min().x(), box.max().y());
    page.text({at.first + 4, at.second + 14}, r.name + ", " + region_heights(r), "font-size=\"12\"");
  }
  write_name(page, {view.at(uav.start).first + 4.0, view.at(uav.start).second - 4.0}, "start", "#1f2933");
  write_name(page, {view.at(uav.goal).first + 4.0, view.at(uav.goal).second - 4.0}, "goal", "#1357a6");
}

void draw_from_above(Svg& page, const View& above, const ScenarioView& view) {
  const auto [low, high] = drawn_heights(view);
  const auto is_there = [low = low, high = high](const Box& b) { return b.min().z() <= high && b.max().z() >= low; };
  above.box(page, view.scenario.uav.flight_box, kFlightBox);
  for (const Region& r : view.scenario.semantics.regions) {
    draw_region(page, above, r, region_label(view.scenario, r));
  }
  for (const Box& b : view.occupied) {
    if (is_there(b)) above.box(page, b, kMap);
  }
  draw_ways(page, above, view.world);
  for (const WorldObstacle& o : view.world.obstacles) {
    if (!o.present(0.0)) continue;
    above.box(page, o.box(0.0), o.moves() ? kMover : is_there(o.box(0.0)) ? kStatic : kElsewhere);
  }
  above.path(page, view.shortest, kShortest);
  above.path(page, view.weighted, kWeighted);
  above.ends(page, view.scenario.uav);
  draw_names(page, above, view);
}

void draw_from_the_side(Svg& page, const View& side, const ScenarioView& view, const Section& section) {
  side.box(page, view.scenario.uav.flight_box, kFlightBox);
  for (const Region& r : view.scenario.semantics.regions) {
    if (section.shows(r.bounds())) draw_region(page, side, r, region_label(view.scenario, r));
  }
  for (const Box& b : view.occupied) {
    if (section.shows(b)) side.box(page, b, kMap);
  }
  for (const WorldObstacle& o : view.world.obstacles) {
    if (o.present(0.0) && section.shows(o.box(0.0))) side.box(page, o.box(0.0), o.moves() ? kMover : kStatic);
  }
  side.path(page, view.shortest, kShortest);
  side.path(page, view.weighted, kWeighted);
  side.ends(page, view.scenario.uav);
}

/// An entry of the key.
struct KeyEntry {
  enum class Mark { Dot, Line, Patch } mark;
  std::string attributes, text;
  [[nodiscard]] double width() const { return 40.0 + kAdvance * kKeySize * static_cast<double>(text.size()); }
};

std::vector<KeyEntry> key_of(const ScenarioView& view) {
  using Mark = KeyEntry::Mark;
  const auto [low, high] = drawn_heights(view);
  const std::string at = fmt::format("from {:.1f} to {:.1f} m, the vehicle's height", low, high);
  const auto has = [&](const auto& holds) { return std::ranges::any_of(view.world.obstacles, holds); };
  std::vector<KeyEntry> key = {{Mark::Dot, kStart, "start"}, {Mark::Dot, kGoal, "goal"}};
  if (!view.shortest) key.push_back({Mark::Line, "stroke=\"none\"", "the goal cannot be reached"});
  if (view.shortest) key.push_back({Mark::Line, kShortest, "the shortest path around static obstacles"});
  if (view.weighted) key.push_back({Mark::Line, kWeighted, "weighted by the regions' λ"});
  if (!view.occupied.empty()) key.push_back({Mark::Patch, kMap, "occupied in the map " + at});
  if (has([](const WorldObstacle& o) { return !o.moves(); })) {
    key.push_back({Mark::Patch, kStatic, view.occupied.empty() ? "static obstacles " + at : "static obstacles there"});
    key.push_back({Mark::Patch, kElsewhere, "static obstacles above or below"});
  }
  if (has([](const WorldObstacle& o) { return o.moves(); })) {
    key.push_back({Mark::Patch, kMover, "moving obstacles at time 0"});
    key.push_back({Mark::Line, kWay, fmt::format("their ways during the first {:g} s", kWaySeconds)});
  }
  std::vector<std::string> labels;
  for (const Region& r : view.scenario.semantics.regions) {
    const std::string& label = region_label(view.scenario, r);
    if (!is_drawn(label) || std::ranges::find(labels, label) != labels.end()) continue;
    labels.push_back(label);
    key.push_back({Mark::Patch, fill_of(label), label + " region"});
  }
  key.push_back({Mark::Line, kFlightBox, "flight box"});
  return key;
}

/// Draws the key from `top` on, or only measures it. @return the height, pixels
double draw_key(Svg* page, const std::vector<KeyEntry>& key, double top, double width) {
  constexpr double kRow = 20.0;
  double x = kLeft, y = top;
  for (const KeyEntry& entry : key) {
    if (x > kLeft && x + entry.width() > kLeft + width) {
      x = kLeft;
      y += kRow;
    }
    if (page != nullptr) {
      if (entry.mark == KeyEntry::Mark::Dot) page->circle({x + 9, y - 4}, 5.0, entry.attributes);
      if (entry.mark == KeyEntry::Mark::Line) page->line({x, y - 4}, {x + 18, y - 4}, entry.attributes);
      if (entry.mark == KeyEntry::Mark::Patch) page->rect({x, y - 10}, 18, 11, entry.attributes);
      page->text({x + 24, y}, entry.text, fmt::format("font-size=\"{:g}\"", kKeySize));
    }
    x += entry.width();
  }
  return y + kRow - top;
}

}  // namespace

std::pair<double, double> drawn_heights(const ScenarioView& view) {
  std::vector<double> heights;
  for (const Vec3& p : samples_of_path(view)) heights.push_back(p.z());
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  const Box body = body_box(view.scenario.uav.body);
  return {*middle + body.min().z(), *middle + body.max().z()};
}

std::string draw_scenario(const ScenarioView& view) {
  const View above = view_from_above(view);
  const Section section(view);
  const View side = view_from_the_side(view, above, section);
  const std::string title =
      fmt::format("{}, seed {}: {}", view.scenario.name, view.scenario.seed, world_text(view.world));
  const std::vector<KeyEntry> key = key_of(view);
  double width = std::max(
      {above.frame.width, side.frame.width, 560.0, kBoldAdvance * kTitleSize * static_cast<double>(title.size())});
  for (const KeyEntry& entry : key) width = std::max(width, entry.width());
  const double key_top = side.frame.corner.second + side.frame.height + 66.0;
  Svg page(kLeft + width + 24.0, key_top + draw_key(nullptr, key, key_top, width));
  page.text({kLeft, 24}, title, fmt::format("font-size=\"{:g}\" font-weight=\"bold\"", kTitleSize));
  for (const View* part : {&above, &side}) {
    const bool is_above = part == &above;
    const char* name = is_above ? "above" : "side";
    page.text({kLeft, part->frame.corner.second - 8.0}, is_above ? "from above" : "from the side, along the path",
              "fill=\"#555\"");
    page.clip_rect(name, part->frame.corner, part->frame.width, part->frame.height);
    page.open_group(fmt::format("clip-path=\"url(#{})\"", name));
    if (is_above) draw_from_above(page, above, view);
    if (!is_above) draw_from_the_side(page, side, view, section);
    page.close_group();
    part->frame.draw_axes(page, part->u == 0 ? "x, m" : "y, m", is_above ? "y, m" : "z, m");
  }
  draw_key(&page, key, key_top, width);
  return page.finish();
}

}  // namespace tern
