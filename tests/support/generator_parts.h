// The parts of random messages: numbers, texts and heads within the limits of messages.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/wire/message_limits.h"
#include "tests/support/generators.h"
#include "tests/support/random_splines.h"

namespace tern::support {

inline constexpr std::int64_t kMaxCounter = std::numeric_limits<std::int64_t>::max();

/// Within [lo, hi]; one in ten is an end.
inline double number(Rng& rng, double lo, double hi) {
  const double u = rng.uniform();
  if (u < 0.05) return lo;
  if (u < 0.10) return hi;
  return rng.uniform(lo, hi);
}

inline std::int64_t integer(Rng& rng, std::int64_t lo, std::int64_t hi) {
  const double x = std::round(number(rng, static_cast<double>(lo), static_cast<double>(hi)));
  return x >= static_cast<double>(hi) ? hi : std::max(lo, static_cast<std::int64_t>(x));
}

inline int count(Rng& rng, Fill fill, int lo, int hi) {
  if (fill == Fill::Largest) return hi;
  const double u = rng.uniform();
  return rng.uniform() < 0.02 ? hi : random_integer(rng, lo, lo + static_cast<int>((hi - lo) * u * u * u * u));
}

template <class Enum>
Enum enumerator(Rng& rng, Enum last) {
  return static_cast<Enum>(random_integer(rng, 0, static_cast<int>(last)));
}

inline bool flag(Rng& rng) { return rng.uniform() < 0.5; }
inline Vec3 vec3(Rng& rng, double lo, double hi) {
  const double x = number(rng, lo, hi);
  const double y = number(rng, lo, hi);
  return {x, y, number(rng, lo, hi)};
}
inline Vec3 position(Rng& rng) { return vec3(rng, -kMaxCoordinate, kMaxCoordinate); }
inline Vec3 extents(Rng& rng) { return vec3(rng, 0.0, kMaxCoordinate); }
inline UTime time(Rng& rng) { return {integer(rng, -kMaxTimeUs, kMaxTimeUs)}; }
inline Duration interval(Rng& rng) { return {integer(rng, kMinIntervalDuration.us, kMaxIntervalDuration.us)}; }
inline double positive(Rng& rng, double hi) {
  return rng.uniform() < 0.05 ? std::numeric_limits<double>::denorm_min() : number(rng, 1e-3, hi);
}

inline Eigen::Vector4d quaternion(Rng& rng) {
  return (Eigen::Vector4d(2.0, 0.0, 0.0, 0.0) + Eigen::Vector4d::Constant(rng.uniform())).normalized();
}

inline Points points(Rng& rng, int n, double limit) {
  Points result(3, n);
  for (int i = 0; i < n; ++i) result.col(i) = vec3(rng, -limit, limit);
  return result;
}

inline MotionSample motion(Rng& rng) {
  return {position(rng), vec3(rng, -kMaxSpeed, kMaxSpeed), vec3(rng, -kMaxAcceleration, kMaxAcceleration),
          vec3(rng, -kMaxJerk, kMaxJerk)};
}

inline MessageName name(Rng& rng) { return {integer(rng, 0, kMaxTimeUs), integer(rng, 0, kMaxCounter)}; }
inline Header header(Rng& rng) { return {{integer(rng, 0, kMaxTimeUs), integer(rng, 1, kMaxCounter)}, time(rng)}; }

inline BatchHeader batch(Rng& rng) {
  BatchHeader b;
  b.set = integer(rng, 1, kMaxCounter);
  b.count = random_integer(rng, 1, kMaxBatches);
  b.index = random_integer(rng, 0, b.count - 1);
  return b;
}

/// Exactly n bytes of text, some of them of two to four bytes a letter.
inline std::string text(Rng& rng, int n) {
  static const std::vector<std::string> kLetters = {"é", "α", "–", "木", "🜁"};
  std::string result;
  while (static_cast<int>(result.size()) < n) {
    const std::string& letter = kLetters[static_cast<std::size_t>(random_integer(rng, 0, 4))];
    const bool fits = static_cast<int>(result.size() + letter.size()) <= n;
    if (fits && rng.uniform() < 0.1) {
      result += letter;
    } else {
      result += rng.uniform() < 0.02 ? '\n' : static_cast<char>(random_integer(rng, 0x20, 0x7E));
    }
  }
  return result;
}

inline std::vector<std::int64_t> different_ids(Rng& rng, int n) {
  std::vector<std::int64_t> ids;
  std::int64_t id = 0;
  for (int i = 0; i < n; ++i) ids.push_back(id += random_integer(rng, 1, 1000));
  std::reverse(ids.begin(), ids.begin() + n / 2);
  return ids;
}

}  // namespace tern::support
