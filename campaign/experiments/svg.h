// Drawings as SVG text: shapes on a page, and frames that turn data into places on it.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace tern {

/// A place on the page (pixels, y downwards) or in data.
using XY = std::pair<double, double>;

/// `attributes` are SVG's own, as in fill="none" stroke="#888". Coordinates are written to a tenth of a pixel.
class Svg {
 public:
  /// A white page of so many pixels.
  Svg(double width, double height);

  void rect(const XY& corner, double width, double height, const std::string& attributes);
  void circle(const XY& centre, double radius, const std::string& attributes);
  void line(const XY& from, const XY& to, const std::string& attributes);
  void polyline(const std::vector<XY>& points, const std::string& attributes);
  void polygon(const std::vector<XY>& points, const std::string& attributes);
  /// @param text  any; what XML reserves is escaped
  void text(const XY& at, const std::string& text, const std::string& attributes = "");
  /// What follows, up to close_group, has these attributes (opacity, transform, clip-path).
  void open_group(const std::string& attributes);
  void close_group();
  /// Names a rectangle for clip-path="url(#name)".
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
  /// Border, ticks, numbers and names.
  void draw_axes(Svg& page, const std::string& x_name, const std::string& y_name) const;
};

/// Up to about `most` round numbers within the range, ascending.
std::vector<double> round_ticks(const XY& range, int most);

}  // namespace tern
