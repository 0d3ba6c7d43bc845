// What was read of a configuration: for the effective text, and for those who explain its keys.
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace tern {

/// A key that was read, as a user is told of it.
struct Knob {
  std::string path;      ///< "planner.search.band_m"
  std::string fallback;  ///< its default, as YAML; "required"
  std::string range;     ///< "[0, 10]", "free, obstacle"; "" of flags and texts
  std::string meaning;   ///< with the unit; "" where its reader says none
};

/// A section, rendered, in the order of reading.
struct ConfigRecord {
  struct Entry;
  std::vector<Entry> entries;

  /// Appends the YAML text.
  void write(std::string& out, int indent) const;
  /// Appends the keys; their paths begin with `above`.
  void list(std::vector<Knob>& knobs, const std::string& above) const;
};
using ConfigRecordPtr = std::shared_ptr<ConfigRecord>;
struct ConfigRecord::Entry {
  std::string key;
  std::variant<std::string, ConfigRecordPtr, std::vector<ConfigRecordPtr>> value;
  Knob knob = {};  ///< of a value that is text; list() makes its path
};

}  // namespace tern
