// Describes message types for readers that do not know them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ros_messages/cdr.h"

namespace tern::ros {

/// A field of a type.
struct FieldDescription {
  enum class Form : std::uint8_t { Value, Array, Sequence };

  std::string name;
  std::string type;     ///< "float64", "string" …, or the name of another type: "geometry_msgs/msg/Point"
  std::string comment;  ///< may be empty
  Form form = Form::Value;
  std::size_t size = 0;  ///< of an Array
};

/// A type, its fields in the order of the bytes.
struct TypeDescription {
  std::string name;  ///< "nav_msgs/msg/Odometry"
  std::vector<FieldDescription> fields;
};

/// A type, followed by all types in it, each once.
struct RosType {
  std::vector<TypeDescription> types;

  [[nodiscard]] const std::string& name() const { return types.front().name; }
  /// Returns the definition as files and servers carry it ("ros2msg"): the lines of the .msg file, then those of each
  /// type in it below a line of 80 '=' and "MSG: package/Name".
  [[nodiscard]] std::string definition() const;
};

/// Collects the fields of a message type.
class Describer {
 public:
  template <Message T>
  static RosType describe() {
    Describer describer;
    describer.add<T>();
    return {std::move(describer.types_)};
  }
  template <class T>
  void operator()(const char* name, const T& x) {
    field_ = {name, "", "", FieldDescription::Form::Value, 0};
    name_type(x);
    fields_.push_back(field_);
  }

 private:
  template <Message T>
  void add() {
    if (!known_.insert(T::kName).second) return;
    const std::size_t place = types_.size();
    types_.push_back({T::kName, {}});
    const auto outer = std::exchange(fields_, {});
    const T message{};
    T::fields(message, *this);
    types_[place].fields = std::exchange(fields_, outer);
  }
  template <class T>
  void name_type(const std::vector<T>&) {
    field_.form = FieldDescription::Form::Sequence;
    name_type(T{});
  }
  template <class T, std::size_t N>
  void name_type(const std::array<T, N>&) {
    field_.form = FieldDescription::Form::Array;
    field_.size = N;
    name_type(T{});
  }
  template <Message T>
  void name_type(const T&) {
    const FieldDescription own = field_;
    add<T>();
    field_ = own;
    field_.type = T::kName;
  }
  void name_type(const std::string&) { field_.type = "string"; }
  template <class T>
  requires std::is_arithmetic_v<T>
  void name_type(T) {
    if constexpr (std::same_as<T, bool>) {
      field_.type = "bool";
    } else {
      field_.type = (std::is_floating_point_v<T> ? "float"
                     : std::is_unsigned_v<T>     ? "uint"
                                                 : "int") +
                    std::to_string(8 * sizeof(T));
    }
  }

  std::vector<TypeDescription> types_;
  std::set<std::string, std::less<>> known_;
  std::vector<FieldDescription> fields_;
  FieldDescription field_;
};

/// Returns the description of a message type; it is made once.
template <Message T>
const RosType& ros_type() {
  static const RosType kType = Describer::describe<T>();
  return kType;
}

}  // namespace tern::ros
