// Conversion between numpy arrays and Tern's values. Every array is copied, so neither side can change the other's.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/base/types.h"
#include "core/splines/clamped_spline.h"

namespace tern::python {

namespace py = pybind11;
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Integers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

/// Returns an array of numbers with this shape; −1 stands for any length.
/// @throws py::value_error that names the argument and says what it is and what it should be
Doubles doubles_of(const py::handle& value, const char* name, const std::vector<py::ssize_t>& shape);
/// Returns integers, n of them. A float array is refused, because a time in µs must not be rounded.
std::vector<std::int64_t> integers_of(const py::handle& value, const char* name);

/// Returns a finite number.
double number_of(const py::handle& value, const char* name);
/// Returns three finite numbers.
Vec3 vec3_of(const py::handle& value, const char* name);
/// Returns three numbers, or one number that stands for all three; infinite ones are allowed.
Vec3 vec3_or_number(const py::handle& value, const char* name);
/// Returns 3×n finite points of an array (n, 3).
Points points_of(const py::handle& value, const char* name);
/// Returns a box of an array (2, 3): its lower and its upper corner.
Box box_of(const py::handle& value, const char* name);

Doubles array_of(const Vec3& v);         ///< (3,)
Doubles array_of(const Points& points);  ///< (n, 3)
Doubles array_of(const Box& box);        ///< (2, 3)

/// Returns an array that owns the vector's memory. Nothing is copied.
template <class T>
py::array_t<T> array_of(std::vector<T> values) {
  auto* owner = new std::vector<T>(std::move(values));
  const py::capsule memory(owner, [](void* p) { delete static_cast<std::vector<T>*>(p); });
  return py::array_t<T>(static_cast<py::ssize_t>(owner->size()), owner->data(), memory);
}

}  // namespace tern::python
