#include "python/arrays.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace tern::python {
namespace {

std::string shape_text(const py::array& array) {
  std::vector<py::ssize_t> shape(array.shape(), array.shape() + array.ndim());
  return fmt::format("({})", fmt::join(shape, ", "));
}

std::string shape_text(const std::vector<py::ssize_t>& shape) {
  std::vector<std::string> sizes;
  for (const py::ssize_t size : shape) sizes.push_back(size < 0 ? "n" : std::to_string(size));
  return fmt::format("({}{})", fmt::join(sizes, ", "), sizes.size() == 1 ? "," : "");
}

/// Returns the value as an array of numbers: numpy makes arrays of anything else as well.
py::array numbers_of(const py::handle& value, const char* name) {
  const py::array array = py::array::ensure(value);
  if (!array) {
    PyErr_Clear();
    throw py::value_error(fmt::format("{}: is not an array of numbers", name));
  }
  const char kind = array.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u') {
    throw py::value_error(
        fmt::format("{}: dtype {} is not real numbers", name, py::str(array.dtype()).cast<std::string>()));
  }
  return array;
}

void require_finite(const Doubles& array, const char* name) {
  for (py::ssize_t k = 0; k < array.size(); ++k) {
    const double x = array.data()[k];
    if (!std::isfinite(x)) throw py::value_error(fmt::format("{}: element {} is {}", name, k, x));
  }
}

}  // namespace

Doubles doubles_of(const py::handle& value, const char* name, const std::vector<py::ssize_t>& shape) {
  const py::array array = numbers_of(value, name);
  bool fits = array.ndim() == static_cast<py::ssize_t>(shape.size());
  for (std::size_t k = 0; fits && k < shape.size(); ++k) {
    fits = shape[k] < 0 || array.shape(static_cast<py::ssize_t>(k)) == shape[k];
  }
  if (!fits) {
    throw py::value_error(fmt::format("{}: has the shape {}, not {}", name, shape_text(array), shape_text(shape)));
  }
  return Doubles(array);
}

double number_of(const py::handle& value, const char* name) {
  const Doubles array = doubles_of(value, name, {});
  require_finite(array, name);
  return array.data()[0];
}

std::vector<std::int64_t> integers_of(const py::handle& value, const char* name) {
  const py::array array = numbers_of(value, name);
  if (array.dtype().kind() == 'f' || array.ndim() != 1) {
    throw py::value_error(fmt::format("{}: dtype {} with the shape {}, not integers with the shape (n,)", name,
                                      py::str(array.dtype()).cast<std::string>(), shape_text(array)));
  }
  const Integers integers(array);
  return {integers.data(), integers.data() + integers.size()};
}

Vec3 vec3_of(const py::handle& value, const char* name) {
  const Doubles array = doubles_of(value, name, {3});
  require_finite(array, name);
  return {array.data()[0], array.data()[1], array.data()[2]};
}

Vec3 vec3_or_number(const py::handle& value, const char* name) {
  const py::array array = numbers_of(value, name);
  if (array.ndim() == 0) return Vec3::Constant(Doubles(array).data()[0]);
  const Doubles three = doubles_of(value, name, {3});
  return {three.data()[0], three.data()[1], three.data()[2]};
}

Points points_of(const py::handle& value, const char* name) {
  const Doubles array = doubles_of(value, name, {-1, 3});
  require_finite(array, name);
  return Eigen::Map<const Points>(array.data(), 3, array.shape(0));
}

Box box_of(const py::handle& value, const char* name) {
  const Doubles array = doubles_of(value, name, {2, 3});
  require_finite(array, name);
  const double* x = array.data();
  return {Vec3(x[0], x[1], x[2]), Vec3(x[3], x[4], x[5])};
}

Doubles array_of(const Vec3& v) { return Doubles(3, v.data()); }

Doubles array_of(const Points& points) { return Doubles({points.cols(), py::ssize_t{3}}, points.data()); }

Doubles array_of(const Box& box) {
  Points corners(3, 2);
  corners << box.min(), box.max();
  return array_of(corners);
}

}  // namespace tern::python
