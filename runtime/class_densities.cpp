#include "runtime/class_densities.h"

#include <algorithm>

namespace tern {

ClassDensities read_class_densities(ConfigSection section, ClassDensities densities, double largest,
                                    std::string_view meaning) {
  const auto find = [&densities](const std::string& name) {
    return std::ranges::find_if(densities, [&](const auto& d) { return d.first == name; });
  };
  std::vector<std::string> names = section.keys();
  for (const auto& [name, density] : densities) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  for (const std::string& name : names) {
    const auto known = find(name);
    const double fallback = known == densities.end() ? 0.0 : known->second;
    const double density = section.number(name, fallback, Range::at_least(0.0, largest), meaning);
    if (known == densities.end()) {
      densities.emplace_back(name, density);
    } else {
      known->second = density;
    }
  }
  section.finish();
  return densities;
}

}  // namespace tern
