// A YAML document as plain values that know where they stand; the only place that knows yaml-cpp.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tern {

/// What a document may be at most. The largest is read in under 100 MB and about a second; a path of ten thousand
/// waypoints has 50,000 values in half a megabyte.
inline constexpr std::size_t kMaxYamlBytes = std::size_t{4} << 20U;
inline constexpr std::size_t kMaxYamlValues = 200'000;  ///< keys count, and what an alias repeats, each time
inline constexpr std::size_t kMaxYamlDepth = 32;        ///< levels of nesting; scenario files are shallow

struct YamlEntry;

/// One value of a document.
struct YamlValue {
  enum class Kind { Null, Scalar, Sequence, Mapping };
  Kind kind = Kind::Null;
  std::string where;               ///< "scenarios/x.yaml:12" or "--set key=value"
  std::string scalar;              ///< of a Scalar
  bool quoted = false;             ///< a quoted scalar is text only
  std::vector<YamlValue> items;    ///< of a Sequence
  std::vector<YamlEntry> entries;  ///< of a Mapping, in file order, no key twice

  /// The entry, or nullptr.
  [[nodiscard]] const YamlValue* find(std::string_view key) const;
  [[nodiscard]] YamlValue* find(std::string_view key);
  /// For messages: the scalar itself, "a list", "a mapping", "nothing".
  [[nodiscard]] std::string describe() const;
};

struct YamlEntry {
  std::string key;
  YamlValue value;
};

/// Parses a document whose top is a mapping (or nothing, which is an empty one).
/// Linear in the text's length and in the number of values; an alias is counted before it is repeated.
/// @throws ConfigError for what is not YAML, a key given twice, a key that is not a scalar, a limit above broken.
YamlValue parse_yaml(const std::string& text, const std::string& name);

/// Applies "key.path=value" (the text after --set) to a document. @throws ConfigError naming the override.
void apply_override(YamlValue& document, const std::string& override_text);

/// The scalar as it must be written to be read back as the same text: plain where that is safe, else quoted.
std::string yaml_text(std::string_view text);

/// The number in the shortest form that reads back as the same double; ".inf" for infinity.
std::string yaml_number(double value);

}  // namespace tern
