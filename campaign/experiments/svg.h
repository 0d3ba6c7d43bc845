// Writes SVG drawings: shapes on a page, and frames that map data to the page.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace tern {

/// A point on the page (pixels, y downwards) or in data.
using XY = std::pair<double, double>;

/// An SVG page. `attributes` are SVG's own: fill="none" stroke="#888". Coordinates have a precision of 0.1 pixel.
class Svg {
 public:
  /// Begins a white page of this size in pixels.
  Svg(double width, double height);

  void rect(const XY& corner, double width, double height, const std::string& attributes);
  void circle(const XY& centre, double radius, const std::string& attributes);
  void line(const XY& from, const XY& to, const std::string& attributes);
  void polyline(const std::vector<XY>& points, const std::string& attributes);
  void polygon(const std::vector<XY>& points, const std::string& attributes);
  /// @param text  reserved characters of XML are escaped
  void text(const XY& at, const std::string& text, const std::string& attributes = "");
  /// Applies attributes (opacity, transform, clip-path) to everything up to close_group().
  void open_group(const std::string& attributes);
  void close_group();
  /// Defines a rectangle for clip-path="url(#name)".
  void clip_rect(const std::string& name, const XY& corner, double width, double height);

  [[nodiscard]] std::string finish() const;

 private:
  double width_, height_;
  std::string body_;
};

/// A rectangle on the page with ranges of data: x to the right, y upwards.
struct PlotFrame {
  XY corner;  ///< upper left, pixels
  double width = 100.0, height = 100.0;
  XY x_range{0.0, 1.0}, y_range{0.0, 1.0};

  [[nodiscard]] XY at(double x, double y) const;
  [[nodiscard]] XY at(const XY& data) const { return at(data.first, data.second); }
  /// Draws border, ticks, numbers and axis names.
  void draw_axes(Svg& page, const std::string& x_name, const std::string& y_name) const;
};

/// Returns up to about `most` round numbers within the range, ascending.
std::vector<double> round_ticks(const XY& range, int most);

}  // namespace tern
