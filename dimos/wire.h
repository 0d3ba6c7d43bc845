// The bytes of DimOS's messages: LCM's encoding of types that have the names and fields of ROS 1.
//
//     fingerprint of the type, i64 | the message
//     message: lengths of its lists, i32 each | its fields, in order
//
// Numbers are big-endian. A text is its length with the final zero (i32), then the bytes. A list or array is its
// elements. The types are those of ros_messages/, with these differences:
//
// | type of ros_messages | of DimOS |
// |---|---|
// | Head | begins with `seq`, i32; 0 is written |
// | Time, Span | `nanosec` is called `nsec` |
// | Marker | lacks texture and mesh file |
// | unsigned numbers | i32 or byte |
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "dimos/fingerprint.h"
#include "ros_messages/cdr.h"
#include "ros_messages/types.h"

namespace tern::dimos {

/// Writes a message without its fingerprint.
class WireWriter {
 public:
  template <class T>
  void operator()(std::string_view name, const T& x) {
    if (is_field_of_dimos(name)) write(x);
  }
  template <ros::Message T>
  void write(const T& message) {
    Lengths lengths{*this};
    T::fields(message, lengths);
    if constexpr (std::same_as<T, ros::Head>) write(std::int32_t{0});  // seq
    T::fields(message, *this);
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void write(T x) {
    auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(x);
    static_assert(std::endian::native == std::endian::little);
    bytes_.append(bytes.rbegin(), bytes.rend());
  }
  void write(const std::string& text) {
    write(static_cast<std::int32_t>(text.size() + 1));
    bytes_.append(text.c_str(), text.size() + 1);
  }
  template <class T, std::size_t N>
  void write(const std::array<T, N>& list) {
    for (const T& x : list) write(x);
  }
  template <class T>
  void write(const std::vector<T>& list) {
    for (const T& x : list) write(x);
  }
  std::string take() { return std::move(bytes_); }

 private:
  struct Lengths {
    WireWriter& writer;
    template <class T>
    void operator()(std::string_view, const T&) {}
    template <class T>
    void operator()(std::string_view name, const std::vector<T>& list) {
      if (is_field_of_dimos(name)) writer.write(static_cast<std::int32_t>(list.size()));
    }
  };

  std::string bytes_;
};

/// Reads a message without its fingerprint. The first field that the bytes cannot hold ends the reading. The size of
/// the bytes bounds memory and time, whatever the lengths claim.
class WireReader {
 public:
  explicit WireReader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  template <class T>
  void operator()(std::string_view name, T& x) {
    if (is_field_of_dimos(name)) read(x);
  }
  template <ros::Message T>
  void read(T& message) {
    const auto outer = std::exchange(lengths_, {});
    Lengths lengths{*this};
    T::fields(message, lengths);
    if constexpr (std::same_as<T, ros::Head>) take(sizeof(std::int32_t));  // seq
    T::fields(message, *this);
    lengths_ = outer;
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void read(T& x) {
    const auto source = take(sizeof(T));
    if (!ok_) return;
    std::array<std::uint8_t, sizeof(T)> bytes{};
    for (std::size_t k = 0; k < sizeof(T); ++k) bytes[k] = source[sizeof(T) - 1 - k];
    if constexpr (std::same_as<T, bool>) {
      ok_ = bytes[0] <= 1;
      x = bytes[0] == 1;
    } else {
      x = std::bit_cast<T>(bytes);
    }
  }
  void read(std::string& text) {
    std::int32_t size = 0;
    read(size);
    ok_ = ok_ && size >= 1;
    const auto bytes = take(static_cast<std::size_t>(size));
    if (!ok_) return;
    ok_ = bytes.back() == 0;
    text.assign(bytes.begin(), bytes.end() - 1);
  }
  template <class T, std::size_t N>
  void read(std::array<T, N>& list) {
    for (T& x : list) read(x);
  }
  template <class T>
  void read(std::vector<T>& list) {
    const std::int32_t size = lengths_.of[lengths_.used++];
    if constexpr (sizeof(T) == 1) {
      const auto bytes = take(static_cast<std::size_t>(size));
      list.assign(bytes.begin(), bytes.end());
    } else {
      for (std::int32_t k = 0; k < size && ok_; ++k) read(list.emplace_back());
    }
  }
  /// Returns true if every field was read and no byte is left.
  [[nodiscard]] bool is_complete() const { return ok_ && rest_.empty(); }

 private:
  static constexpr std::size_t kMostLists = 4;  ///< in a message type, without those in its fields

  struct Lengths {
    WireReader& reader;
    template <class T>
    void operator()(std::string_view, const T&) {}
    template <class T>
    void operator()(std::string_view name, const std::vector<T>&) {
      if (!is_field_of_dimos(name)) return;
      std::int32_t& length = reader.lengths_.of[reader.lengths_.known++];
      reader.read(length);
      reader.ok_ = reader.ok_ && length >= 0;
      if (!reader.ok_) length = 0;
    }
  };
  struct ListLengths {
    std::array<std::int32_t, kMostLists> of{};
    std::size_t known = 0, used = 0;
  };

  std::span<const std::uint8_t> take(std::size_t n) {
    ok_ = ok_ && n <= rest_.size();
    if (!ok_) return {};
    const auto taken = rest_.first(n);
    rest_ = rest_.subspan(n);
    return taken;
  }

  std::span<const std::uint8_t> rest_;
  ListLengths lengths_;  ///< of the message that is being read
  bool ok_ = true;
};

template <ros::Message T>
std::string encode(const T& message) {
  WireWriter writer;
  writer.write(fingerprint_of<T>());
  writer.write(message);
  return writer.take();
}

/// @return nullopt unless the bytes are exactly one message of this type
template <ros::Message T>
std::optional<T> decode(std::span<const std::uint8_t> bytes) {
  std::optional<T> message(std::in_place);
  WireReader reader(bytes);
  std::uint64_t fingerprint = 0;
  reader.read(fingerprint);
  if (fingerprint != fingerprint_of<T>()) return std::nullopt;
  reader.read(*message);
  if (!reader.is_complete()) message.reset();
  return message;
}

}  // namespace tern::dimos
