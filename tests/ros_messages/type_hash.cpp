#include "tests/ros_messages/type_hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>

namespace tern::testing {
namespace {

using ros::FieldDescription;
using ros::TypeDescription;
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

std::string hashed_text(const ros::RosType& type) {
  std::vector<TypeDescription> others(type.types.begin() + 1, type.types.end());
  std::sort(others.begin(), others.end(),
            [](const TypeDescription& a, const TypeDescription& b) { return a.name < b.name; });
  std::string list;
  for (const TypeDescription& other : others) list += (list.empty() ? "" : ", ") + json_of(other);
  return fmt::format(R"({{"type_description": {}, "referenced_type_descriptions": [{}]}})", json_of(type.types.front()),
                     list);
}

/// SHA-256 (FIPS 180-4). Its constants are the first 32 bits of the fractions of roots of the first primes.
class Sha256 {
 public:
  std::string hex(std::string bytes) {
    const std::uint64_t bits = 8 * bytes.size();
    bytes += '\x80';
    while (bytes.size() % 64 != 56) bytes += '\0';
    for (int shift = 56; shift >= 0; shift -= 8) bytes += static_cast<char>(bits >> shift & 0xFF);
    for (std::size_t at = 0; at < bytes.size(); at += 64) take(bytes.data() + at);
    std::string text;
    for (const std::uint32_t word : state_) text += fmt::format("{:08x}", word);
    return text;
  }

 private:
  static std::uint32_t fraction(long double root) {
    return static_cast<std::uint32_t>((root - std::floor(root)) * 4294967296.0L);
  }
  static std::vector<int> primes() {
    std::vector<int> found;
    for (int n = 2; found.size() < 64; ++n) {
      if (std::none_of(found.begin(), found.end(), [n](int p) { return n % p == 0; })) found.push_back(n);
    }
    return found;
  }

  void take(const char* block) {
    std::array<std::uint32_t, 64> w{};
    for (std::size_t k = 0; k < 64; ++k) w[k / 4] = w[k / 4] << 8 | static_cast<std::uint8_t>(block[k]);
    for (std::size_t k = 16; k < 64; ++k) {
      const std::uint32_t a = w[k - 15], b = w[k - 2];
      w[k] = w[k - 16] + (std::rotr(a, 7) ^ std::rotr(a, 18) ^ a >> 3) + w[k - 7] +
             (std::rotr(b, 17) ^ std::rotr(b, 19) ^ b >> 10);
    }
    auto [a, b, c, d, e, f, g, h] = state_;
    for (std::size_t k = 0; k < 64; ++k) {
      const std::uint32_t constant = fraction(std::cbrt(static_cast<long double>(primes_[k])));
      const std::uint32_t t1 =
          h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) + ((e & f) ^ (~e & g)) + constant + w[k];
      const std::uint32_t t2 = (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
      h = g, g = f, f = e, e = d + t1, d = c, c = b, b = a, a = t1 + t2;
    }
    const std::array<std::uint32_t, 8> change{a, b, c, d, e, f, g, h};
    for (std::size_t k = 0; k < 8; ++k) state_[k] += change[k];
  }

  std::vector<int> primes_ = primes();
  std::array<std::uint32_t, 8> state_ = [this] {
    std::array<std::uint32_t, 8> start{};
    for (std::size_t k = 0; k < 8; ++k) start[k] = fraction(std::sqrt(static_cast<long double>(primes_[k])));
    return start;
  }();
};

}  // namespace

std::string type_hash(const ros::RosType& type) { return "RIHS01_" + Sha256().hex(hashed_text(type)); }

}  // namespace tern::testing
