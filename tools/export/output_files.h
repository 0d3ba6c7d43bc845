// Output files that take their names only when all of them are complete.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"

namespace tern::exporting {

/// Each output is written beside its place, as "NAME.part", and renamed at the end. A file that was there before stays
/// until then, and stays for good if the export fails. No output replaces a file that is read meanwhile.
class OutputFiles {
 public:
  /// @param inputs  the files that are read
  explicit OutputFiles(std::vector<std::string> inputs) : inputs_(std::move(inputs)) {}
  /// Removes the parts that were not put into place.
  ~OutputFiles();
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;

  /// Returns the path at which an output is to be written. A link is followed. A device or a pipe is written itself.
  /// The path is empty if the output or its part is an input; then refusal() names it.
  std::filesystem::path part_of(const std::filesystem::path& path);
  /// Returns why an output was refused; "" if none was.
  [[nodiscard]] const std::string& refusal() const { return refusal_; }
  /// Gives the parts their names, in the order of these. The parts must be closed. @return the refusal, or an Error
  /// that names the first file that could not be renamed; files renamed before it stay
  Result<void> put_in_place();

 private:
  [[nodiscard]] bool is_input(const std::filesystem::path& path) const;

  std::vector<std::string> inputs_;
  std::map<std::filesystem::path, std::filesystem::path> parts_;  ///< by the output's path
  std::string refusal_;
};

}  // namespace tern::exporting
