// One line of CSV or one feature of GeoJSON, and its steps.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "mission/step_list.h"

namespace tern::mission {

/// The values of a line or a feature.
struct Entry {
  int item = 0;  ///< its number in the file
  std::string name, action;
  std::optional<Vec3> place;             ///< W, m; of `follow` the offset from the track
  std::optional<double> hold_s, radius;  ///< s, m
  std::optional<double> speed;           ///< m/s
  std::optional<std::int64_t> track;
};

/// Adds the steps of an entry. An Error says which value is missing, out of range or without a meaning for the action.
Result<void> add_entry(const Entry& entry, StepList& steps);

/// Returns a place of three coordinates in W. `geodetic`: latitude, longitude, height above the origin; else x, y, z.
Result<Vec3> place_of(bool geodetic, double a, double b, double c, const Site& site);

}  // namespace tern::mission
