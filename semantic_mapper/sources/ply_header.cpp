#include "semantic_mapper/sources/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "semantic_mapper/sources/ply.h"

namespace tern {
namespace {

std::optional<NumberType> type_of(std::string_view word) {
  constexpr std::array<std::array<const char*, 2>, 8> kNames{{{"char", "int8"},
                                                              {"uchar", "uint8"},
                                                              {"short", "int16"},
                                                              {"ushort", "uint16"},
                                                              {"int", "int32"},
                                                              {"uint", "uint32"},
                                                              {"float", "float32"},
                                                              {"double", "float64"}}};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (word == kNames[i][0] || word == kNames[i][1]) return static_cast<NumberType>(i);
  }
  return std::nullopt;
}

/// Parses the header line by line. A call returns an error text, or an empty text if the line is accepted.
class HeaderLines {
 public:
  explicit HeaderLines(std::string_view label) : label_(label) {}

  PlyHeader header;
  bool ended = false;

  std::string take(std::string_view line) {
    const auto words = words_of(line);
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") return "";
    if (words[0] == "format") return take_format(words);
    if (words[0] == "element") return take_element(words);
    if (words[0] == "property") return in_vertices_ ? take_property(words) : "";
    if (words[0] == "end_header") return take_end();
    return fmt::format("unknown header line \"{}\"", line.substr(0, 40));
  }

 private:
  std::string take_format(const std::vector<std::string_view>& words) {
    if (words.size() != 3 || words[2] != "1.0") return "the format line is not \"format <kind> 1.0\"";
    has_format_ = true;
    if (words[1] == "ascii")
      header.format = PlyFormat::Ascii;
    else if (words[1] == "binary_little_endian")
      header.format = PlyFormat::LittleEndian;
    else if (words[1] == "binary_big_endian")
      header.format = PlyFormat::BigEndian;
    else
      return fmt::format("unknown format {}", words[1].substr(0, 40));
    return "";
  }

  std::string take_element(const std::vector<std::string_view>& words) {
    if (words.size() != 3) return "the element line is not \"element <name> <count>\"";
    const auto count = whole_number(words[2]);
    if (!count) return fmt::format("\"{}\" is not a number of elements", words[2].substr(0, 40));
    in_vertices_ = words[1] == "vertex";
    if (!in_vertices_) return has_vertices_ ? "" : fmt::format("element {} before vertex", words[1].substr(0, 40));
    if (has_vertices_) return "element vertex given twice";
    has_vertices_ = true;
    if (*count > static_cast<std::uint64_t>(kMaxCloudPoints))
      return fmt::format("{} vertices (limit {})", *count, kMaxCloudPoints);
    header.count = static_cast<std::size_t>(*count);
    return "";
  }

  std::string take_property(const std::vector<std::string_view>& words) {
    if (words.size() > 1 && words[1] == "list") return "a list property in a vertex";
    if (words.size() != 3) return "the property line is not \"property <type> <name>\"";
    const auto type = type_of(words[1]);
    if (!type) return fmt::format("unknown type {}", words[1].substr(0, 40));
    auto& names = header.columns.names;
    if (names.size() == kMaxPlyProperties) return fmt::format("more than {} properties", kMaxPlyProperties);
    if (std::find(names.begin(), names.end(), words[2]) != names.end()) {
      return fmt::format("property {} given twice", words[2].substr(0, 40));
    }
    names.emplace_back(words[2]);
    header.columns.types.push_back(*type);
    return "";
  }

  std::string take_end() {
    ended = true;
    if (!has_format_) return "no format line";
    if (!has_vertices_) return "no element vertex";
    return header.columns.find(label_);
  }

  bool has_format_ = false;
  bool has_vertices_ = false;
  bool in_vertices_ = false;
  std::string_view label_;
};

}  // namespace

Result<PlyHeader> parse_ply_header(std::span<const std::uint8_t> bytes, const std::string& file,
                                   const std::string& label) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), std::min(bytes.size(), kMaxPlyHeader));
  HeaderLines lines(label);
  std::size_t at = 0;
  while (!lines.ended) {
    const std::size_t end = text.find('\n', at);
    if (end == std::string_view::npos) {
      return bad_file(file, at, fmt::format("no PLY header: no end_header within {} bytes", text.size()));
    }
    const std::string_view line = text.substr(at, end - at);
    if (at == 0) {
      if (line != "ply" && line != "ply\r") return bad_file(file, 0, "no PLY file: it does not begin with ply");
    } else if (const std::string problem = lines.take(line); !problem.empty()) {
      return bad_file(file, at, problem);
    }
    at = end + 1;
  }
  lines.header.data_offset = at;
  return lines.header;
}

}  // namespace tern
