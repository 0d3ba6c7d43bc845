// A YAML document as plain values with their positions; the only use of yaml-cpp.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tern {

/// Limits of a document. The largest is read in under 100 MB and about a second; a path of ten thousand waypoints has
/// 50,000 values in half a megabyte.
inline constexpr std::size_t kMaxYamlBytes = std::size_t{4} << 20U;
inline constexpr std::size_t kMaxYamlValues =
    200'000;                                      ///< keys included; a value repeated by an alias counts each time
inline constexpr std::size_t kMaxYamlDepth = 32;  ///< levels of nesting; scenario files are shallow

struct YamlEntry;

/// One value of a document.
struct YamlValue {
  enum class Kind { Null, Scalar, Sequence, Mapping };
  Kind kind = Kind::Null;
  std::string where;               ///< "scenarios/x.yaml:12" or "--set key=value"
  std::string scalar;              ///< text of a Scalar
  bool quoted = false;             ///< a quoted scalar is text only
  std::vector<YamlValue> items;    ///< elements of a Sequence
  std::vector<YamlEntry> entries;  ///< entries of a Mapping, in file order, no key twice

  /// The value of a key, or nullptr.
  [[nodiscard]] const YamlValue* find(std::string_view key) const;
  [[nodiscard]] YamlValue* find(std::string_view key);
  /// Text for messages: the scalar itself, "a list", "a mapping" or "an empty value".
  [[nodiscard]] std::string describe() const;
};

struct YamlEntry {
  std::string key;
  YamlValue value;
};

/// Parses a document whose top is a mapping; an empty document is an empty mapping. Linear in the text's length and in
/// the number of values, repetitions by aliases included.
/// @throws ConfigError for malformed YAML, a key given twice, a key other than a scalar, or a broken limit above.
YamlValue parse_yaml(const std::string& text, const std::string& name);

/// Applies "key.path=value" (the argument of --set) to a document. @throws ConfigError that names the override.
void apply_override(YamlValue& document, const std::string& override_text);

/// Writes a scalar so that it is read back as the same text: plain where that is safe, else quoted.
std::string yaml_text(std::string_view text);

/// Writes a number in the shortest form that is read back as the same double; ".inf" for infinity.
std::string yaml_number(double value);

}  // namespace tern
