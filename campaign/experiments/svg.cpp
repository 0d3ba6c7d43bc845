#include "campaign/experiments/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tern {
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else {
      out += c;
    }
  }
  return out;
}

std::string places(const std::vector<XY>& points) {
  std::string out;
  for (const XY& p : points) out += fmt::format("{}{:.1f},{:.1f}", out.empty() ? "" : " ", p.first, p.second);
  return out;
}

}  // namespace

Svg::Svg(double width, double height) : width_(width), height_(height) {
  rect({0, 0}, width, height, "fill=\"white\"");
}

void Svg::rect(const XY& corner, double width, double height, const std::string& attributes) {
  body_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" {}/>\n", corner.first,
                       corner.second, width, height, attributes);
}

void Svg::circle(const XY& centre, double radius, const std::string& attributes) {
  body_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" {}/>\n", centre.first, centre.second, radius,
                       attributes);
}

void Svg::line(const XY& from, const XY& to, const std::string& attributes) {
  body_ += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", from.first, from.second,
                       to.first, to.second, attributes);
}

void Svg::polyline(const std::vector<XY>& points, const std::string& attributes) {
  body_ += fmt::format("<polyline points=\"{}\" {}/>\n", places(points), attributes);
}

void Svg::polygon(const std::vector<XY>& points, const std::string& attributes) {
  body_ += fmt::format("<polygon points=\"{}\" {}/>\n", places(points), attributes);
}

void Svg::text(const XY& at, const std::string& text, const std::string& attributes) {
  body_ +=
      fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", at.first, at.second, attributes, escaped(text));
}

void Svg::open_group(const std::string& attributes) { body_ += fmt::format("<g {}>\n", attributes); }
void Svg::close_group() { body_ += "</g>\n"; }

void Svg::clip_rect(const std::string& name, const XY& corner, double width, double height) {
  body_ += fmt::format(
      "<clipPath id=\"{}\"><rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/></clipPath>\n", name,
      corner.first, corner.second, width, height);
}

std::string Svg::finish() const {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "font-family=\"DejaVu Sans, Arial, sans-serif\" font-size=\"12\" fill=\"#222\">\n{2}</svg>\n",
      width_, height_, body_);
}

XY PlotFrame::at(double x, double y) const {
  const double u = (x - x_range.first) / (x_range.second - x_range.first);
  const double v = (y - y_range.first) / (y_range.second - y_range.first);
  return {corner.first + u * width, corner.second + (1.0 - v) * height};
}

void PlotFrame::draw_axes(Svg& page, const std::string& x_name, const std::string& y_name) const {
  constexpr double kPixelsPerTick = 60.0;
  const double bottom = corner.second + height;
  for (const double x : round_ticks(x_range, static_cast<int>(width / kPixelsPerTick))) {
    const double px = at(x, 0.0).first;
    page.line({px, corner.second}, {px, bottom}, "stroke=\"#e8e8e8\"");
    page.text({px, bottom + 16}, fmt::format("{:g}", x), "text-anchor=\"middle\" fill=\"#555\"");
  }
  for (const double y : round_ticks(y_range, std::max(2, static_cast<int>(height / kPixelsPerTick) + 1))) {
    const double py = at(0.0, y).second;
    page.line({corner.first, py}, {corner.first + width, py}, "stroke=\"#e8e8e8\"");
    page.text({corner.first - 6, py + 4}, fmt::format("{:g}", y), "text-anchor=\"end\" fill=\"#555\"");
  }
  page.rect(corner, width, height, "fill=\"none\" stroke=\"#999\"");
  page.text({corner.first + 0.5 * width, bottom + 34}, x_name, "text-anchor=\"middle\"");
  const XY side{corner.first - 38, corner.second + 0.5 * height};
  page.text(side, y_name,
            fmt::format("text-anchor=\"middle\" transform=\"rotate(-90 {:.1f} {:.1f})\"", side.first, side.second));
}

std::vector<double> round_ticks(const XY& range, int most) {
  const double least = (range.second - range.first) / std::max(most, 1);
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  double step = 10.0 * power;
  for (const double digit : {5.0, 2.0, 1.0}) {
    if (digit * power >= least) step = digit * power;
  }
  std::vector<double> ticks;
  for (double k = std::ceil(range.first / step); k * step <= range.second; k += 1.0) ticks.push_back(k * step + 0.0);
  return ticks;
}

}  // namespace tern
