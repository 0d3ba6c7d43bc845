// How a configuration struct states its knobs: once, for whoever reads, explains or documents them.
//
//     struct HoverConfig {
//       double height_m = 1.5;
//       Mode mode = Mode::Still;
//       template <typename V>
//       void visit(V& v) {
//         v("height_m", height_m, Range{0.1, 50.0}, "m above the ground");
//         v("mode", mode, KnobWords<Mode>{{"still", Mode::Still}, {"drift", Mode::Drift}}, "what wind may do");
//       }
//     };
//
// A member's initial value is the default. A member that has knobs of its own is visited as v("name", member).
#pragma once

#include <limits>
#include <utility>
#include <vector>

namespace tern {

/// A closed or open interval of allowed numbers. Infinity (written `inf`) is allowed only where `high` is infinite and
/// `low` is not, as in Range::positive(infinity); NaN never.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;  ///< low itself is not allowed
  static Range positive(double high = 1e9) { return {0.0, high, true}; }
  static Range at_least(double low, double high = 1e9) { return {low, high}; }
  /// Any finite number up to a magnitude.
  static Range within(double magnitude) { return {-magnitude, magnitude}; }
};

/// The words for the values of an enumeration.
template <typename E>
using KnobWords = std::vector<std::pair<const char*, E>>;

}  // namespace tern
