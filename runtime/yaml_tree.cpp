#include "runtime/yaml_tree.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <functional>
#include <optional>

#include "runtime/config.h"

namespace tern {
namespace {

/// Names the place of a YAML mark (which counts from 0).
using Locate = std::function<std::string(const YAML::Mark&)>;

/// Scenario files are shallow; a bomb of nested brackets or aliases is not.
constexpr int kMaxDepth = 32;

YamlValue convert(const YAML::Node& node, const Locate& locate, int depth) {
  YamlValue value;
  value.where = locate(node.Mark());
  if (depth > kMaxDepth) throw ConfigError(fmt::format("{}: nested deeper than {} levels", value.where, kMaxDepth));
  if (node.IsScalar()) {
    value.kind = YamlValue::Kind::Scalar;
    value.scalar = node.Scalar();
    value.quoted = node.Tag() == "!";
  } else if (node.IsSequence()) {
    value.kind = YamlValue::Kind::Sequence;
    for (const YAML::Node& item : node) value.items.push_back(convert(item, locate, depth + 1));
  } else if (node.IsMap()) {
    value.kind = YamlValue::Kind::Mapping;
    for (const auto& entry : node) {
      const std::string where = locate(entry.first.Mark());
      if (!entry.first.IsScalar()) throw ConfigError(where + ": a key must be a word");
      const std::string key = entry.first.Scalar();
      if (const YamlValue* first = value.find(key)) {
        throw ConfigError(fmt::format("{}: key {} is given twice (first at {})", where, key, first->where));
      }
      value.entries.emplace_back(key, convert(entry.second, locate, depth + 1));
      // A mapping below its key begins a line later, a value left out may lie anywhere: the key's line is what one
      // looks for.
      value.entries.back().second.where = where;
    }
  }
  return value;
}

YamlValue parse_with(const std::string& text, const Locate& locate) {
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(text);
    if (documents.size() > 1) throw ConfigError(locate(documents[1].Mark()) + ": a second YAML document begins here");
    if (documents.empty()) return {};
    return convert(documents.front(), locate, 0);
  } catch (const YAML::Exception& e) {
    throw ConfigError(fmt::format("{}: not YAML: {}", locate(e.mark), e.msg));
  }
}

/// A step of an override's path: a key and perhaps an index, "obstacles[2]".
struct Step {
  std::string key;
  std::optional<std::size_t> index;
};

std::optional<Step> parse_step(std::string_view text) {
  Step step;
  const std::size_t bracket = text.find('[');
  step.key = std::string(text.substr(0, bracket));
  if (step.key.empty()) return std::nullopt;
  if (bracket == std::string_view::npos) return step;
  std::size_t index = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data() + bracket + 1, end, index);
  if (error != std::errc{} || rest + 1 != end || *rest != ']') return std::nullopt;
  step.index = index;
  return step;
}

std::vector<Step> parse_path(std::string_view path, const std::string& where) {
  std::vector<Step> steps;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    const auto step = parse_step(path.substr(begin, end - begin));
    if (!step) throw ConfigError(fmt::format("{}: \"{}\" is not a path such as uav.limits.v_max", where, path));
    steps.push_back(*step);
    begin = end + 1;
  }
  return steps;
}

/// The value that a step leads to, made (empty) if it is missing.
YamlValue& descend(YamlValue& parent, const Step& step, const std::string& where) {
  if (parent.kind == YamlValue::Kind::Null) parent.kind = YamlValue::Kind::Mapping;
  if (parent.kind != YamlValue::Kind::Mapping) {
    throw ConfigError(fmt::format("{}: {} cannot be set: above it stands {}", where, step.key, parent.describe()));
  }
  YamlValue* child = parent.find(step.key);
  if (child == nullptr) {
    parent.entries.emplace_back(step.key, YamlValue{});
    child = &parent.entries.back().second;
    child->where = where;
  }
  if (!step.index) return *child;
  if (*step.index >= child->items.size()) {
    throw ConfigError(
        fmt::format("{}: {}[{}]: the list has {} entries", where, step.key, *step.index, child->items.size()));
  }
  return child->items[*step.index];
}

}  // namespace

const YamlValue* YamlValue::find(std::string_view key) const {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const auto& entry) { return entry.first == key; });
  return found == entries.end() ? nullptr : &found->second;
}

YamlValue* YamlValue::find(std::string_view key) { return const_cast<YamlValue*>(std::as_const(*this).find(key)); }

std::string YamlValue::describe() const {
  switch (kind) {
    case Kind::Null: return "nothing";
    case Kind::Scalar: return quoted ? fmt::format("\"{}\"", scalar) : scalar;
    case Kind::Sequence: return fmt::format("a list of {}", items.size());
    case Kind::Mapping: return "a mapping";
  }
  return "nothing";
}

YamlValue parse_yaml(const std::string& text, const std::string& name) {
  YamlValue document =
      parse_with(text, [&](const YAML::Mark& mark) { return fmt::format("{}:{}", name, mark.line + 1); });
  if (document.kind == YamlValue::Kind::Null) document.kind = YamlValue::Kind::Mapping;
  if (document.kind != YamlValue::Kind::Mapping) {
    throw ConfigError(fmt::format("{}: {} where keys are expected", document.where, document.describe()));
  }
  document.where = name;
  return document;
}

void apply_override(YamlValue& document, const std::string& override_text) {
  const std::string where = "--set " + override_text;
  const std::size_t equals = override_text.find('=');
  if (equals == std::string::npos) throw ConfigError(where + ": is not key.path=value");
  const std::vector<Step> steps = parse_path(std::string_view(override_text).substr(0, equals), where);
  YamlValue* target = &document;
  for (const Step& step : steps) target = &descend(*target, step, where);
  *target = parse_with(override_text.substr(equals + 1), [&](const YAML::Mark&) { return where; });
  target->where = where;
}

std::string yaml_text(std::string_view text) {
  static constexpr std::string_view kWords[] = {"true", "false", "null", "yes", "no", "on", "off", "inf", "nan"};
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto safe = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '/' || c == '.';
  };
  const bool plain = !text.empty() && std::isalpha(static_cast<unsigned char>(text.front())) != 0 &&
                     std::all_of(text.begin(), text.end(), safe) &&
                     std::find(std::begin(kWords), std::end(kWords), lower) == std::end(kWords);
  if (plain) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      quoted += fmt::format("\\x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

std::string yaml_number(double value) {
  if (std::isinf(value)) return value > 0.0 ? ".inf" : "-.inf";
  return fmt::format("{}", value);
}

}  // namespace tern
