// Strict configuration: an unknown key, a wrong type or a value out of range names file, line, key, value and limit.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/base/types.h"

namespace tern {

/// what() is for the user: "scenarios/x.yaml:12: uav.limits.v_max: -3 is out of range (0, 1000]"; for a value of the
/// command line "--set uav.limits.v_max=-3: uav.limits.v_max: -3 is out of range (0, 1000]".
class ConfigError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

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

/// One mapping of a YAML file. Every read names its default, so that the effective configuration can be written out
/// whole. All methods throw ConfigError. Call finish() when all keys are read: it refuses the unknown ones. Copies, and
/// sections got twice by the same key, are the same section.
///
/// Types are strict: a number is a plain scalar like 3, -0.5, 1e-3 or inf, an integer has no point, a flag is true or
/// false; a quoted scalar is text only; a key without a value is an error, except that an empty section or list may be
/// written so.
class ConfigSection {
 public:
  double number(std::string_view key, double fallback, Range range = {});
  std::int64_t integer(std::string_view key, std::int64_t fallback, std::int64_t low, std::int64_t high);
  bool flag(std::string_view key, bool fallback);
  std::string text(std::string_view key, std::string fallback);
  /// One of the words.
  std::string choice(std::string_view key, std::string fallback, const std::vector<std::string>& words);
  Vec3 vec3(std::string_view key, const Vec3& fallback, Range each = {});
  /// Three numbers, or one number that stands for all three.
  Vec3 vec3_or_number(std::string_view key, const Vec3& fallback, Range each = {});
  std::vector<double> numbers(std::string_view key, std::vector<double> fallback, Range each = {});
  /// Rows of `columns` numbers each, [[1, 2], [3, 4]]; absent is empty.
  std::vector<std::vector<double>> rows(std::string_view key, std::size_t columns, Range each = {});
  /// Whether the key is given; marks it as known.
  [[nodiscard]] bool has(std::string_view key);
  double required_number(std::string_view key, Range range = {});
  std::string required_text(std::string_view key);
  Vec3 required_vec3(std::string_view key, Range each = {});
  ConfigSection section(std::string_view key);            ///< an absent mapping is an empty one
  std::vector<ConfigSection> list(std::string_view key);  ///< of mappings; absent is empty
  std::vector<std::string> keys() const;                  ///< in file order (for open tables such as classes)
  /// Marks a key as known without reading it (another process's section).
  void ignore(std::string_view key);
  /// @throws ConfigError at the first key that was neither read nor ignored; it lists the known ones.
  void finish() const;
  /// A ConfigError that names this section's key: for rules between fields, which come after finish(), so that a
  /// misspelt key is called unknown and its default is not blamed.
  [[nodiscard]] ConfigError error(std::string_view key, const std::string& what) const;

  /// Made by ConfigDocument only: a default-constructed section may not be used.
  struct Impl;
  explicit ConfigSection(std::shared_ptr<Impl> impl = nullptr) : impl_(std::move(impl)) {}

 private:
  std::shared_ptr<Impl> impl_;
};

/// A YAML file with `--set key.path=value` overrides applied.
class ConfigDocument {
 public:
  /// An override's path may name an entry of a list as in `world.obstacles[2].centre`; what is missing of the path is
  /// made; its value is YAML. Overrides are applied in their order. An empty file name is an empty document.
  /// @throws ConfigError: no such file, one that parse_yaml refuses, an override that is not key=value.
  static ConfigDocument load(const std::string& file, const std::vector<std::string>& overrides);
  /// The same for YAML in memory; `name` stands where the file's name would.
  static ConfigDocument parse(const std::string& yaml, const std::string& name,
                              const std::vector<std::string>& overrides = {});
  ConfigSection root();
  /// All values that were read, defaults included, as YAML, in the order of reading: published on CONFIGURATION.
  [[nodiscard]] std::string effective() const;
  [[nodiscard]] const std::string& file() const;

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace tern
