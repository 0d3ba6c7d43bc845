// The bytes of a ROS 2 message: CDR, as OMG DDSI-RTPS 2.5 §10.2 and XTypes 1.3 §7.4 (XCDR version 1) define it.
//
//     u8 0 | u8 1: little-endian, 0: big-endian | u16 options | fields
//
// A number is aligned to its size, counted from the first byte of the fields. A text is its length in bytes with the
// final zero (u32), then the bytes. A sequence is its length (u32), then its elements. An array has its elements alone.
//
// A message type lists its fields once; writer, reader, definition and hash are made from that list:
//
//     struct Time {
//       static constexpr const char* kName = "builtin_interfaces/msg/Time";
//       std::int32_t sec = 0;
//       std::uint32_t nanosec = 0;
//       static void fields(auto& m, auto& visit) { visit("sec", m.sec), visit("nanosec", m.nanosec); }
//     };
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace tern::ros {

/// A message type: it has a name and a list of fields.
template <class T>
concept Message = requires {
  T::kName;
};

inline constexpr std::size_t kCdrHeadBytes = 4;

/// Writes fields, little-endian.
class CdrWriter {
 public:
  template <class T>
  void operator()(const char*, const T& x) {
    write(x);
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void write(T x) {
    static_assert(std::endian::native == std::endian::little);
    align(sizeof x);
    append(&x, sizeof x);
  }
  void write(const std::string& text) {
    write(static_cast<std::uint32_t>(text.size() + 1));
    append(text.c_str(), text.size() + 1);
  }
  template <class T, std::size_t N>
  void write(const std::array<T, N>& list) {
    for (const T& x : list) write(x);
  }
  template <class T>
  void write(const std::vector<T>& list) {
    write(static_cast<std::uint32_t>(list.size()));
    if constexpr (sizeof(T) == 1) {
      append(list.data(), list.size());
    } else {
      for (const T& x : list) write(x);
    }
  }
  template <Message T>
  void write(const T& message) {
    T::fields(message, *this);
  }
  std::string take() { return std::move(bytes_); }

 private:
  void align(std::size_t size) {
    const std::size_t past = (bytes_.size() - kCdrHeadBytes) % size;
    if (past != 0) bytes_.append(size - past, '\0');
  }
  void append(const void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }

  std::string bytes_{'\0', '\1', '\0', '\0'};
};

/// Reads fields of either byte order. The first field that the bytes cannot hold ends the reading: ok() is false, and
/// later fields keep their values. The size of the bytes bounds memory and time.
class CdrReader {
 public:
  explicit CdrReader(std::span<const std::uint8_t> bytes) {
    ok_ = bytes.size() >= kCdrHeadBytes && bytes[0] == 0 && bytes[1] <= 1;
    if (!ok_) return;
    swapped_ = bytes[1] == 0;
    fields_ = bytes.subspan(kCdrHeadBytes);
  }

  template <class T>
  void operator()(const char*, T& x) {
    read(x);
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void read(T& x) {
    std::array<std::uint8_t, sizeof(T)> bytes{};
    const std::size_t past = at_ % sizeof(T);
    if (past != 0) take(sizeof(T) - past);
    const auto source = take(sizeof(T));
    if (!ok_) return;
    for (std::size_t k = 0; k < sizeof(T); ++k) bytes[k] = source[swapped_ ? sizeof(T) - 1 - k : k];
    if constexpr (std::same_as<T, bool>) {
      ok_ = bytes[0] <= 1;
      x = bytes[0] == 1;
    } else {
      x = std::bit_cast<T>(bytes);
    }
  }
  void read(std::string& text) {
    std::uint32_t size = 0;
    read(size);
    const auto bytes = take(size);
    if (size == 0 || !ok_) return;  // some writers send an empty text without its zero
    ok_ = bytes.back() == 0;
    text.assign(bytes.begin(), bytes.end() - 1);
  }
  template <class T, std::size_t N>
  void read(std::array<T, N>& list) {
    for (T& x : list) read(x);
  }
  template <class T>
  void read(std::vector<T>& list) {
    std::uint32_t size = 0;
    read(size);
    if constexpr (sizeof(T) == 1) {
      const auto bytes = take(size);
      list.assign(bytes.begin(), bytes.end());
    } else {
      for (std::uint32_t k = 0; k < size && ok_; ++k) read(list.emplace_back());
    }
  }
  template <Message T>
  void read(T& message) {
    T::fields(message, *this);
  }

  /// Returns true if every field was read, and at most the three bytes are left by which a sender fills up a word.
  [[nodiscard]] bool is_complete() const { return ok_ && fields_.size() - at_ < 4; }

 private:
  std::span<const std::uint8_t> take(std::size_t n) {
    ok_ = ok_ && n <= fields_.size() - at_;
    if (!ok_) return {};
    at_ += n;
    return fields_.subspan(at_ - n, n);
  }

  std::span<const std::uint8_t> fields_;
  std::size_t at_ = 0;
  bool ok_ = false, swapped_ = false;
};

template <Message T>
std::string encode_cdr(const T& message) {
  CdrWriter writer;
  writer.write(message);
  return writer.take();
}

/// @return nullopt unless the bytes are exactly one message of this type
template <Message T>
std::optional<T> decode_cdr(std::span<const std::uint8_t> bytes) {
  std::optional<T> message(std::in_place);
  CdrReader reader(bytes);
  reader.read(*message);
  if (!reader.is_complete()) message.reset();
  return message;
}

}  // namespace tern::ros
