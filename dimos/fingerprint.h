// The fingerprint of a message type, as LCM's generator computes it from a definition. Every message begins with it.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "ros_messages/cdr.h"
#include "ros_messages/types.h"

namespace tern::dimos {

/// Whether DimOS's types, which are ROS 1's, have this field as well. The others are Marker's, added by ROS 2.
inline bool is_field_of_dimos(std::string_view name) {
  return name != "texture_resource" && name != "texture" && name != "uv_coordinates" && name != "mesh_file";
}

/// Collects the fields of a type, in the order of the bytes. Of a field that is a message, LCM hashes the name and adds
/// the fingerprint; of another one it hashes name and type.
class Fingerprinter {
 public:
  template <ros::Message T>
  static std::uint64_t fingerprint() {
    Fingerprinter out;
    const T message{};
    Lengths lengths{out};
    T::fields(message, lengths);
    if constexpr (std::same_as<T, ros::Head>) out.add("seq", "int32_t");
    T::fields(message, out);
    const std::uint64_t sum = out.hash_ + out.inner_;
    return sum << 1U | sum >> 63U;
  }
  template <class T>
  void operator()(std::string_view name, const T& x) {
    if (is_field_of_dimos(name)) add_field(name == "nanosec" ? "nsec" : name, x, {});
  }

 private:
  enum class Size : std::uint8_t { Constant = 0, Variable = 1 };
  struct Dimension {
    Size size;
    std::string text;  ///< "36", or the field with the length
  };
  struct Lengths {
    Fingerprinter& out;
    template <class T>
    void operator()(std::string_view, const T&) {}
    template <class T>
    void operator()(std::string_view name, const std::vector<T>&) {
      if (is_field_of_dimos(name)) out.add(std::string(name) + "_length", "int32_t");
    }
  };

  template <class T>
  void add_field(std::string_view name, const std::vector<T>&, const std::vector<Dimension>&) {
    add_field(name, T{}, {{Size::Variable, std::string(name) + "_length"}});
  }
  template <class T, std::size_t N>
  void add_field(std::string_view name, const std::array<T, N>&, const std::vector<Dimension>&) {
    add_field(name, T{}, {{Size::Constant, std::to_string(N)}});
  }
  template <class T>
  void add_field(std::string_view name, const T&, const std::vector<Dimension>& dimensions) {
    if constexpr (ros::Message<T>) {
      add(name, "", dimensions);
      inner_ += fingerprint<T>();
    } else {
      add(name, type_name<T>(), dimensions);
    }
  }
  template <class T>
  static std::string_view type_name() {
    if constexpr (std::same_as<T, bool>) return "boolean";
    if constexpr (std::same_as<T, std::string>) return "string";
    if constexpr (std::same_as<T, float>) return "float";
    if constexpr (std::same_as<T, double>) return "double";
    if constexpr (std::same_as<T, std::uint8_t>) return "byte";
    static_assert(!std::is_integral_v<T> || sizeof(T) == 1 || sizeof(T) == 4);
    return "int32_t";
  }
  /// @param type  empty for a message
  void add(std::string_view name, std::string_view type, const std::vector<Dimension>& dimensions = {}) {
    mix(name);
    if (!type.empty()) mix(type);
    mix(static_cast<std::uint8_t>(dimensions.size()));
    for (const Dimension& dimension : dimensions) {
      mix(static_cast<std::uint8_t>(dimension.size));
      mix(dimension.text);
    }
  }
  void mix(std::string_view text) {
    mix(static_cast<std::uint8_t>(text.size()));
    for (const char c : text) mix(static_cast<std::uint8_t>(c));
  }
  /// (h·2⁸ ⊕ h/2⁵⁵) + byte, where h is a signed number. Bytes are below 128: names are ASCII.
  void mix(std::uint8_t byte) {
    const auto high = static_cast<std::uint64_t>(static_cast<std::int64_t>(hash_) >> 55);
    hash_ = (hash_ << 8U ^ high) + byte;
  }

  std::uint64_t hash_ = 0x12345678;  ///< LCM's initial value
  std::uint64_t inner_ = 0;          ///< fingerprints of the messages in it
};

/// Returns the fingerprint of a type of DimOS; it is computed once.
template <ros::Message T>
std::uint64_t fingerprint_of() {
  static const std::uint64_t kFingerprint = Fingerprinter::fingerprint<T>();
  return kFingerprint;
}

}  // namespace tern::dimos
