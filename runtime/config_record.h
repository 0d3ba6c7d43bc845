// A record of the keys that were read: for the effective configuration, and for the tables of keys.
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace tern {

/// A key that was read, as it is documented for a user.
struct Knob {
  std::string path;      ///< "planner.search.band_m"
  std::string fallback;  ///< default as YAML, or "required"
  std::string range;     ///< "[0, 10]", "free, obstacle"; "" for flags and texts
  std::string meaning;   ///< with the unit; may be ""
};

/// A section that was read: its rendered values in the order of reading.
struct ConfigRecord {
  struct Entry;
  std::vector<Entry> entries;

  /// Appends the YAML text.
  void write(std::string& out, int indent) const;
  /// Appends the keys, with paths that begin with `above`.
  void list(std::vector<Knob>& knobs, const std::string& above) const;
};
using ConfigRecordPtr = std::shared_ptr<ConfigRecord>;
struct ConfigRecord::Entry {
  std::string key;
  std::variant<std::string, ConfigRecordPtr, std::vector<ConfigRecordPtr>> value;
  Knob knob = {};  ///< for a value that is text; list() fills in its path
};

}  // namespace tern
