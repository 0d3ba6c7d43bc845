#include "mavlink/parameter_exchange.h"

#include <fmt/format.h>

#include <bit>

namespace tern::mavlink {
namespace {

constexpr Duration kPeriod{1'000'000}, kFirstPeriod{300'000};
constexpr std::uint8_t kInt32 = 6, kReal32 = 9;

void write(const std::string& name, double value, bool integer, const FlightStack& stack, Outbox& out) {
  const bool bytewise = integer && stack.takes_integers_bytewise();
  out.send(ParamSet{
      .param_value = bytewise ? std::bit_cast<float>(static_cast<std::int32_t>(value)) : static_cast<float>(value),
      .target_system = out.target().system,
      .target_component = out.target().component,
      .param_id = text_of<16>(name),
      .param_type = bytewise ? kInt32 : kReal32});
}

}  // namespace

void ParameterExchange::request(const std::vector<RequiredParameter>& required, const Autopilot& autopilot,
                                const Writes& writes, UTime now, Outbox& out) {
  if (!autopilot.address() || !next_.take(now, all_asked() ? kPeriod : kFirstPeriod)) return;
  ++rounds_;
  for (const RequiredParameter& r : required) {
    const auto known = autopilot.parameters().find(r.name);
    const bool read = known != autopilot.parameters().end();
    if (read && r.allows(known->second)) continue;
    if (read && writes.allowed && r.may_be_written(writes.raise_bounds)) {
      out.log(fmt::format("sets {} to {:g} (it was {:g})", r.name, r.recommended, known->second));
      originals_.try_emplace(r.name, Original{known->second, r.integer}).first->second.asked_back = false;
      write(r.name, r.recommended, r.integer, autopilot.stack(), out);
    }
    out.send(ParamRequestRead{.target_system = out.target().system,
                              .target_component = out.target().component,
                              .param_id = text_of<16>(r.name)});
  }
}

void ParameterExchange::set_back(const Autopilot& autopilot, UTime now, Outbox& out) {
  if (originals_.empty() || autopilot.armed() || !autopilot.linked(now) || !next_.take(now, kFirstPeriod)) return;
  std::erase_if(originals_, [&](const auto& entry) {
    const auto& [name, original] = entry;
    return original.asked_back && value_or(autopilot.parameters(), name, original.value) == original.value;
  });
  for (auto& [name, original] : originals_) {
    out.log(fmt::format("sets {} back to {:g}", name, original.value));
    write(name, original.value, original.integer, autopilot.stack(), out);
    original.asked_back = true;
  }
}

}  // namespace tern::mavlink
