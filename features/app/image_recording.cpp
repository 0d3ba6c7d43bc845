#include "features/app/image_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <span>
#include <string_view>

#include "runtime/config.h"

namespace tern {
namespace {

/// Parses a whole field. @return false if it is something else
template <class T>
bool parse(std::string_view field, T& value) {
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  return error == std::errc{} && end == field.data() + field.size();
}

/// Calls `take` with the fields of each line that is neither empty nor a comment. It returns false for a bad line.
void for_each_row(const std::string& file, const std::function<bool(std::span<const std::string_view>)>& take) {
  std::ifstream stream(file);
  if (!stream) throw ConfigError(fmt::format("{}: cannot be read", file));
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (line.empty() || line[0] == '#') continue;
    std::vector<std::string_view> fields;
    std::string_view rest = line;
    for (std::size_t comma = 0; comma != std::string_view::npos;) {
      comma = rest.find(',');
      fields.push_back(rest.substr(0, comma));
      if (comma != std::string_view::npos) rest.remove_prefix(comma + 1);
    }
    if (!take(fields)) throw ConfigError(fmt::format("{}:{}: \"{}\" is no row of this list", file, number, line));
  }
}

bool parse_time(std::string_view field, UTime& at) {
  std::int64_t ns = 0;
  if (!parse(field, ns) || ns < 0) return false;
  at.us = (ns + 500) / 1000;
  return true;
}

struct ListedImage {
  UTime at;
  std::string file;
};

std::vector<ListedImage> read_images(const std::string& camera) {
  std::vector<ListedImage> images;
  for_each_row(camera + "/data.csv", [&](std::span<const std::string_view> fields) {
    ListedImage image;
    if (fields.size() != 2 || fields[1].empty() || !parse_time(fields[0], image.at)) return false;
    image.file = camera + "/data/" + std::string(fields[1]);
    images.push_back(image);
    return true;
  });
  return images;
}

std::vector<ImuSample> read_samples(const std::string& file) {
  std::vector<ImuSample> instants, means;
  for_each_row(file, [&](std::span<const std::string_view> fields) {
    ImuSample sample;
    if (fields.size() != 7 || !parse_time(fields[0], sample.at)) return false;
    for (int axis = 0; axis < 3; ++axis) {
      if (!parse(fields[idx(1 + axis)], sample.angular_velocity[axis])) return false;
      if (!parse(fields[idx(4 + axis)], sample.specific_force[axis])) return false;
    }
    if (!instants.empty() && sample.at <= instants.back().at) return false;
    instants.push_back(sample);
    return sample.angular_velocity.allFinite() && sample.specific_force.allFinite();
  });
  for (std::size_t k = 1; k < instants.size(); ++k) {
    const ImuSample &a = instants[k - 1], &b = instants[k];
    means.push_back(
        {b.at, 0.5 * (a.angular_velocity + b.angular_velocity), 0.5 * (a.specific_force + b.specific_force)});
  }
  return means;
}

}  // namespace

std::string mav0_of(const std::string& folder) {
  const std::string inner = folder + "/mav0";
  return std::filesystem::is_directory(inner) ? inner : folder;
}

ImageRecording read_image_recording(const std::string& mav0, bool with_imu) {
  ImageRecording recording;
  const std::vector<ListedImage> left = read_images(mav0 + "/cam0");
  std::vector<ListedImage> right = read_images(mav0 + "/cam1");
  std::ranges::stable_sort(right, {}, &ListedImage::at);
  for (const ListedImage& image : left) {
    const auto match = std::ranges::lower_bound(right, image.at - kPairWithin, {}, &ListedImage::at);
    if (match == right.end() || match->at - image.at > kPairWithin) {
      ++recording.unpaired;
    } else {
      recording.pairs.push_back({image.at, image.file, match->file});
    }
  }
  if (recording.pairs.empty()) throw ConfigError(fmt::format("{}: no left image has a right one of its time", mav0));
  if (with_imu) recording.samples = read_samples(mav0 + "/imu0/data.csv");
  return recording;
}

}  // namespace tern
