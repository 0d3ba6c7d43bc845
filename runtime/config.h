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

/// What() is for the user: "scenarios/x.yaml:12: uav.limits.v_max: -3 is out of range (0, 1000]".
class ConfigError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A closed or open interval of allowed numbers.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;  ///< low itself is not allowed
  static Range positive(double high = 1e9) { return {0.0, high, true}; }
  static Range at_least(double low, double high = 1e9) { return {low, high}; }
};

/// One mapping of a YAML file. Every read names its default, so that the effective configuration can be written out whole.
/// All methods throw ConfigError. Call finish() when all keys are read: it refuses the unknown ones.
class ConfigSection {
 public:
  double number(std::string_view key, double fallback, Range range = {});
  std::int64_t integer(std::string_view key, std::int64_t fallback, std::int64_t low, std::int64_t high);
  bool flag(std::string_view key, bool fallback);
  std::string text(std::string_view key, std::string fallback);
  /// One of the words.
  std::string choice(std::string_view key, std::string fallback, const std::vector<std::string>& words);
  Vec3 vec3(std::string_view key, const Vec3& fallback, Range each = {});
  std::vector<double> numbers(std::string_view key, std::vector<double> fallback, Range each = {});
  [[nodiscard]] bool has(std::string_view key) const;
  double required_number(std::string_view key, Range range = {});
  std::string required_text(std::string_view key);
  Vec3 required_vec3(std::string_view key, Range each = {});
  ConfigSection section(std::string_view key);               ///< an absent mapping is an empty one
  std::vector<ConfigSection> list(std::string_view key);     ///< of mappings; absent is empty
  std::vector<std::string> keys() const;                     ///< in file order (for open tables such as classes)
  /// Marks a key as known without reading it (another process's section).
  void ignore(std::string_view key);
  void finish() const;
  /// A ConfigError that names this section's key: for rules between fields.
  [[nodiscard]] ConfigError error(std::string_view key, const std::string& what) const;

 private:
  friend class ConfigDocument;
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

/// A YAML file with `--set key.path=value` overrides applied.
class ConfigDocument {
 public:
  /// @throws ConfigError: no such file, not YAML, an override that is not key=value.
  static ConfigDocument load(const std::string& file, const std::vector<std::string>& overrides);
  ConfigSection root();
  /// All values that were read, defaults included, as YAML: published on CONFIGURATION.
  [[nodiscard]] std::string effective() const;
  [[nodiscard]] const std::string& file() const;

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace tern
