#include "semantic_mapper/sources/pcd_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "semantic_mapper/sources/pcd.h"

namespace tern {
namespace {

using Words = std::vector<std::string_view>;

/// "F" and "4" as Float32.
std::optional<NumberType> type_of(std::string_view type, std::string_view size) {
  using Row = std::pair<std::array<std::string_view, 2>, NumberType>;
  static constexpr std::array<Row, 10> kTypes{{{{"F", "4"}, NumberType::Float32},
                                               {{"F", "8"}, NumberType::Float64},
                                               {{"I", "1"}, NumberType::Int8},
                                               {{"I", "2"}, NumberType::Int16},
                                               {{"I", "4"}, NumberType::Int32},
                                               {{"I", "8"}, NumberType::Int64},
                                               {{"U", "1"}, NumberType::Uint8},
                                               {{"U", "2"}, NumberType::Uint16},
                                               {{"U", "4"}, NumberType::Uint32},
                                               {{"U", "8"}, NumberType::Uint64}}};
  for (const auto& [words, number] : kTypes) {
    if (words[0] == type && words[1] == size) return number;
  }
  return std::nullopt;
}

/// Parses the header line by line. A call returns an error text, or an empty text if the line is accepted.
class HeaderLines {
 public:
  explicit HeaderLines(std::string_view label) : label_(label) {}

  PcdHeader header;
  bool ended = false;
  bool has_begun = false;  ///< a line of a PCD header was found

  std::string take(std::string_view line) {
    Words words = words_of(line);
    if (words.empty() || words[0].starts_with('#')) return "";
    const std::string_view key = words[0];
    words.erase(words.begin());
    const bool is_known = take_list(key, words) || key == "VERSION" || take_number(key, words);
    has_begun = has_begun || is_known;
    if (is_known && problem_.empty()) return "";
    if (is_known) return problem_;
    if (key == "VIEWPOINT") return take_viewpoint(words);
    if (key == "DATA") return take_end(words);
    return fmt::format("unknown header line \"{}\"", line.substr(0, 40));
  }

 private:
  bool take_list(std::string_view key, const Words& words) {
    Words* list = key == "FIELDS" || key == "COLUMNS" ? &fields_
                  : key == "SIZE"                     ? &sizes_
                  : key == "TYPE"                     ? &types_
                  : key == "COUNT"                    ? &counts_
                                                      : nullptr;
    if (list == nullptr) return false;
    if (words.size() > kMaxPcdFields) problem_ = fmt::format("more than {} fields", kMaxPcdFields);
    *list = words;
    return true;
  }

  bool take_number(std::string_view key, const Words& words) {
    auto* number = key == "WIDTH" ? &width_ : key == "HEIGHT" ? &height_ : key == "POINTS" ? &points_ : nullptr;
    if (number == nullptr) return false;
    *number = words.size() == 1 ? whole_number(words[0]) : std::nullopt;
    if (!*number) problem_ = fmt::format("the line {} is not a number", key);
    return true;
  }

  std::string take_viewpoint(const Words& words) {
    constexpr std::array<double, 7> kOrigin{0, 0, 0, 1, 0, 0, 0};
    if (words.size() != kOrigin.size()) return "VIEWPOINT has not seven numbers";
    for (std::size_t i = 0; i < kOrigin.size(); ++i) {
      std::size_t at = 0;
      const auto value = next_number(words[i], at);
      if (!value) return fmt::format("VIEWPOINT: \"{}\" is not a number", words[i].substr(0, 40));
      header.is_moved = header.is_moved || *value != kOrigin[i];
    }
    return "";
  }

  std::string take_end(const Words& words) {
    ended = true;
    constexpr std::array<std::string_view, 3> kKinds{"ascii", "binary", "binary_compressed"};
    const auto kind = words.size() == 1 ? std::find(kKinds.begin(), kKinds.end(), words[0]) : kKinds.end();
    if (kind == kKinds.end()) return "the line DATA is not ascii, binary or binary_compressed";
    header.data = static_cast<PcdData>(kind - kKinds.begin());
    if (label_ == kPcdPadding) return fmt::format("the field {} is padding: it has no class", kPcdPadding);
    if (std::string problem = add_columns(); !problem.empty()) return problem;
    if (std::string problem = set_count(); !problem.empty()) return problem;
    return header.columns.find(label_);
  }

  std::string add_columns() {
    if (fields_.empty()) return "no line FIELDS";
    if (counts_.empty()) counts_.assign(fields_.size(), "1");
    if (sizes_.size() != fields_.size() || types_.size() != fields_.size() || counts_.size() != fields_.size()) {
      return fmt::format("{} fields, but {} sizes, {} types and {} counts", fields_.size(), sizes_.size(),
                         types_.size(), counts_.size());
    }
    PointColumns& columns = header.columns;
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      const auto type = type_of(types_[i], sizes_[i]);
      if (!type) return fmt::format("no type {} of {} bytes", types_[i].substr(0, 20), sizes_[i].substr(0, 20));
      const auto count = whole_number(counts_[i]);
      if (!count || *count > kMaxPcdFields - columns.names.size()) {
        return fmt::format("COUNT {}: more than {} numbers per point", counts_[i].substr(0, 20), kMaxPcdFields);
      }
      const auto earlier = std::find(columns.names.begin(), columns.names.end(), fields_[i]);
      if (earlier != columns.names.end() && fields_[i] != kPcdPadding)
        return fmt::format("field {} given twice", fields_[i].substr(0, 40));
      columns.names.insert(columns.names.end(), static_cast<std::size_t>(*count), std::string(fields_[i]));
      columns.types.insert(columns.types.end(), static_cast<std::size_t>(*count), *type);
      header.field_ends.push_back(columns.names.size());
    }
    return "";
  }

  std::string set_count() {
    if (!points_ && !(width_ && height_)) return "neither POINTS nor WIDTH and HEIGHT";
    const auto limit = static_cast<std::uint64_t>(kMaxCloudPoints);
    const std::uint64_t height = height_.value_or(1);
    const std::uint64_t width = width_.value_or(points_.value_or(0));
    if (height > 0 && width > limit / height) return fmt::format("{} × {} points (limit {})", width, height, limit);
    const std::uint64_t points = points_.value_or(width * height);
    if (width_ && height_ && points != width * height) {
      return fmt::format("POINTS {}, but WIDTH × HEIGHT is {}", points, width * height);
    }
    if (points > limit) return fmt::format("{} points (limit {})", points, limit);
    header.count = static_cast<std::size_t>(points);
    return "";
  }

  Words fields_, sizes_, types_, counts_;
  std::optional<std::uint64_t> width_, height_, points_;
  std::string problem_;
  std::string_view label_;
};

}  // namespace

Result<PcdHeader> parse_pcd_header(std::span<const std::uint8_t> bytes, const std::string& file,
                                   const std::string& label) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), std::min(bytes.size(), kMaxPcdHeader));
  HeaderLines lines(label);
  std::size_t at = 0;
  while (!lines.ended) {
    const std::size_t end = text.find('\n', at);
    if (end == std::string_view::npos) {
      return bad_file(file, at, fmt::format("no PCD header: no line DATA within {} bytes", text.size()));
    }
    const std::string problem = lines.take(text.substr(at, end - at));
    if (!problem.empty()) return bad_file(file, at, lines.has_begun ? problem : "no PCD file: " + problem);
    at = end + 1;
  }
  lines.header.data_offset = at;
  return lines.header;
}

}  // namespace tern
