#include "messages/fields.h"

#include <fmt/format.h>

namespace tern::wire {
namespace {

static_assert(tern_msgs::batch_t::MAX_BATCHES == kMaxBatches);

}  // namespace

tern_msgs::vec3_t to_lcm(const Vec3& v) { return {.x = v.x(), .y = v.y(), .z = v.z()}; }

tern_msgs::message_name_t to_lcm(const MessageName& name) {
  return {.sender_epoch_us = name.sender_epoch_us, .sequence = name.sequence};
}

tern_msgs::header_t to_lcm(const Header& header) { return {.name = to_lcm(header.name), .utime_us = header.utime.us}; }

tern_msgs::batch_t to_lcm(const BatchHeader& batch) {
  return {.set = batch.set, .index = batch.index, .count = batch.count};
}

tern_msgs::motion_t to_lcm(const MotionSample& motion) {
  return {.position = to_lcm(motion.p),
          .velocity = to_lcm(motion.v),
          .acceleration = to_lcm(motion.a),
          .jerk = to_lcm(motion.j)};
}

std::vector<tern_msgs::vec3_t> to_lcm(const Points& points) {
  std::vector<tern_msgs::vec3_t> list;
  list.reserve(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index i = 0; i < points.cols(); ++i) list.push_back(to_lcm(Vec3(points.col(i))));
  return list;
}

void append(std::vector<std::uint8_t>& bytes, std::string_view text) {
  bytes.insert(bytes.end(), text.begin(), text.end());
}

double FieldReader::number(double x, double low, double high, const char* part) {
  return note(low <= x && x <= high, Rejection::Number, x, part) ? x : low;
}

Vec3 FieldReader::vec3(const tern_msgs::vec3_t& v, double low, double high) {
  return {number(v.x, low, high, ".x"), number(v.y, low, high, ".y"), number(v.z, low, high, ".z")};
}

void FieldReader::points(const char* name, const std::vector<tern_msgs::vec3_t>& list, Points& x, double limit) {
  x.resize(3, static_cast<Eigen::Index>(list.size()));
  for (std::size_t i = 0; i < list.size(); ++i) {
    enter(name, i);
    x.col(static_cast<Eigen::Index>(i)) = vec3(list[i], -limit, limit);
  }
  leave();
}

void FieldReader::motion(const char* name, const tern_msgs::motion_t& m, MotionSample& x) {
  enter(name, kNoIndex);
  position("position", m.position, x.p);
  vec3("velocity", m.velocity, x.v, -kMaxSpeed, kMaxSpeed);
  vec3("acceleration", m.acceleration, x.a, -kMaxAcceleration, kMaxAcceleration);
  vec3("jerk", m.jerk, x.j, -kMaxJerk, kMaxJerk);
  leave();
}

void FieldReader::time(const char* name, std::int64_t us, UTime& x) {
  x = named(name).note(-kMaxTimeUs <= us && us <= kMaxTimeUs, Rejection::Time, us) ? UTime{us} : UTime{};
}

Duration FieldReader::duration(std::int64_t us, Duration low, Duration high) {
  return note(low.us <= us && us <= high.us, Rejection::Time, us) ? Duration{us} : low;
}

std::string FieldReader::text(std::span<const std::uint8_t> bytes) {
  std::string result(bytes.begin(), bytes.end());
  note(is_plain_text(result), Rejection::Number, "a text has bytes that are not plain UTF-8");
  return result;
}

void FieldReader::name(const char* name, const tern_msgs::message_name_t& m, MessageName& x) {
  named(name).note(0 <= m.sender_epoch_us && m.sender_epoch_us <= kMaxTimeUs, Rejection::Time, m.sender_epoch_us,
                   ".sender_epoch_us");
  note(m.sequence >= 0, Rejection::Number, m.sequence, ".sequence");
  x = {m.sender_epoch_us, std::max<std::int64_t>(m.sequence, 0)};
}

void FieldReader::header(const char* name, const tern_msgs::header_t& m, Header& x) {
  named(name).note(m.name.sequence >= 1, Rejection::Number, m.name.sequence, ".name.sequence");
  this->name("header.name", m.name, x.name);
  time("header.utime_us", m.utime_us, x.utime);
}

void FieldReader::batch(const char* name, const tern_msgs::batch_t& m, BatchHeader& x) {
  enter(name, kNoIndex);
  integer("set", m.set, x.set, 1, kMaxCounter);
  integer("index", m.index, x.index, 0, kMaxBatches - 1);
  integer("count", m.count, x.count, 1, kMaxBatches);
  consistent(x.index < x.count, "batch.index is not below batch.count");
  leave();
}

bool FieldReader::is_placed(const tern_msgs::vec3_t& position) {
  FieldReader alone;
  alone.enter(list_, index_);
  Vec3 p;
  alone.position("position", position, p);
  if (left_out_field_.empty()) left_out_field_ = alone.refused_field();
  return alone.ok();
}

std::string FieldReader::field(const char* part) const {
  std::string text = list_;
  if (!text.empty() && index_ != kNoIndex) text += "[" + std::to_string(index_) + "]";
  if (!text.empty() && *name_ != '\0') text += ".";
  return text + name_ + part;
}

void FieldReader::describe(const char* part, double value) {
  const std::string of = field(part);
  refused_field_ = of.empty() ? "" : fmt::format("{} is {:g}", of, value);
}

void FieldReader::describe(const char* part, std::int64_t value) {
  const std::string of = field(part);
  refused_field_ = of.empty() ? "" : fmt::format("{} is {}", of, value);
}

void FieldReader::all_different(std::vector<std::int64_t> values, const char* broken) {
  std::sort(values.begin(), values.end());
  const auto twice = std::adjacent_find(values.begin(), values.end());
  if (twice == values.end()) return;
  const bool is_told = !refused_ || Rejection::Inconsistent < *refused_;
  consistent(false, broken);
  if (is_told) refused_field_ += fmt::format(" {}", *twice);
}

}  // namespace tern::wire
