#include "runtime/yaml_tree.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <sstream>
#include <unordered_map>
#include <utility>

#include "runtime/config.h"

namespace tern {
namespace {

/// Names the place of a YAML mark (which counts from 0).
using Locate = std::function<std::string(const YAML::Mark&)>;

/// Most open brackets. Texts in a file may hold unclosed ones, but never this many.
constexpr std::size_t kMaxOpenBrackets = 1'000;

struct Extent {
  std::size_t values = 1;  ///< number of values, itself included
  std::size_t levels = 0;  ///< depth of nesting within it
};

Extent extent_of(const YamlValue& value) {
  Extent extent;
  const auto add = [&](const YamlValue& inner) {
    const Extent part = extent_of(inner);
    extent.values += part.values;
    extent.levels = std::max(extent.levels, part.levels + 1);
  };
  for (const YamlValue& item : value.items) add(item);
  for (const auto& entry : value.entries) add(entry.value);
  return extent;
}

/// A value with an anchor, for its aliases.
struct Anchored {
  YamlValue value;
  Extent extent;
};

/// Builds the value while the parser reads, so a document that breaks a limit is refused before more of it is stored.
class TreeBuilder final : public YAML::EventHandler {
 public:
  explicit TreeBuilder(const Locate& locate) : locate_(locate) {}

  /// @pre a document was read whole
  YamlValue take() { return std::move(document_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override { anchored_.clear(); }
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    add(begin(mark, YamlValue::Kind::Null), anchor);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override {
    YamlValue value = begin(mark, YamlValue::Kind::Scalar);
    value.scalar = text;
    value.quoted = tag == "!";
    add(std::move(value), anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchored_.find(anchor);
    const std::string where = locate_(mark);
    if (found == anchored_.end()) throw ConfigError(where + ": an alias inside the value that it repeats");
    charge(found->second.extent, where);
    add(found->second.value, YAML::NullAnchor);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open_.push_back({begin(mark, YamlValue::Kind::Sequence), anchor, {}, {}, {}});
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open_.push_back({begin(mark, YamlValue::Kind::Mapping), anchor, {}, {}, {}});
  }
  void OnMapEnd() override { close(); }

 private:
  /// A list or mapping that is still being read.
  struct Open {
    YamlValue value;
    YAML::anchor_t anchor;
    std::unordered_map<std::string, std::string> keys;  ///< of a mapping: the place of each key
    std::optional<std::string> key;                     ///< key of the next value
    std::string key_where;
  };

  /// Checks the limits before a value is stored.
  void charge(const Extent& extent, const std::string& where) {
    if (open_.size() + extent.levels > kMaxYamlDepth) {
      throw ConfigError(fmt::format("{}: nested deeper than {} levels", where, kMaxYamlDepth));
    }
    values_ += extent.values;
    if (values_ > kMaxYamlValues) {
      throw ConfigError(fmt::format("{}: more than {} values, repetitions by aliases included", where, kMaxYamlValues));
    }
  }

  YamlValue begin(const YAML::Mark& mark, YamlValue::Kind kind) {
    YamlValue value;
    value.kind = kind;
    value.where = locate_(mark);
    charge({}, value.where);
    return value;
  }

  void close() {
    Open closed = std::move(open_.back());
    open_.pop_back();
    add(std::move(closed.value), closed.anchor);
  }

  void add(YamlValue value, YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor) {
      const Extent extent = extent_of(value);
      charge(extent, value.where);
      anchored_.insert_or_assign(anchor, Anchored{value, extent});
    }
    if (open_.empty()) return add_document(std::move(value));
    Open& parent = open_.back();
    if (parent.value.kind == YamlValue::Kind::Sequence) {
      parent.value.items.push_back(std::move(value));
    } else if (!parent.key) {
      add_key(parent, value);
    } else {
      // Messages name the key's line: a mapping begins a line after its key, and an omitted value has no line.
      value.where = std::move(parent.key_where);
      parent.value.entries.push_back({std::move(*parent.key), std::move(value)});
      parent.key.reset();
    }
  }

  void add_document(YamlValue value) {
    if (value.kind == YamlValue::Kind::Null) return;
    if (document_.kind != YamlValue::Kind::Null)
      throw ConfigError(value.where + ": a second YAML document begins here");
    document_ = std::move(value);
  }

  static void add_key(Open& mapping, const YamlValue& key) {
    if (key.kind != YamlValue::Kind::Scalar) throw ConfigError(key.where + ": a key must be a word");
    const auto [first, is_new] = mapping.keys.emplace(key.scalar, key.where);
    if (!is_new) {
      throw ConfigError(fmt::format("{}: key {} is given twice (first at {})", key.where, key.scalar, first->second));
    }
    mapping.key = key.scalar;
    mapping.key_where = key.where;
  }

  const Locate& locate_;
  YamlValue document_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, Anchored> anchored_;
  std::size_t values_ = 0;
};

/// Counts open brackets before parsing, because the parser stores all of them before it reports the first. Brackets in
/// texts and comments count as well, so more may be open than levels are allowed.
void check_brackets(const std::string& text, const Locate& locate) {
  std::size_t open = 0;
  YAML::Mark mark;
  for (const char c : text) {
    if (c == '\n') ++mark.line;
    if (c == '[' || c == '{') ++open;
    if ((c == ']' || c == '}') && open > 0) --open;
    if (open > kMaxOpenBrackets) {
      throw ConfigError(fmt::format("{}: more than {} open brackets", locate(mark), kMaxOpenBrackets));
    }
  }
}

YamlValue parse_with(const std::string& text, const Locate& locate) {
  if (text.size() > kMaxYamlBytes) {
    throw ConfigError(fmt::format("{}: has more than {} bytes", locate(YAML::Mark()), kMaxYamlBytes));
  }
  check_brackets(text, locate);
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    TreeBuilder builder(locate);
    while (parser.HandleNextDocument(builder)) {
    }
    return builder.take();
  } catch (const YAML::Exception& e) {
    throw ConfigError(fmt::format("{}: not YAML: {}", locate(e.mark), e.msg));
  }
}

/// A step of an override's path: a key, and an index if there is one: "obstacles[2]".
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
    if (steps.size() > kMaxYamlDepth)
      throw ConfigError(fmt::format("{}: more than {} keys deep", where, kMaxYamlDepth));
    begin = end + 1;
  }
  return steps;
}

/// Returns the value to which a step leads; a missing one is created empty.
YamlValue& descend(YamlValue& parent, const Step& step, const std::string& where) {
  if (parent.kind == YamlValue::Kind::Null) parent.kind = YamlValue::Kind::Mapping;
  if (parent.kind != YamlValue::Kind::Mapping) {
    throw ConfigError(fmt::format("{}: {} cannot be set: its parent is {}", where, step.key, parent.describe()));
  }
  YamlValue* child = parent.find(step.key);
  if (child == nullptr) {
    parent.entries.push_back({step.key, YamlValue{}});
    child = &parent.entries.back().value;
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
  const auto found = std::ranges::find_if(entries, [&](const auto& entry) { return entry.key == key; });
  return found == entries.end() ? nullptr : &found->value;
}

YamlValue* YamlValue::find(std::string_view key) { return const_cast<YamlValue*>(std::as_const(*this).find(key)); }

std::string YamlValue::describe() const {
  switch (kind) {
    case Kind::Null: return "an empty value";
    case Kind::Scalar: return quoted ? fmt::format("\"{}\"", scalar) : scalar;
    case Kind::Sequence: return fmt::format("a list of {}", items.size());
    case Kind::Mapping: return "a mapping";
  }
  return "an empty value";
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
  if (equals == std::string::npos) throw ConfigError(where + ": must be KEY=VALUE, as in uav.limits.v_max=3");
  const std::vector<Step> steps = parse_path(std::string_view(override_text).substr(0, equals), where);
  YamlValue* target = &document;
  for (const Step& step : steps) target = &descend(*target, step, where);
  *target = parse_with(override_text.substr(equals + 1), [&](const YAML::Mark&) { return std::string(where); });
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
                     std::ranges::all_of(text, safe) &&
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
