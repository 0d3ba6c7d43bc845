#include "core/base/digest.h"
#include "messages/codec.h"
#include "messages/fields.h"
#include "messages/wire.h"
#include "tern_msgs/configuration_t.hpp"

namespace tern {
namespace {

using Message = tern_msgs::configuration_t;
static_assert(Message::MAX_PROCESS_TEXT == kMaxProcessText);
static_assert(Message::MAX_BUILD_ID_TEXT == kMaxBuildIdText);
static_assert(Message::MAX_PLATFORM_TEXT == kMaxPlatformText);
static_assert(Message::MAX_YAML_TEXT == kMaxYamlText);

const wire::Layout kLayout{
    wire::Array{&Message::process_count, &Message::process, 1, kMaxProcessText},
    wire::Array{&Message::build_id_count, &Message::build_id, 0, kMaxBuildIdText},
    wire::Array{&Message::platform_count, &Message::platform, 0, kMaxPlatformText},
    wire::Array{&Message::yaml_count, &Message::yaml, 0, kMaxYamlText},
};

Message to_lcm(const ConfigurationReport& report) {
  Message m{};
  m.header = wire::to_lcm(report.header);
  m.hash = static_cast<std::int64_t>(report.hash);
  m.process = wire::to_lcm(report.process);
  m.build_id = wire::to_lcm(report.build_id);
  m.platform = wire::to_lcm(report.platform);
  m.yaml = wire::to_lcm(report.yaml);
  return m;
}

tl::expected<ConfigurationReport, Rejection> from_lcm(const Message& m) {
  wire::FieldReader read;
  ConfigurationReport report;
  report.header = read.header(m.header);
  report.process = read.text(m.process);
  report.build_id = read.text(m.build_id);
  report.platform = read.text(m.platform);
  report.yaml = read.text(m.yaml);
  report.hash = static_cast<std::uint64_t>(m.hash);
  read.consistent(report.hash == digest(report.yaml));
  return read.accept(std::move(report));
}

}  // namespace

template <>
Bytes encode(const ConfigurationReport& value) {
  return wire::encode(to_lcm(value), kLayout);
}

template <>
tl::expected<ConfigurationReport, Rejection> decode(std::span<const std::uint8_t> bytes) {
  return wire::decode(bytes, kLayout, from_lcm);
}

}  // namespace tern
