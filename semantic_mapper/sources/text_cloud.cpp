#include "semantic_mapper/sources/text_cloud.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "semantic_mapper/sources/point_table.h"

namespace tern {
namespace {

constexpr std::string_view kSeparators = ",;";
/// Around names of columns: quotes, and the slashes of CloudCompare's comment.
constexpr std::string_view kAroundNames = "\"'/";

bool is_number(std::string_view word) {
  std::size_t at = 0;
  return next_number(word, at).has_value();
}

/// Names the columns by the first line. @return an error text; "" if all is well
std::string read_names(std::string_view line, const std::string& label, PointColumns& columns) {
  for (std::string_view word : words_of(line, kSeparators)) {
    const std::size_t begin = std::min(word.find_first_not_of(kAroundNames), word.size());
    word = word.substr(begin, word.find_last_not_of(kAroundNames) + 1 - begin);
    if (!word.empty()) columns.names.emplace_back(word);
  }
  if (columns.names.size() > kMaxTextColumns) return fmt::format("more than {} columns", kMaxTextColumns);
  columns.types.assign(columns.names.size(), NumberType::Float64);
  return columns.find(label);
}

/// Numbers the columns, as the file does not name them. @return an error text; "" if all is well
std::string number_columns(std::size_t count, const std::string& label, PointColumns& columns) {
  if (count < 3) return fmt::format("{} numbers in a line (a point has at least 3)", count);
  if (count > kMaxTextColumns) return fmt::format("more than {} columns", kMaxTextColumns);
  columns.names.assign(count, "");
  columns.types.assign(count, NumberType::Float64);
  for (std::size_t i = 0; i < 3; ++i) columns.position[i] = i;
  if (label.empty()) return "";
  const auto column = whole_number(label);
  if (!column || *column < 4 || *column > count) {
    return fmt::format("no column {} for the class: the {} columns have no names, so `label` is a number from 4", label,
                       count);
  }
  columns.class_number = static_cast<std::size_t>(*column) - 1;
  return "";
}

/// Parses the lines of a file in turn. A call returns an error text, or an empty text if the line is accepted.
class Lines {
 public:
  Lines(const PointFrame& frame, const std::string& label) : frame_(frame), label_(label) {}

  std::string take(std::string_view line) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos || line[begin] == '#') return "";
    // The words of a line take eight times its memory and more.
    if (line.size() > kMaxTextLine) return fmt::format("{} bytes (limit {})", line.size(), kMaxTextLine);
    const bool is_first = std::exchange(is_first_, false);
    if (columns_.names.empty()) {
      const auto words = words_of(line, kSeparators);
      if (is_first && words.size() == 1 && whole_number(words[0])) return "";
      const bool has_names = !words.empty() && !is_number(words[0]);
      std::string problem =
          has_names ? read_names(line, label_, columns_) : number_columns(words.size(), label_, columns_);
      if (has_names || !problem.empty()) return problem;
    }
    return take_point(line);
  }

  CloudFile finish() {
    CloudFile cloud = rows_ ? rows_->finish() : CloudFile{};
    if (columns_.names.empty() || columns_.names.front().empty()) cloud.properties.clear();
    return cloud;
  }

 private:
  std::string take_point(std::string_view line) {
    if (!rows_) rows_.emplace(columns_, frame_, 0);
    if (++count_ > kMaxCloudPoints) return fmt::format("more than {} points", kMaxCloudPoints);
    values_.clear();
    for (const std::string_view word : words_of(line, kSeparators)) {
      std::size_t at = 0;
      const auto value = next_number(word, at);
      if (!value) return fmt::format("\"{}\" is not a number", word.substr(0, 40));
      values_.push_back(*value);
    }
    if (values_.size() != columns_.names.size()) {
      return fmt::format("{} numbers in a line, but {} columns", values_.size(), columns_.names.size());
    }
    rows_->add(values_);
    return "";
  }

  PointFrame frame_;
  const std::string& label_;
  std::int64_t count_ = 0;
  bool is_first_ = true;
  PointColumns columns_;
  std::optional<PointRows> rows_;
  std::vector<double> values_;
};

}  // namespace

Result<CloudFile> parse_text_cloud(std::span<const std::uint8_t> bytes, const std::string& file,
                                   const PointFrame& frame, const std::string& label) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  Lines lines(frame, label);
  std::size_t number = 1;
  for (std::size_t at = 0; at < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (const std::string problem = lines.take(text.substr(at, end - at)); !problem.empty()) {
      return bad_file(file, at, fmt::format("line {}: {}", number, problem));
    }
    at = end + 1;
  }
  return lines.finish();
}

}  // namespace tern
