#include "features/app/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <vector>

#include "runtime/config.h"
#include "runtime/yaml_tree.h"

namespace tern {
namespace {

/// A rotation matrix of a file has a few digits: |RᵀR − 1| may be this large.
constexpr double kNotRotation = 1e-3;

struct Transform {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Vec3 p = Vec3::Zero();
};

Transform inverse(const Transform& T) { return {T.R.transpose(), -(T.R.transpose() * T.p)}; }

YamlValue read_yaml_file(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) throw ConfigError(fmt::format("{}: cannot be read", file));
  std::string text, line;
  while (std::getline(stream, line)) text += line.starts_with('%') ? "\n" : line + "\n";  // OpenCV's "%YAML:1.0"
  return parse_yaml(text, file);
}

const YamlValue& required(const YamlValue& mapping, const std::string& key) {
  const YamlValue* value = mapping.find(key);
  if (value == nullptr) throw ConfigError(fmt::format("{}: {} is missing", mapping.where, key));
  return *value;
}

double number(const YamlValue& value, const std::string& key) {
  double x = 0.0;
  const char* end = value.scalar.data() + value.scalar.size();
  const auto [last, error] = std::from_chars(value.scalar.data(), end, x);
  if (value.kind != YamlValue::Kind::Scalar || error != std::errc{} || last != end || !std::isfinite(x)) {
    throw ConfigError(fmt::format("{}: {}: {} is no number", value.where, key, value.describe()));
  }
  return x;
}

/// The numbers of a list, or of a list of lists.
std::vector<double> numbers(const YamlValue& value, const std::string& key) {
  if (value.kind != YamlValue::Kind::Sequence) return {number(value, key)};
  std::vector<double> out;
  for (const YamlValue& item : value.items) {
    for (const double x : numbers(item, key)) out.push_back(x);
  }
  return out;
}

std::vector<double> numbers(const YamlValue& mapping, const std::string& key, std::size_t least, std::size_t most) {
  const YamlValue& value = required(mapping, key);
  std::vector<double> out = numbers(value, key);
  if (out.size() < least || out.size() > most) {
    throw ConfigError(fmt::format("{}: {} has {} numbers, not {}", value.where, key, out.size(), least));
  }
  return out;
}

/// A 4×4 matrix by rows: as `data` of a mapping (EuRoC), or as a list of rows (Kalibr).
Transform transform(const YamlValue& mapping, const std::string& key) {
  const YamlValue& value = required(mapping, key);
  const bool has_data = value.kind == YamlValue::Kind::Mapping;
  const std::vector<double> m = has_data ? numbers(value, "data", 16, 16) : numbers(mapping, key, 16, 16);
  Transform T;
  T.R << m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10];
  T.p << m[3], m[7], m[11];
  if ((T.R.transpose() * T.R - Eigen::Matrix3d::Identity()).norm() > kNotRotation || T.R.determinant() < 0.0) {
    throw ConfigError(fmt::format("{}: {}: its upper left 3×3 part is no rotation", value.where, key));
  }
  T.R = Eigen::Quaterniond(T.R).normalized().toRotationMatrix();
  return T;
}

CameraModel camera_model(const YamlValue& camera, const std::string& lens_key, const std::string& coefficients_key) {
  const YamlValue& kind = required(camera, "camera_model");
  if (kind.scalar != "pinhole") {
    throw ConfigError(fmt::format("{}: camera_model: {} is not supported; pinhole is", kind.where, kind.describe()));
  }
  CameraModel model;
  const std::vector<double> size = numbers(camera, "resolution", 2, 2), f = numbers(camera, "intrinsics", 4, 4);
  model.width = static_cast<int>(std::clamp(size[0], 0.0, 1e5));
  model.height = static_cast<int>(std::clamp(size[1], 0.0, 1e5));
  if (model.width < 64 || model.height < 64 || model.width > 8192 || model.height > 8192) {
    throw ConfigError(fmt::format("{}: resolution is out of range [64, 8192]", camera.where));
  }
  model.fx = f[0], model.fy = f[1], model.cx = f[2], model.cy = f[3];
  if (!(f[0] > 0.0 && f[1] > 0.0)) throw ConfigError(fmt::format("{}: intrinsics: fx, fy must be > 0", camera.where));
  const YamlValue& lens = required(camera, lens_key);
  if (lens.scalar == "radial-tangential" || lens.scalar == "radtan") {
    model.lens = LensModel::RadialTangential;
  } else if (lens.scalar == "equidistant") {
    model.lens = LensModel::Equidistant;
  } else {
    throw ConfigError(fmt::format("{}: {}: {} is not supported; radtan, radial-tangential and equidistant are",
                                  lens.where, lens_key, lens.describe()));
  }
  std::ranges::copy(numbers(camera, coefficients_key, 4, model.lens == LensModel::Equidistant ? 4 : 5),
                    model.coefficients.begin());
  return model;
}

/// @param T_IC  from the camera to the IMU
MountedCamera mounted(const CameraModel& model, const Transform& T_IC, const Eigen::Matrix3d& R_BI) {
  return {model, R_BI * T_IC.R, R_BI * T_IC.p};
}

StereoRig rig_of(const MountedCamera& left, const MountedCamera& right, const std::string& file) {
  return value_or_throw(StereoRig::make(left, right), file + ": ");
}

}  // namespace

Eigen::Matrix3d body_from_imu(const std::string& axes) {
  std::istringstream stream(axes);
  const std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
  Eigen::Matrix3d R = Eigen::Matrix3d::Zero();
  for (std::size_t row = 0; row < words.size() && words.size() == 3; ++row) {
    for (int axis = 0; axis < 3; ++axis) {
      const char name = "xyz"[axis];
      if (words[row] == std::string{name}) R(static_cast<Eigen::Index>(row), axis) = 1.0;
      if (words[row] == std::string{'-', name}) R(static_cast<Eigen::Index>(row), axis) = -1.0;
    }
  }
  if (R.determinant() != 1.0) {
    throw ConfigError(fmt::format(
        "features.body_axes: \"{}\" does not name forward, left and up of a right-handed frame, as \"z -y x\" does",
        axes));
  }
  return R;
}

StereoCalibration read_euroc_calibration(const std::string& mav0, const Eigen::Matrix3d& R_BI) {
  const auto camera = [&](const char* name) {
    const YamlValue yaml = read_yaml_file(mav0 + "/" + name + "/sensor.yaml");
    return mounted(camera_model(yaml, "distortion_model", "distortion_coefficients"), transform(yaml, "T_BS"), R_BI);
  };
  const MountedCamera left = camera("cam0"), right = camera("cam1");
  return {rig_of(left, right, mav0)};
}

StereoCalibration read_kalibr_calibration(const std::string& file, const Eigen::Matrix3d& R_BI) {
  const YamlValue yaml = read_yaml_file(file);
  const YamlValue &left = required(yaml, "cam0"), &right = required(yaml, "cam1");
  const Transform T_IL = inverse(transform(left, "T_cam_imu")), T_IR = inverse(transform(right, "T_cam_imu"));
  const auto model = [](const YamlValue& camera) {
    return camera_model(camera, "distortion_model", "distortion_coeffs");
  };
  const double shift = left.find("timeshift_cam_imu") == nullptr ? 0.0 : numbers(left, "timeshift_cam_imu", 1, 1)[0];
  if (std::abs(shift) > 1.0) throw ConfigError(fmt::format("{}: timeshift_cam_imu is out of range [-1, 1]", file));
  return {rig_of(mounted(model(left), T_IL, R_BI), mounted(model(right), T_IR, R_BI), file), shift};
}

}  // namespace tern
