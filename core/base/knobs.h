// How a configuration struct lists its knobs, the keys of a configuration. Readers, `--help` and the tables in the
// documentation are made from this one list.
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
// A member's initial value is its default. A member that has knobs of its own is visited as v("name", member).
#pragma once

#include <limits>
#include <utility>
#include <vector>

namespace tern {

/// The interval of allowed numbers. Infinity (written `inf`) is allowed if `high` is infinite and `low` is finite, as
/// in Range::positive(infinity). NaN is never allowed.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;  ///< true: `low` itself is excluded
  static Range positive(double high = 1e9) { return {0.0, high, true}; }
  static Range at_least(double low, double high = 1e9) { return {low, high}; }
  /// Every x with |x| ≤ magnitude.
  static Range within(double magnitude) { return {-magnitude, magnitude}; }
};

/// The words by which a configuration names the values of an enumeration.
template <typename E>
using KnobWords = std::vector<std::pair<const char*, E>>;

}  // namespace tern
