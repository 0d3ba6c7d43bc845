#include "campaign/scenario_schema.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "campaign/flight_inputs.h"
#include "runtime/config.h"

namespace tern {
namespace {

using Json = nlohmann::ordered_json;

/// Together these settings make every key known that depends on another.
constexpr const char* kExamples[] = {
    "timeout_s: 60\n"
    "world: {obstacles: [{centre: [5, 0, 1]}], recorded: [{file: a.txt, columns: 6, z_column: 4}], origin: "
    "{latitude: 0, longitude: 0}, fences: [{corners: [[0, 0], [1, 0], [0, 1]], floor: 0, ceiling: 1}]}\n"
    "uav: {body: {radius: 0.1}, flight_box: {min: [-9, -9, 0], max: [99, 9, 9]}}\n"
    "semantics: {regions: [{name: a, class: texture, box: {min: [0, 0, 0], max: [1, 1, 1]}}]}\n"
    "simulator: {sensor: {mode: noisy}, sensors: [{type: camera}], vehicle: quadrotor, estimation: vio, "
    "vio: {tags: [{position: [1, 0, 1]}], dark: [{from_s: 1}]}}\n"
    "mapper: {extents: {min: [0, 0, 0], max: [1, 1, 1]}, sources: [{file: town.las}]}\n",
    "world: {obstacles: [{motion: trefoil, centre: [5, 0, 1]}], origin: {latitude: 0, longitude: 0}, fences: "
    "[{coordinates: [[0, 0], [1, 0], [0, 1]]}]}\n"
    "simulator: {sensors: [{type: lidar}]}\n"
    "uav: {body: {half_extents: [0.1, 0.1, 0.1]}, dynamics: {thrust_min: 2, thrust_max: 39, tilt_max: 70, "
    "body_rate_max: 900}}\n"
    "semantics: {regions: [{name: a, class: texture, ball: {centre: [0, 0, 0], radius: 1}}]}\n",
    "world: {obstacles: [{motion: wave, centre: [5, 0, 1], amplitude: [0, 1, 0]}], fences: [{circle: {centre: [0, "
    "0], radius: 1}}]}\n"
    "uav: {body: {vertices: [[0, 0, 0]]}}\n"
    "semantics: {regions: [{name: a, class: texture, prism: {corners: [[0, 0], [1, 0], [0, 1]], z_min: 0, z_max: "
    "1}}]}\n",
    "world: {obstacles: [{motion: linear, centre: [5, 0, 1], velocity: [0, 1, 0]}], recorded: [{file: a.txt, columns: "
    "6, z_column: 4, copies: 2, within: {min: [0, 0, 0], max: [9, 9, 9]}}]}\n"
    "uav: {routes: [{from: [0, 0, 1], to: [9, 0, 1]}]}\n",
    "world: {obstacles: [{motion: waypoints, points: [[0, 5, 0, 1]]}], origin: {latitude: 0, longitude: 0}, fences: "
    "[{circle: {latitude: 0, longitude: 0, radius: 1}}]}\n"
    "simulator: {sensors: [{type: near}]}\n",
    "world: {fences: [{file: site.plan, floor: 0, ceiling: 9}]}\n"};

/// Tables whose keys the user names: every value is like the table's default values.
constexpr std::string_view kOpenTables[] = {"semantics.classes", "semantics.lambdas", "mapper.classes",
                                            "simulator.vio.landmarks.regions", "planner.semantics.landmarks.regions"};

/// Returns "[0, 10]" or "(0, 10]"; infinite ends are open.
void add_range(Json& schema, std::string_view range) {
  const auto number = [](std::string_view text) -> Json {
    double x = 0.0;
    while (text.starts_with(' ')) text.remove_prefix(1);
    const auto read = std::from_chars(text.data(), text.data() + text.size(), x);
    return read.ec == std::errc{} && std::isfinite(x) ? Json(x) : Json();
  };
  const std::size_t comma = range.find(','), end = range.find_first_of("])");
  const Json low = number(range.substr(1, comma - 1)), high = number(range.substr(comma + 1, end - comma - 1));
  if (!low.is_null()) schema[range.front() == '(' ? "exclusiveMinimum" : "minimum"] = low;
  if (!high.is_null()) schema["maximum"] = high;
}

Json schema_of(const Knob& knob) {
  Json schema = Json::object();
  const bool numeric = knob.range.starts_with('[') || knob.range.starts_with('(');
  if (numeric) {
    Json number{{"type", Json::array({"number", "string"})}};  // a string: inf
    add_range(number, knob.range);
    schema = number;
    if (knob.range.ends_with(" each")) {
      schema = {{"anyOf", {{{"type", "array"}, {"items", number}}, number}}};  // one number may stand for three
    }
  } else if (!knob.range.empty()) {
    std::istringstream words(knob.range);
    for (std::string word; std::getline(words >> std::ws, word, ',');) schema["enum"].push_back(word);
  } else if (knob.fallback == "true" || knob.fallback == "false") {
    schema["type"] = "boolean";
  } else if (!knob.fallback.empty()) {
    schema["type"] = Json::array({"string", "number", "boolean"});  // plain text may look like a number
  } else {
    schema["type"] = Json::array({"array", "number"});
  }
  if (!knob.meaning.empty()) schema["description"] = knob.meaning;
  if (!knob.fallback.empty() && knob.fallback != "required") {
    const Json value = Json::parse(knob.fallback, nullptr, false);
    schema["default"] = value.is_discarded() ? Json(knob.fallback) : value;
  }
  return schema;
}

Json closed_object() {
  return {{"type", Json::array({"object", "null"})}, {"properties", Json::object()}, {"additionalProperties", false}};
}

bool is_open(std::string_view path) {
  return std::find(std::begin(kOpenTables), std::end(kOpenTables), path) != std::end(kOpenTables);
}

/// Inserts a key at its path: "world.obstacles[].centre".
void insert(Json& root, const Knob& knob) {
  Json* at = &root;
  std::string path;
  std::istringstream parts(knob.path);
  std::string part;
  std::getline(parts, part, '.');
  for (std::string next; std::getline(parts, next, '.'); part = next) {
    const bool is_list = part.ends_with("[]");
    if (is_list) part.resize(part.size() - 2);
    path += (path.empty() ? "" : ".") + part;
    Json& child = (*at)["properties"][part];
    if (child.is_null()) {
      child = is_list ? Json{{"type", Json::array({"array", "null"})}, {"items", closed_object()}} : closed_object();
    }
    at = is_list ? &child["items"] : &child;
    if (is_open(path)) {
      (*at)["additionalProperties"] = schema_of({"", "", knob.range, knob.meaning});
      return;
    }
  }
  Json& slot = (*at)["properties"][part];
  const Json schema = schema_of(knob);
  if (slot.is_null() || (slot != schema && knob.range.ends_with(" each"))) slot = schema;
}

}  // namespace

std::string scenario_schema() {
  Json root{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "A scenario of Tern"}};
  root.update(closed_object());
  for (const char* example : kExamples) {
    ConfigDocument document = ConfigDocument::parse(example, "example");
    read_every_section(document);
    for (const Knob& knob : document.knobs()) insert(root, knob);
  }
  Json lambda{{"type", "number"}, {"minimum", 0}};
  root["properties"]["semantics"]["properties"]["lambdas"] = {{"type", Json::array({"object", "null"})},
                                                              {"description", "λ of single classes"},
                                                              {"additionalProperties", lambda}};
  return root.dump(2) + "\n";
}

}  // namespace tern
