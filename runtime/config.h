// Strict configuration: an unknown key, a wrong type or a value out of range is refused with file, line, key, value and
// limit.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/knobs.h"
#include "core/base/result.h"
#include "core/base/time.h"
#include "core/base/types.h"
#include "runtime/config_record.h"

namespace tern {

/// A refused configuration. Its text is written for the user, as in "scenarios/x.yaml:12: uav.limits.v_max: -3 is out
/// of range (0, 1000]". For a value of the command line it begins "--set uav.limits.v_max=-3: ".
class ConfigError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Returns the result's value. @throws ConfigError with `before` and the error's text if there is none.
template <class T>
T value_or_throw(Result<T> result, const std::string& before = "") {
  if (!result) throw ConfigError(before + result.error().message);
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

/// One mapping of a YAML file. Each read states its default, so the effective configuration can be written out. All
/// methods throw ConfigError. After reading all keys call finish(), which refuses the unread ones. Copies of a section,
/// and sections obtained twice with one key, are the same section.
///
/// Types are strict:
/// - A number is a plain scalar such as 3, -0.5, 1e-3 or inf. An integer has no decimal point.
/// - A flag is true or false.
/// - A quoted scalar is text only.
/// - A key without a value is an error, except for an empty section or list.
class ConfigSection {
 public:
  double number(std::string_view key, double fallback, Range range = {}, std::string_view meaning = {});
  std::int64_t integer(std::string_view key, std::int64_t fallback, std::int64_t low, std::int64_t high,
                       std::string_view meaning = {});
  bool flag(std::string_view key, bool fallback, std::string_view meaning = {});
  std::string text(std::string_view key, const std::string& fallback, std::string_view meaning = {});
  /// One of `words`.
  std::string choice(std::string_view key, const std::string& fallback, const std::vector<std::string>& words,
                     std::string_view meaning = {});
  Vec3 vec3(std::string_view key, const Vec3& fallback, Range each = {}, std::string_view meaning = {});
  /// Three numbers, or one number that stands for all three.
  Vec3 vec3_or_number(std::string_view key, const Vec3& fallback, Range each = {});
  std::vector<double> numbers(std::string_view key, const std::vector<double>& fallback, Range each = {},
                              std::string_view meaning = {});
  /// Rows of `columns` numbers each, as [[1, 2], [3, 4]]; empty if the key is absent.
  std::vector<std::vector<double>> rows(std::string_view key, std::size_t columns, Range each = {});
  /// Reads every knob of a struct (core/base/knobs.h), then finishes.
  template <typename Config>
  void read(Config& config);
  /// Reads every knob of a default-constructed struct, then finishes.
  template <typename Config>
  Config read() {
    Config config;
    read(config);
    return config;
  }
  /// Whether the key is given. Marks it as known.
  [[nodiscard]] bool has(std::string_view key);
  double required_number(std::string_view key, Range range = {});
  std::string required_text(std::string_view key, std::string_view meaning = {});
  Vec3 required_vec3(std::string_view key, Range each = {}, std::string_view meaning = {});
  ConfigSection section(std::string_view key);            ///< an absent mapping is read as an empty one
  std::vector<ConfigSection> list(std::string_view key);  ///< list of mappings; empty if absent
  std::vector<std::string> keys() const;                  ///< in file order (for open tables such as classes)
  /// Marks a key as known without reading it (another process's section).
  void ignore(std::string_view key);
  /// @throws ConfigError at the first key that was neither read nor ignored; it lists the known ones.
  void finish() const;
  /// A ConfigError that names this section's key, for rules between fields. Check such rules after finish(): a misspelt
  /// key is then reported as unknown before its default is blamed.
  [[nodiscard]] ConfigError error(std::string_view key, const std::string& what) const;

  /// Made by ConfigDocument only; a default-constructed section may not be used.
  struct Impl;
  explicit ConfigSection(std::shared_ptr<Impl> impl = nullptr) : impl_(std::move(impl)) {}

 private:
  std::shared_ptr<Impl> impl_;
};

class ConfigDocument {
 public:
  /// Reads a file and applies the overrides in their order. An empty file name gives an empty document. The path of an
  /// override may name an entry of a list, as `world.obstacles[2].centre`. Missing parts of the path are created. The
  /// value is YAML.
  /// @throws ConfigError for a missing file, text that parse_yaml refuses, or an override without "key=value".
  static ConfigDocument load(const std::string& file, const std::vector<std::string>& overrides);
  /// Does the same with YAML in memory; `name` takes the place of the file's name in messages.
  static ConfigDocument parse(const std::string& yaml, const std::string& name,
                              const std::vector<std::string>& overrides = {});
  ConfigSection root();
  /// All values read so far, defaults included, as YAML in the order of reading. It is published on CONFIGURATION.
  [[nodiscard]] std::string effective() const;
  /// All keys read so far, in the order of reading; of a list the keys of its first entry.
  [[nodiscard]] std::vector<Knob> knobs() const;
  [[nodiscard]] const std::string& file() const;

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

/// The visitor for a struct's visit(): reads each knob; the member's value is the default.
class KnobReader {
 public:
  explicit KnobReader(ConfigSection section) : section_(std::move(section)) {}
  void operator()(std::string_view key, double& value, Range range, std::string_view meaning) {
    value = section_.number(key, value, range, meaning);
  }
  void operator()(std::string_view key, int& value, Range range, std::string_view meaning) {
    value = static_cast<int>(section_.integer(key, value, static_cast<std::int64_t>(range.low),
                                              static_cast<std::int64_t>(range.high), meaning));
  }
  /// In seconds. Divides by 10⁶ instead of multiplying as seconds() does, so that the default prints as the shortest
  /// decimal of the whole microseconds.
  void operator()(std::string_view key, Duration& value, Range range, std::string_view meaning) {
    const double seconds = static_cast<double>(value.us) / 1e6;
    value = Duration::from_seconds(section_.number(key, seconds, range, meaning));
  }
  void operator()(std::string_view key, bool& value, std::string_view meaning) {
    value = section_.flag(key, value, meaning);
  }
  void operator()(std::string_view key, std::vector<double>& value, Range each, std::string_view meaning) {
    value = section_.numbers(key, value, each, meaning);
  }
  template <typename E>
  void operator()(std::string_view key, E& value, const KnobWords<E>& words, std::string_view meaning) {
    std::vector<std::string> names;
    std::string fallback;
    for (const auto& [name, meant] : words) {
      names.emplace_back(name);
      if (meant == value) fallback = name;
    }
    const std::string chosen = section_.choice(key, fallback, names, meaning);
    for (const auto& [name, meant] : words) {
      if (chosen == name) value = meant;
    }
  }
  template <typename Config>
  void operator()(std::string_view key, Config& config) {
    section_.section(key).read(config);
  }

 private:
  ConfigSection section_;
};

template <typename Config>
void ConfigSection::read(Config& config) {
  KnobReader reader(*this);
  config.visit(reader);
  finish();
}

}  // namespace tern
