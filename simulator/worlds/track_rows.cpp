#include "simulator/worlds/track_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "core/base/plain_text.h"
#include "simulator/worlds/obstacle.h"

namespace tern {
namespace {

constexpr double kMaxWholeId = 1e15;
constexpr std::size_t kId = 4;  // of RowReader's values
constexpr std::size_t kMaxTextId = 40;
constexpr std::string_view kBlank = " \t\r";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::string_view trimmed(std::string_view word) {
  const std::size_t begin = std::min(word.find_first_not_of(kBlank), word.size());
  word.remove_prefix(begin);
  return word.substr(0, word.find_last_not_of(kBlank) + 1);
}

/// Cuts the line into at most `most` words. A separator at the line's end begins no further word.
void split(std::string_view line, std::size_t most, std::vector<std::string_view>& words) {
  words.clear();
  line = trimmed(line);
  const bool has_semicolon = line.find(';') != std::string_view::npos;
  const bool is_blank = !has_semicolon && line.find(',') == std::string_view::npos;
  const std::string_view separators = is_blank ? kBlank : has_semicolon ? ";" : ",";
  while (!line.empty() && words.size() < most) {
    const std::size_t end = std::min(line.find_first_of(separators), line.size());
    words.push_back(trimmed(line.substr(0, end)));
    line.remove_prefix(std::min(end + 1, line.size()));
    if (is_blank) line = trimmed(line);
  }
}

/// Returns the number; NaN for an empty word; nullopt for text.
std::optional<double> to_number(std::string_view word) {
  if (word.empty()) return std::numeric_limits<double>::quiet_NaN();
  if (word.size() > 1 && word.front() == '+') word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range) return std::numeric_limits<double>::infinity();
  return error == std::errc{} ? std::optional(value) : std::nullopt;
}

/// Reads line after line. take() returns the fault of a line, or "".
class RowReader {
 public:
  explicit RowReader(const RecordedTracksSpec& spec) : spec_(spec) {
    for (const int column : {spec.frame_column, spec.x_column, spec.y_column}) used_.push_back(column);
    used_.push_back(spec.z_column.value_or(spec.x_column));
    used_.push_back(std::max(spec.id_column, spec.id_column < 0 ? spec.frame_column : 0));
  }

  TrackRows result;

  std::string take(std::string_view line, std::size_t line_number) {
    const auto columns = static_cast<std::size_t>(spec_.columns);
    split(line, columns + 1, words_);
    const bool is_first = !std::exchange(has_begun_, true);
    if (is_first && is_header()) return "";
    if (words_.size() != columns) {
      return fmt::format("{} columns{}, {} expected", words_.size(), words_.size() > columns ? " or more" : "",
                         columns);
    }
    for (std::size_t k = 0; k < used_.size(); ++k) {
      const std::string_view word = words_[idx(used_[k])];
      std::optional<double> value = to_number(word);
      if (k == kId) text_id_.reset();
      if (!value && k == kId && spec_.id_column >= 0) {
        text_id_ = number_of(word);
        value = 0.0;
      }
      if (!value) return fmt::format("'{}' is not a number", plain_text(word, 40));
      values_[k] = *value;
    }
    return add(line_number);
  }

 private:
  [[nodiscard]] bool is_header() const {
    return std::ranges::none_of(used_, [&](int column) {
      return static_cast<std::size_t>(column) < words_.size() && to_number(words_[idx(column)]);
    });
  }

  std::string add(std::size_t line_number) {
    if (!std::ranges::all_of(values_, [](double value) { return std::isfinite(value); })) {
      ++result.not_finite;
      return "";
    }
    const double id = spec_.id_column < 0 ? 0.0 : values_[kId];
    if (id != std::floor(id) || std::abs(id) > kMaxWholeId) return fmt::format("id {} is not a whole number", id);
    const double unit = spec_.metres_per_unit;
    const Vec3 p(values_[1] * unit, values_[2] * unit, spec_.z_column ? values_[3] * unit : spec_.centre_z);
    if (!(p.cwiseAbs().maxCoeff() <= WorldObstacle::kMaxCoordinate)) {
      return fmt::format("position ({}, {}, {}) m, beyond {} m", p.x(), p.y(), p.z(), WorldObstacle::kMaxCoordinate);
    }
    if (result.rows.size() == kMaxTrackRows) return fmt::format("more than {} rows", kMaxTrackRows);
    result.rows.push_back({text_id_.value_or(static_cast<std::int64_t>(id)), values_[0], p, line_number});
    return "";
  }

  /// Returns the number that stands for an id that is text.
  std::int64_t number_of(std::string_view id) {
    const auto next = kFirstTextId + static_cast<std::int64_t>(result.text_ids.size());
    const auto [known, is_new] = text_ids_.try_emplace(plain_text(id, kMaxTextId), next);
    if (is_new) result.text_ids.push_back(known->first);
    return known->second;
  }

  const RecordedTracksSpec& spec_;
  std::vector<int> used_;                // columns of frame, x, y, z, id; a column that is not read stands for another
  std::array<double, 5> values_{};       // of these
  std::optional<std::int64_t> text_id_;  // of the row, if its id is text
  std::map<std::string, std::int64_t> text_ids_;
  std::vector<std::string_view> words_;
  bool has_begun_ = false;
};

}  // namespace

Result<TrackRows> read_track_rows(std::string_view text, const std::string& name, const RecordedTracksSpec& spec) {
  RowReader reader(spec);
  if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) text.remove_prefix(kByteOrderMark.size());
  for (std::size_t line_number = 1; !text.empty(); ++line_number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty() || line.front() == '#') continue;
    if (const std::string wrong = reader.take(line, line_number); !wrong.empty()) {
      return fail(fmt::format("{}:{}: {}", name, line_number, wrong));
    }
  }
  return std::move(reader.result);
}

}  // namespace tern
