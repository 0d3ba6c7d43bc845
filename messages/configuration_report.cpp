#include "core/base/digest.h"
#include "messages/form.h"
#include "tern_msgs/configuration_t.hpp"

namespace tern {

template <>
struct wire::Form<ConfigurationReport> {
  using Message = tern_msgs::configuration_t;
  static_assert(Message::MAX_PROCESS_TEXT == kMaxProcessText);
  static_assert(Message::MAX_BUILD_ID_TEXT == kMaxBuildIdText);
  static_assert(Message::MAX_PLATFORM_TEXT == kMaxPlatformText);
  static_assert(Message::MAX_YAML_TEXT == kMaxYamlText);
  static constexpr Layout kLayout{
      Array{&Message::process_count, &Message::process, 1, kMaxProcessText},
      Array{&Message::build_id_count, &Message::build_id, 0, kMaxBuildIdText},
      Array{&Message::platform_count, &Message::platform, 0, kMaxPlatformText},
      Array{&Message::yaml_count, &Message::yaml, 0, kMaxYamlText},
  };

  static void fields(auto& io, auto& m, auto& report) {
    io.header("header", m.header, report.header);
    io.any("hash", m.hash, report.hash);
    io.text("process", m.process, report.process);
    io.text("build_id", m.build_id, report.build_id);
    io.text("platform", m.platform, report.platform);
    io.text("yaml", m.yaml, report.yaml);
  }

  static void read_rest(FieldReader& read, const Message&, ConfigurationReport& report) {
    read.consistent(report.hash == digest(report.yaml));
  }
};

template Bytes encode(const ConfigurationReport& value);
template tl::expected<ConfigurationReport, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<ConfigurationReport>(std::span<const std::uint8_t> bytes);

}  // namespace tern
