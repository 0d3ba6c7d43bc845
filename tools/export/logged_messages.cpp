#include "tools/export/logged_messages.h"

namespace tern::exporting {

void on_every_channel(FlightLog& log, const std::string& suffix, std::function<void(const LoggedMessage&)> use) {
  // The log returns values, but a definition describes bytes: each accepted message is encoded again.
  for_each_channel([&]<class T>(const Channel<T>& channel) {
    log.on(channel, [use, name = channel.name + suffix](const T& message, std::int64_t received_us) {
      use({name, kLcmType<T>, received_us, encode(message)});
    });
  });
}

}  // namespace tern::exporting
