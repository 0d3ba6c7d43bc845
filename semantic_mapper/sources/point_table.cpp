#include "semantic_mapper/sources/point_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "semantic_mapper/sources/byte_reader.h"

namespace tern {
namespace {

constexpr std::array<std::string_view, 7> kClassNames{"label",    "class",        "classification",       "class_id",
                                                      "semantic", "scalar_Label", "scalar_Classification"};
constexpr std::string_view kSpace = " \t\r\n";

/// Distance of a float32 to the next larger one.
double spacing_of(double value) {
  const auto number = static_cast<float>(value);
  return static_cast<double>(std::nextafter(number, std::numeric_limits<float>::infinity())) - value;
}

/// Equal but for the case of letters.
bool is_named(std::string_view name, std::string_view wanted) {
  return std::equal(name.begin(), name.end(), wanted.begin(), wanted.end(), [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
  });
}

std::size_t column_named(const std::vector<std::string>& names, std::string_view wanted) {
  auto at = std::find(names.begin(), names.end(), wanted);
  if (at == names.end()) {
    at = std::find_if(names.begin(), names.end(), [&](const std::string& name) { return is_named(name, wanted); });
  }
  return at == names.end() ? PointColumns::kNone : idx(at - names.begin());
}

double read_value(std::span<const std::uint8_t> bytes, std::size_t at, NumberType type, std::endian order) {
  switch (type) {
    case NumberType::Int8: return read_number<std::int8_t>(bytes, at, order);
    case NumberType::Uint8: return read_number<std::uint8_t>(bytes, at, order);
    case NumberType::Int16: return read_number<std::int16_t>(bytes, at, order);
    case NumberType::Uint16: return read_number<std::uint16_t>(bytes, at, order);
    case NumberType::Int32: return read_number<std::int32_t>(bytes, at, order);
    case NumberType::Uint32: return read_number<std::uint32_t>(bytes, at, order);
    case NumberType::Float32: return static_cast<double>(read_number<float>(bytes, at, order));
    case NumberType::Float64: return read_number<double>(bytes, at, order);
    case NumberType::Int64: return static_cast<double>(read_number<std::int64_t>(bytes, at, order));
    case NumberType::Uint64: return static_cast<double>(read_number<std::uint64_t>(bytes, at, order));
  }
  return 0.0;
}

}  // namespace

std::size_t size_of(NumberType type) {
  constexpr std::array<std::size_t, 10> kSizes{1, 1, 2, 2, 4, 4, 4, 8, 8, 8};
  return kSizes[idx(type)];
}

std::string PointColumns::find(std::string_view label) {
  constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i) {
    position[i] = column_named(names, kAxes[i]);
    if (position[i] == kNone) return fmt::format("points have no property {} among {}", kAxes[i], listed(names));
  }
  if (!label.empty()) {
    class_number = column_named(names, label);
    if (class_number != kNone) return "";
    return fmt::format("no property {} for the class among {}", label.substr(0, 40), listed(names));
  }
  for (const std::string_view name : kClassNames) {
    class_number = column_named(names, name);
    if (class_number != kNone) break;
  }
  return "";
}

PointRows::PointRows(const PointColumns& columns, const PointFrame& frame, std::size_t count)
    : columns_(columns), frame_(frame) {
  cloud_.has_labels = columns.class_number != PointColumns::kNone;
  cloud_.properties = columns.names;
  cloud_.points.reserve(count);
}

void PointRows::add(const Vec3& p_file, double label) {
  const std::size_t before = cloud_.points.size();
  cloud_.add(p_file, frame_, cloud_.has_labels ? label : 0.0);
  if (cloud_.points.size() == before) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool is_float = columns_.types[columns_.position[axis]] == NumberType::Float32;
    if (is_float) largest_float_ = std::max(largest_float_, std::abs(p_file[static_cast<int>(axis)]));
  }
}

void PointRows::add(const std::vector<double>& values) {
  const auto& at = columns_.position;
  add(Vec3(values[at[0]], values[at[1]], values[at[2]]), cloud_.has_labels ? values[columns_.class_number] : 0.0);
}

CloudFile PointRows::finish() {
  if (largest_float_ > 0.0) cloud_.spacing = spacing_of(largest_float_) * frame_.metres_per_unit;
  return std::exchange(cloud_, {});
}

CloudFile read_records(std::span<const std::uint8_t> bytes, const PointColumns& columns,
                       const std::vector<ColumnPlace>& places, std::size_t count, std::endian order,
                       const PointFrame& frame) {
  PointRows rows(columns, frame, count);
  const auto value = [&](std::size_t column, std::size_t row) {
    return read_value(bytes, places[column].first + row * places[column].stride, columns.types[column], order);
  };
  const bool has_class = columns.class_number != PointColumns::kNone;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 p(value(columns.position[0], i), value(columns.position[1], i), value(columns.position[2], i));
    rows.add(p, has_class ? value(columns.class_number, i) : 0.0);
  }
  return rows.finish();
}

Result<CloudFile> read_text_rows(std::span<const std::uint8_t> bytes, std::size_t at, const std::string& file,
                                 const PointColumns& columns, std::size_t count, const PointFrame& frame) {
  // A number takes at least two characters, so the reserved memory is bounded by the file's size.
  const std::size_t most = (bytes.size() - at + 1) / (2 * columns.names.size());
  if (count > most) return bad_file(file, at, fmt::format("{} points, but the file has room for {}", count, most));
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  PointRows rows(columns, frame, count);
  std::vector<double> values(columns.names.size());
  for (std::size_t i = 0; i < count; ++i) {
    for (double& value : values) {
      const auto number = next_number(text, at);
      if (!number) return bad_file(file, at, fmt::format("no number where point {} needs one", i));
      value = *number;
    }
    rows.add(values);
  }
  return rows.finish();
}

std::optional<double> next_number(std::string_view text, std::size_t& at) {
  at = std::min(text.find_first_not_of(kSpace, at), text.size());
  if (at < text.size() && text[at] == '+') ++at;
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), value);
  const auto stop = static_cast<std::size_t>(end - text.data());
  const bool ends_well = stop == text.size() || kSpace.find(text[stop]) != std::string_view::npos;
  if (error != std::errc() || !ends_well) return std::nullopt;
  at = stop;
  return value;
}

std::vector<std::string_view> words_of(std::string_view line, std::string_view separators) {
  const std::string between = std::string(" \t\r").append(separators);
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t begin = line.find_first_not_of(between);
    if (begin == std::string_view::npos) return words;
    line.remove_prefix(begin);
    const std::size_t end = std::min(line.find_first_of(between), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

std::optional<std::uint64_t> whole_number(std::string_view word) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace tern
