#include "viewer/bridge/json_writer.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <utility>

namespace tern {

void JsonWriter::separate() {
  if (out_.empty()) return;
  const char last = out_.back();
  if (last != '{' && last != '[' && last != ':') out_ += ',';
}

JsonWriter& JsonWriter::begin_object() { return raw("{"); }

JsonWriter& JsonWriter::end_object() {
  out_ += '}';
  return *this;
}

JsonWriter& JsonWriter::begin_list() { return raw("["); }

JsonWriter& JsonWriter::end_list() {
  out_ += ']';
  return *this;
}

JsonWriter& JsonWriter::key(std::string_view name) {
  text(name);
  out_ += ':';
  return *this;
}

JsonWriter& JsonWriter::number(double x) {
  if (!std::isfinite(x)) return raw("null");
  separate();
  fmt::format_to(std::back_inserter(out_), "{:.4f}", x);
  while (out_.back() == '0') out_.pop_back();
  if (out_.back() == '.') out_.pop_back();
  return *this;
}

JsonWriter& JsonWriter::integer(std::int64_t x) {
  separate();
  fmt::format_to(std::back_inserter(out_), "{}", x);
  return *this;
}

JsonWriter& JsonWriter::flag(bool x) { return raw(x ? "true" : "false"); }

JsonWriter& JsonWriter::text(std::string_view utf8) {
  separate();
  out_ += '"';
  for (const char c : utf8) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out_.append("\\") += c;
    } else if (byte < 0x20) {
      fmt::format_to(std::back_inserter(out_), "\\u{:04x}", byte);
    } else {
      out_ += c;
    }
  }
  out_ += '"';
  return *this;
}

JsonWriter& JsonWriter::point(const Vec3& p) { return number(p.x()).number(p.y()).number(p.z()); }

JsonWriter& JsonWriter::points(const Points& p) {
  for (Eigen::Index k = 0; k < p.cols(); ++k) point(p.col(k));
  return *this;
}

JsonWriter& JsonWriter::vec3(const Vec3& p) { return begin_list().point(p).end_list(); }

JsonWriter& JsonWriter::raw(std::string_view json) {
  separate();
  out_ += json;
  return *this;
}

std::string JsonWriter::take() { return std::exchange(out_, {}); }

}  // namespace tern
