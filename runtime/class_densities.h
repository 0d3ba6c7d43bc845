// Densities of landmarks by class of region, as a mapping of a configuration.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "runtime/config.h"

namespace tern {

/// Class of region and its density, 1/m².
using ClassDensities = std::vector<std::pair<std::string, double>>;

/// Reads class → density. Classes that the section does not name keep their default; it may name further ones.
/// @throws ConfigError for a density outside 0 … largest
ClassDensities read_class_densities(ConfigSection section, ClassDensities defaults, double largest,
                                    std::string_view meaning);

}  // namespace tern
