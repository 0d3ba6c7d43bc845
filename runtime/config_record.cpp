#include "runtime/config_record.h"

#include "runtime/yaml_tree.h"

namespace tern {

void ConfigRecord::write(std::string& out, int indent) const {
  for (const Entry& entry : entries) {
    const std::string head = std::string(static_cast<std::size_t>(indent), ' ') + yaml_text(entry.key) + ":";
    if (const auto* text = std::get_if<std::string>(&entry.value)) {
      out += head + " " + *text + "\n";
    } else if (const auto* section = std::get_if<ConfigRecordPtr>(&entry.value)) {
      out += head + ((*section)->entries.empty() ? " {}\n" : "\n");
      (*section)->write(out, indent + 2);
    } else {
      const auto& items = std::get<std::vector<ConfigRecordPtr>>(entry.value);
      out += head + (items.empty() ? " []\n" : "\n");
      for (const ConfigRecordPtr& item : items) {
        out += std::string(static_cast<std::size_t>(indent) + 2, ' ') + (item->entries.empty() ? "- {}\n" : "-\n");
        item->write(out, indent + 4);
      }
    }
  }
}

void ConfigRecord::list(std::vector<Knob>& knobs, const std::string& above) const {
  for (const Entry& entry : entries) {
    const std::string path = above + entry.key;
    if (const auto* section = std::get_if<ConfigRecordPtr>(&entry.value)) {
      (*section)->list(knobs, path + ".");
    } else if (const auto* items = std::get_if<std::vector<ConfigRecordPtr>>(&entry.value)) {
      if (!items->empty()) items->front()->list(knobs, path + "[].");
    } else {
      knobs.push_back({path, entry.knob.fallback, entry.knob.range, entry.knob.meaning});
    }
  }
}

}  // namespace tern
