#include "ros_messages/type_hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <vector>

namespace tern::ros {
namespace {

using Form = FieldDescription::Form;

/// The numbers of FieldType.msg in type_description_interfaces. An array has 48, a sequence 144 more.
int type_id(const FieldDescription& field) {
  static const std::map<std::string, int, std::less<>> kIds = {
      {"int8", 2},   {"uint8", 3},    {"int16", 4},    {"uint16", 5}, {"int32", 6}, {"uint32", 7}, {"int64", 8},
      {"uint64", 9}, {"float32", 10}, {"float64", 11}, {"char", 13},  {"bool", 15}, {"byte", 16},  {"string", 17}};
  constexpr int kNested = 1, kArray = 48, kSequence = 144;
  const auto found = kIds.find(field.type);
  const int id = found == kIds.end() ? kNested : found->second;
  return id + (field.form == Form::Array ? kArray : field.form == Form::Sequence ? kSequence : 0);
}

std::string json_of(const TypeDescription& type) {
  std::string fields;
  for (const FieldDescription& field : type.fields) {
    const bool nested = field.type.find('/') != std::string::npos;
    fields += fmt::format(
        R"({}{{"name": "{}", "type": {{"type_id": {}, "capacity": {}, "string_capacity": 0, "nested_type_name": "{}"}}}})",
        fields.empty() ? "" : ", ", field.name, type_id(field), field.size, nested ? field.type : "");
  }
  return fmt::format(R"({{"type_name": "{}", "fields": [{}]}})", type.name, fields);
}

}  // namespace

std::string hashed_description(const RosType& type) {
  std::vector<TypeDescription> others(type.types.begin() + 1, type.types.end());
  std::sort(others.begin(), others.end(),
            [](const TypeDescription& a, const TypeDescription& b) { return a.name < b.name; });
  std::string list;
  for (const TypeDescription& other : others) list += (list.empty() ? "" : ", ") + json_of(other);
  return fmt::format(R"({{"type_description": {}, "referenced_type_descriptions": [{}]}})", json_of(type.types.front()),
                     list);
}

}  // namespace tern::ros
