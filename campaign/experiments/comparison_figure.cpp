#include "campaign/experiments/comparison_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "campaign/experiments/svg.h"

namespace tern {
namespace {

constexpr double kRow = 22.0, kNames = 260.0, kPlot = 460.0, kNumbers = 250.0, kTop = 84.0;  // pixels
/// Larger differences, %, are cut off at the frame.
constexpr double kMaxPercent = 200.0;

std::vector<const ComparedMeasure*> drawn(const CampaignComparison& c) {
  std::vector<const ComparedMeasure*> rows;
  for (const ComparedMeasure& m : c.measures) {
    if (m.difference.different > 0) rows.push_back(&m);
  }
  return rows;
}

double percent(double difference, double mean) { return 100.0 * difference / std::abs(mean); }

/// Returns the largest share of all rows, for a frame about 0.
double reach_of(const CampaignComparison& c, const std::vector<const ComparedMeasure*>& rows) {
  double reach = 1.0;
  for (const ComparedMeasure* m : rows) {
    const PairedDifference& d = m->difference;
    if (d.mean_a == 0.0) continue;
    reach = std::max(reach, std::abs(percent(d.difference, d.mean_a)));
    if (!c.may_infer() || !d.may_infer()) continue;
    for (const double x : {d.interval.low, d.interval.high}) reach = std::max(reach, std::abs(percent(x, d.mean_a)));
  }
  return std::min(1.05 * reach, kMaxPercent);
}

std::string axis_name(const std::vector<const ComparedMeasure*>& rows) {
  const bool has_hollow = std::ranges::any_of(rows, [](const auto* m) { return m->difference.mean_a == 0.0; });
  return has_hollow ? "B - A, % of A's mean; hollow: A's mean is 0, the interval is B - A itself"
                    : "B - A, % of A's mean";
}

/// Draws a row whose mean in A is 0: a hollow mark on the side of B, and the values as numbers.
void draw_of_nothing(Svg& page, const PlotFrame& frame, const PairedDifference& d, double y, bool may_infer) {
  const double edge = frame.x_range.second, side = d.difference > 0.0 ? edge : d.difference < 0.0 ? -edge : 0.0;
  page.circle({frame.at(side, 0.0).first, y}, 4.0, "fill=\"white\" stroke=\"#1357a6\" stroke-width=\"1.5\"");
  if (!may_infer) return;
  page.text({frame.at(-edge, 0.0).first + 8, y + 4}, fmt::format("[{:.4g}, {:.4g}]", d.interval.low, d.interval.high),
            "fill=\"#555\"");
}

void draw_row(Svg& page, const PlotFrame& frame, const ComparedMeasure& measure, double y, bool flights_differ) {
  const PairedDifference& d = measure.difference;
  const bool may_infer = flights_differ && d.may_infer();
  page.text({kNames - 8, y + 4}, measure.name, "text-anchor=\"end\"");
  page.text({kNames + kPlot + 8, y + 4}, fmt::format("{:.4g} to {:.4g}, {} pairs", d.mean_a, d.mean_b, d.pairs));
  if (d.mean_a == 0.0) return draw_of_nothing(page, frame, d, y, may_infer);
  const auto place = [&](double difference) {
    return frame.at(std::clamp(percent(difference, d.mean_a), frame.x_range.first, frame.x_range.second), 0.0).first;
  };
  if (may_infer) {
    page.line({place(d.interval.low), y}, {place(d.interval.high), y}, "stroke=\"#1357a6\" stroke-width=\"3\"");
  }
  page.circle({place(d.difference), y}, 4.0, "fill=\"#1357a6\"");
}

}  // namespace

std::string draw_comparison(const CampaignComparison& c) {
  const auto rows = drawn(c);
  PlotFrame frame;
  frame.corner = {kNames, kTop};
  frame.width = kPlot;
  frame.height = kRow * static_cast<double>(std::max<std::size_t>(1, rows.size()));
  const double reach = reach_of(c, rows);
  frame.x_range = {-reach, reach};
  Svg page(kNames + kPlot + kNumbers, kTop + frame.height + 48.0);
  page.text({16, 22}, in_words("A", c.a));
  page.text({16, 40}, in_words("B", c.b));
  page.text({16, 58}, fmt::format("{} pairs, success: A {}, B {}{}", c.pairs, c.successes_a, c.successes_b,
                                  c.may_infer() ? fmt::format("; McNemar p = {:.3g}", c.p_value)
                                                : std::string("; no intervals: flights are equal")));
  for (const double x : round_ticks(frame.x_range, 8)) {
    const double px = frame.at(x, 0.0).first;
    page.line({px, kTop}, {px, kTop + frame.height}, x == 0.0 ? "stroke=\"#555\"" : "stroke=\"#e8e8e8\"");
    page.text({px, kTop + frame.height + 16.0}, fmt::format("{:g}", x), "text-anchor=\"middle\" fill=\"#555\"");
  }
  page.rect(frame.corner, frame.width, frame.height, "fill=\"none\" stroke=\"#999\"");
  page.text({kNames + 0.5 * kPlot, kTop + frame.height + 36.0}, axis_name(rows), "text-anchor=\"middle\"");
  for (std::size_t k = 0; k < rows.size(); ++k) {
    draw_row(page, frame, *rows[k], kTop + kRow * (static_cast<double>(k) + 0.5), c.may_infer());
  }
  return page.finish();
}

}  // namespace tern
