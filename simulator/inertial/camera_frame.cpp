#include "simulator/inertial/camera_frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tern {
namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// Whether the segment from a to b meets the box.
bool meets(const Box& box, const Vec3& a, const Vec3& b) {
  double enter = 0.0, leave = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double along = b[axis] - a[axis];
    const double low = box.min()[axis] - a[axis], high = box.max()[axis] - a[axis];
    if (along == 0.0) {
      if (low > 0.0 || high < 0.0) return false;
      continue;
    }
    const double first = low / along, second = high / along;
    enter = std::max(enter, std::min(first, second));
    leave = std::min(leave, std::max(first, second));
  }
  return enter <= leave;
}

}  // namespace

double StereoSpec::focal_px() const { return 0.5 * width / std::tan(radians(fov_deg) / 2.0); }

Mat3 StereoSpec::camera_to_body() const {
  Mat3 level;  // columns: the camera's right, down and forward in B
  level << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return rotation_exp(Vec3(0.0, radians(pitch_down_deg), 0.0)) * level;
}

CameraFrame::CameraFrame(const StereoSpec& spec, const InertialState& body, const Vec3& rate,
                         const std::vector<Box>& boxes)
    : spec_(spec),
      focal_(spec.focal_px()),
      sin_grazing_(std::sin(radians(spec.grazing_deg))),
      body_(body),
      to_camera_((body.R * spec.camera_to_body()).transpose()),
      rate_in_world_(body.R * rate) {
  for (const Box& box : boxes) {
    if (box.exteriorDistance(body.p) <= spec.range_m) near_.push_back(box);
  }
}

std::optional<StereoPixel> CameraFrame::project(const Vec3& p_W) const {
  const Vec3 p = to_camera_ * (p_W - body_.p);
  if (p.z() <= 0.0) return std::nullopt;
  StereoPixel pixel;
  pixel.left = focal_ / p.z() * p.head<2>() + 0.5 * Eigen::Vector2d(spec_.width, spec_.height);
  const auto inside = [](double x, int size) { return x >= 0.0 && x < size; };
  if (!inside(pixel.left.x(), spec_.width) || !inside(pixel.left.y(), spec_.height)) return std::nullopt;
  pixel.disparity = focal_ * spec_.baseline_m / p.z();
  pixel.in_right = inside(pixel.left.x() - pixel.disparity, spec_.width);
  return pixel;
}

/// With x_C = R_CW (p − p_B): ẋ_C = R_CW (v − v_B − ω × (p − p_B)), and the image moves by the projection's Jacobian.
double CameraFrame::image_speed(const Vec3& p_C, const Vec3& v_W) const {
  const Vec3 from_eye = to_camera_.transpose() * p_C;
  const Vec3 moving = to_camera_ * (v_W - body_.v - rate_in_world_.cross(from_eye));
  const Eigen::Vector2d image = (moving.head<2>() - moving.z() / p_C.z() * p_C.head<2>()) / p_C.z();
  return focal_ * image.norm();
}

std::optional<StereoPixel> CameraFrame::see(const SurfacePoint& point) const {
  const Vec3 to_eye = body_.p - point.p;
  const double distance = to_eye.norm();
  if (!point.far && distance > spec_.range_m) return std::nullopt;
  if (!point.normal.isZero(0.0)) {
    const double facing = point.normal.dot(to_eye);
    const double across = point.two_sided ? std::abs(facing) : facing;
    if (across < sin_grazing_ * distance) return std::nullopt;
  }
  auto pixel = project(point.p);
  if (!pixel) return std::nullopt;
  if (image_speed(to_camera_ * -to_eye, point.v) >= spec_.blur_px_s) return std::nullopt;
  return pixel;
}

bool CameraFrame::hides(const SurfacePoint& point) const {
  if (point.far) {
    const Vec3 end = body_.p + spec_.range_m * (point.p - body_.p).normalized();
    return std::any_of(near_.begin(), near_.end(), [&](const Box& box) { return meets(box, body_.p, end); });
  }
  const Vec3 way = point.p - body_.p;
  const Vec3 end = point.p - kSkin / std::max(way.norm(), kSkin) * way;
  return std::any_of(near_.begin(), near_.end(), [&](const Box& box) { return meets(box, body_.p, end); });
}

}  // namespace tern
