#include "runtime/config.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>

#include "runtime/yaml_tree.h"

namespace tern {
namespace {

std::string to_yaml(const std::vector<double>& values) {
  std::vector<std::string> parts;
  parts.reserve(values.size());
  for (const double v : values) parts.push_back(yaml_number(v));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

std::string to_yaml(const Vec3& v) { return to_yaml(std::vector<double>{v.x(), v.y(), v.z()}); }

/// An unbounded Range means "any finite number"; infinity is allowed only with a finite low and an infinite high.
bool allows_infinity(const Range& range) { return std::isinf(range.high) && !std::isinf(range.low); }

std::string describe(const Range& range) {
  const bool closed_above = !std::isinf(range.high) || allows_infinity(range);
  return fmt::format("{}{}, {}{}", range.low_open || std::isinf(range.low) ? '(' : '[', range.low, range.high,
                     closed_above ? ']' : ')');
}

std::optional<double> parse_number(const YamlValue& value) {
  if (value.kind != YamlValue::Kind::Scalar || value.quoted) return std::nullopt;
  std::string_view text = value.scalar;
  static constexpr std::string_view kInfinities[] = {"inf", ".inf", ".Inf", "+inf", "+.inf"};
  if (std::find(std::begin(kInfinities), std::end(kInfinities), text) != std::end(kInfinities)) {
    return std::numeric_limits<double>::infinity();
  }
  if (text == "-inf" || text == "-.inf") return -std::numeric_limits<double>::infinity();
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double number = 0.0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || rest != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

bool allows(const Range& range, double v) {
  if (std::isinf(v) && !allows_infinity(range)) return false;
  return (range.low_open ? v > range.low : v >= range.low) && v <= range.high;
}

}  // namespace

struct ConfigSection::Impl {
  const YamlValue* value = nullptr;           ///< null: the section is absent
  std::shared_ptr<const YamlValue> document;  ///< keeps `value` alive
  std::string path;                           ///< "uav.limits"; "" at the top
  std::string where;                          ///< place for messages about missing keys
  std::set<std::string, std::less<>> known;
  ConfigRecordPtr record = std::make_shared<ConfigRecord>();
  std::map<std::string, std::shared_ptr<Impl>, std::less<>> sections;
  std::map<std::string, std::vector<std::shared_ptr<Impl>>, std::less<>> lists;

  [[nodiscard]] std::string path_of(std::string_view key) const {
    return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
  }

  [[nodiscard]] ConfigError error(std::string_view key, const YamlValue* at, const std::string& what) const {
    return ConfigError(fmt::format("{}: {}: {}", at != nullptr ? at->where : where, path_of(key), what));
  }

  const YamlValue* find(std::string_view key) {
    known.emplace(key);
    return value == nullptr ? nullptr : value->find(key);
  }

  const YamlValue& require(std::string_view key) {
    const YamlValue* found = find(key);
    if (found == nullptr) throw error(key, nullptr, "is missing");
    return *found;
  }

  /// @param knob  without a path
  void note(std::string_view key, std::string rendered, Knob knob = {}) {
    for (ConfigRecord::Entry& entry : record->entries) {
      if (entry.key == key) {
        entry.value = std::move(rendered);
        return;
      }
    }
    record->entries.push_back({std::string(key), std::move(rendered), std::move(knob)});
  }

  void note_required(std::string_view key) const {
    for (ConfigRecord::Entry& entry : record->entries) {
      if (entry.key == key) entry.knob.fallback = "required";
    }
  }

  double number(std::string_view key, const YamlValue& v, const Range& range) const {
    const auto number = parse_number(v);
    if (!number) throw error(key, &v, v.describe() + " is not a number");
    if (!allows(range, *number)) {
      throw error(key, &v, fmt::format("{} is out of range {}", v.describe(), describe(range)));
    }
    return *number;
  }

  std::vector<double> numbers(std::string_view key, const YamlValue& v, const Range& range) const {
    if (v.kind != YamlValue::Kind::Sequence) throw error(key, &v, v.describe() + " is not a list of numbers");
    std::vector<double> result;
    for (std::size_t i = 0; i < v.items.size(); ++i)
      result.push_back(number(fmt::format("{}[{}]", key, i), v.items[i], range));
    return result;
  }

  Vec3 vec3(std::string_view key, const YamlValue& v, const Range& range) const {
    if (v.kind != YamlValue::Kind::Sequence || v.items.size() != 3) {
      throw error(key, &v, v.describe() + " is not a list of 3 numbers, [x, y, z]");
    }
    const std::vector<double> n = numbers(key, v, range);
    return {n[0], n[1], n[2]};
  }

  std::string text(std::string_view key, const YamlValue& v) const {
    if (v.kind != YamlValue::Kind::Scalar) throw error(key, &v, v.describe() + " is not text");
    return v.scalar;
  }

  std::shared_ptr<Impl> child(const YamlValue* v, std::string child_path) const {
    auto made = std::make_shared<Impl>();
    made->document = document;
    made->path = std::move(child_path);
    made->where = v != nullptr ? v->where : where;
    if (v != nullptr && v->kind != YamlValue::Kind::Null) made->value = v;
    if (made->value != nullptr && made->value->kind != YamlValue::Kind::Mapping) {
      throw ConfigError(fmt::format("{}: {}: {} is not a mapping", made->where, made->path, v->describe()));
    }
    return made;
  }
};

double ConfigSection::number(std::string_view key, double fallback, Range range, std::string_view meaning) {
  const YamlValue* v = impl_->find(key);
  const double result = v != nullptr ? impl_->number(key, *v, range) : fallback;
  impl_->note(key, yaml_number(result), {"", yaml_number(fallback), describe(range), std::string(meaning)});
  return result;
}

std::int64_t ConfigSection::integer(std::string_view key, std::int64_t fallback, std::int64_t low, std::int64_t high,
                                    std::string_view meaning) {
  std::int64_t result = fallback;
  if (const YamlValue* v = impl_->find(key)) {
    const char* const end = v->scalar.data() + v->scalar.size();
    const auto [rest, error] = std::from_chars(v->scalar.data(), end, result);
    const bool digits = v->kind == YamlValue::Kind::Scalar && !v->quoted && rest == end && !v->scalar.empty();
    if (!digits || error == std::errc::invalid_argument)
      throw impl_->error(key, v, v->describe() + " is not an integer");
    if (error != std::errc{} || result < low || result > high) {
      throw impl_->error(key, v, fmt::format("{} is out of range [{}, {}]", v->describe(), low, high));
    }
  }
  impl_->note(key, fmt::format("{}", result),
              {"", fmt::format("{}", fallback), fmt::format("[{}, {}]", low, high), std::string(meaning)});
  return result;
}

bool ConfigSection::flag(std::string_view key, bool fallback, std::string_view meaning) {
  bool result = fallback;
  if (const YamlValue* v = impl_->find(key)) {
    const bool word = v->kind == YamlValue::Kind::Scalar && !v->quoted && (v->scalar == "true" || v->scalar == "false");
    if (!word) throw impl_->error(key, v, v->describe() + " is not true or false");
    result = v->scalar == "true";
  }
  impl_->note(key, result ? "true" : "false", {"", fallback ? "true" : "false", "", std::string(meaning)});
  return result;
}

std::string ConfigSection::text(std::string_view key, const std::string& fallback, std::string_view meaning) {
  const YamlValue* v = impl_->find(key);
  std::string result = v != nullptr ? impl_->text(key, *v) : fallback;
  impl_->note(key, yaml_text(result), {"", yaml_text(fallback), "", std::string(meaning)});
  return result;
}

std::string ConfigSection::choice(std::string_view key, const std::string& fallback,
                                  const std::vector<std::string>& words, std::string_view meaning) {
  const YamlValue* v = impl_->find(key);
  std::string result = v != nullptr ? impl_->text(key, *v) : fallback;
  impl_->note(key, yaml_text(result),
              {"", yaml_text(fallback), fmt::format("{}", fmt::join(words, ", ")), std::string(meaning)});
  if (std::find(words.begin(), words.end(), result) == words.end()) {
    throw error(key, fmt::format("{} is not one of {}", result, fmt::join(words, ", ")));
  }
  return result;
}

Vec3 ConfigSection::vec3(std::string_view key, const Vec3& fallback, Range each, std::string_view meaning) {
  const YamlValue* v = impl_->find(key);
  Vec3 result = v != nullptr ? impl_->vec3(key, *v, each) : fallback;
  impl_->note(key, to_yaml(result), {"", to_yaml(fallback), describe(each) + " each", std::string(meaning)});
  return result;
}

Vec3 ConfigSection::vec3_or_number(std::string_view key, const Vec3& fallback, Range each) {
  const YamlValue* v = impl_->find(key);
  if (v == nullptr || v->kind != YamlValue::Kind::Scalar) return vec3(key, fallback, each);
  Vec3 result = Vec3::Constant(impl_->number(key, *v, each));
  impl_->note(key, to_yaml(result));
  return result;
}

std::vector<double> ConfigSection::numbers(std::string_view key, const std::vector<double>& fallback, Range each,
                                           std::string_view meaning) {
  const YamlValue* v = impl_->find(key);
  std::vector<double> result = v != nullptr ? impl_->numbers(key, *v, each) : fallback;
  impl_->note(key, to_yaml(result), {"", to_yaml(fallback), describe(each) + " each", std::string(meaning)});
  return result;
}

std::vector<std::vector<double>> ConfigSection::rows(std::string_view key, std::size_t columns, Range each) {
  std::vector<std::vector<double>> result;
  std::vector<std::string> rendered;
  if (const YamlValue* v = impl_->find(key)) {
    if (v->kind != YamlValue::Kind::Sequence)
      throw impl_->error(key, v, v->describe() + " is not a list of lists of numbers");
    for (const YamlValue& row : v->items) {
      const std::string row_key = fmt::format("{}[{}]", key, result.size());
      if (row.items.size() != columns) {
        throw impl_->error(row_key, &row, fmt::format("{} is not a list of {} numbers", row.describe(), columns));
      }
      result.push_back(impl_->numbers(row_key, row, each));
      rendered.push_back(to_yaml(result.back()));
    }
  }
  impl_->note(key, fmt::format("[{}]", fmt::join(rendered, ", ")));
  return result;
}

bool ConfigSection::has(std::string_view key) { return impl_->find(key) != nullptr; }

double ConfigSection::required_number(std::string_view key, Range range) {
  impl_->require(key);
  const double value = number(key, 0.0, range);
  impl_->note_required(key);
  return value;
}

std::string ConfigSection::required_text(std::string_view key, std::string_view meaning) {
  impl_->require(key);
  std::string value = text(key, "", meaning);
  impl_->note_required(key);
  return value;
}

Vec3 ConfigSection::required_vec3(std::string_view key, Range each, std::string_view meaning) {
  impl_->require(key);
  Vec3 value = vec3(key, Vec3::Zero(), each, meaning);
  impl_->note_required(key);
  return value;
}

ConfigSection ConfigSection::section(std::string_view key) {
  const auto found = impl_->sections.find(key);
  if (found != impl_->sections.end()) return ConfigSection(found->second);
  auto made = impl_->child(impl_->find(key), impl_->path_of(key));
  impl_->sections.emplace(key, made);
  impl_->record->entries.push_back({std::string(key), made->record});
  return ConfigSection(made);
}

std::vector<ConfigSection> ConfigSection::list(std::string_view key) {
  auto [found, is_new] = impl_->lists.try_emplace(std::string(key));
  if (is_new) {
    std::vector<ConfigRecordPtr> records;
    const YamlValue* v = impl_->find(key);
    if (v != nullptr && v->kind != YamlValue::Kind::Sequence && v->kind != YamlValue::Kind::Null) {
      throw impl_->error(key, v, v->describe() + " is not a list");
    }
    for (std::size_t i = 0; v != nullptr && i < v->items.size(); ++i) {
      found->second.push_back(impl_->child(&v->items[i], fmt::format("{}[{}]", impl_->path_of(key), i)));
      records.push_back(found->second.back()->record);
    }
    impl_->record->entries.push_back({std::string(key), std::move(records)});
  }
  std::vector<ConfigSection> result;
  for (const auto& item : found->second) result.emplace_back(item);
  return result;
}

std::vector<std::string> ConfigSection::keys() const {
  std::vector<std::string> result;
  if (impl_->value != nullptr) {
    for (const auto& entry : impl_->value->entries) result.push_back(entry.key);
  }
  return result;
}

void ConfigSection::ignore(std::string_view key) { impl_->known.emplace(key); }

void ConfigSection::finish() const {
  if (impl_->value == nullptr) return;
  for (const auto& [key, v] : impl_->value->entries) {
    if (impl_->known.contains(key)) continue;
    const std::string known = impl_->known.empty() ? "none" : fmt::format("{}", fmt::join(impl_->known, ", "));
    throw impl_->error(key, &v, "unknown key (known here: " + known + ")");
  }
}

ConfigError ConfigSection::error(std::string_view key, const std::string& what) const {
  return impl_->error(key, impl_->value == nullptr ? nullptr : impl_->value->find(key), what);
}

struct ConfigDocument::Impl {
  std::string file;
  std::shared_ptr<ConfigSection::Impl> root;
};

ConfigDocument ConfigDocument::load(const std::string& file, const std::vector<std::string>& overrides) {
  if (file.empty()) return parse("", "(no file)", overrides);
  std::ifstream stream(file);
  if (!stream || std::filesystem::is_directory(file)) throw ConfigError(file + ": cannot be read");
  std::string text(kMaxYamlBytes + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return parse(text, file, overrides);
}

ConfigDocument ConfigDocument::parse(const std::string& yaml, const std::string& name,
                                     const std::vector<std::string>& overrides) {
  auto tree = std::make_shared<YamlValue>(parse_yaml(yaml, name));
  for (const std::string& text : overrides) apply_override(*tree, text);
  ConfigDocument document;
  document.impl_ = std::make_shared<Impl>();
  document.impl_->file = name;
  auto root = std::make_shared<ConfigSection::Impl>();
  root->value = tree.get();
  root->where = name;
  root->document = std::move(tree);
  document.impl_->root = std::move(root);
  return document;
}

ConfigSection ConfigDocument::root() { return ConfigSection(impl_->root); }

std::string ConfigDocument::effective() const {
  std::string out;
  impl_->root->record->write(out, 0);
  return out;
}

std::vector<Knob> ConfigDocument::knobs() const {
  std::vector<Knob> knobs;
  impl_->root->record->list(knobs, "");
  return knobs;
}

const std::string& ConfigDocument::file() const { return impl_->file; }

}  // namespace tern
