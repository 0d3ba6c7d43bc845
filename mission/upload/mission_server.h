// The vehicle's side of MAVLink's mission protocol: https://mavlink.io/en/services/mission.html
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/time.h"
#include "mavlink/messages.h"
#include "mission/items.h"

namespace tern::mission {

/// Orders of a ground station.
enum class Order : std::uint8_t { Start, Pause, GoOn };

/// The process behind the server.
struct MissionTaker {
  /// Takes an uploaded mission. An empty list takes the mission away. @return "" or why it is refused
  std::function<std::string(const std::vector<Item>&)> take;
  /// Carries an order out. @return "" or why it is refused
  std::function<std::string(Order)> obey;
  /// An upload of fences begins: until take_fences() accepts them, the fences that the pilot wants are not in force.
  std::function<void()> await_fences = {};
  /// Takes uploaded fences in place of those before. An empty list takes them away. @return "" or why they are refused
  std::function<std::string(const std::vector<mavlink::MissionItemInt>&)> take_fences = {};
  /// Why fences cannot be uploaded at all; "": they can.
  std::string no_fences = "fences cannot be uploaded";
};

/// Serves uploads, downloads and orders of ground stations. Pure: frames in, frames out.
///
/// | message                                | answer                                                  |
/// |----------------------------------------|---------------------------------------------------------|
/// | MISSION_COUNT                          | MISSION_REQUEST_INT 0                                   |
/// | MISSION_ITEM_INT, the expected one     | MISSION_REQUEST_INT of the next; at the end MISSION_ACK |
/// | MISSION_ITEM_INT, another one          | MISSION_REQUEST_INT of the expected one                 |
/// | the last MISSION_ITEM_INT again        | the same MISSION_ACK: it was lost on its way            |
/// | MISSION_REQUEST_LIST                   | MISSION_COUNT                                           |
/// | MISSION_REQUEST_INT, MISSION_REQUEST   | MISSION_ITEM_INT; beyond the last item MISSION_ACK      |
/// | MISSION_CLEAR_ALL                      | MISSION_ACK                                             |
/// | COMMAND_LONG 300 MISSION_START         | COMMAND_ACK                                             |
/// | COMMAND_LONG 193 DO_PAUSE_CONTINUE     | COMMAND_ACK                                             |
/// | COMMAND_LONG 512 REQUEST_MESSAGE 148   | COMMAND_ACK, AUTOPILOT_VERSION                          |
/// | COMMAND_LONG, another command          | COMMAND_ACK: unsupported                                |
///
/// - A mission that is refused is named in STATUSTEXT, in parts of 50 bytes, before its MISSION_ACK.
/// - An expected item is requested again after kRequestAgain, and after kTries the upload is dropped.
/// - A second ground station's upload is denied while one is under way.
/// - MISSION_START starts the whole mission; a part of it is denied.
/// - Missions and fences (MAV_MISSION_TYPE 0 and 1) are uploaded, downloaded and cleared in the same way.
///   MISSION_CLEAR_ALL of all types clears both.
/// - AUTOPILOT_VERSION says whether fences are taken: QGroundControl uploads them only if it says so.
/// - Rally points are not supported: an upload of any, and a download, is refused. So are fences without a taker.
class MissionServer {
 public:
  MissionServer(mavlink::Address self, MissionTaker taker) : self_(self), taker_(std::move(taker)) {}

  /// Returns the answers to a frame.
  std::vector<mavlink::Frame> receive(const mavlink::Frame& frame, UTime now);
  /// Returns requests that are due again.
  std::vector<mavlink::Frame> step(UTime now);
  /// Sets the items that a download returns.
  void set_items(std::vector<mavlink::MissionItemInt> items) { stored_[0] = std::move(items); }
  /// Sets the fences that a download returns.
  void set_fences(std::vector<mavlink::MissionItemInt> items) { stored_[1] = std::move(items); }
  [[nodiscard]] const std::vector<mavlink::MissionItemInt>& items() const { return stored_[0]; }
  [[nodiscard]] const std::vector<mavlink::MissionItemInt>& fences() const { return stored_[1]; }
  /// Returns a text as STATUSTEXT, in parts of 50 bytes.
  std::vector<mavlink::Frame> say(const std::string& text);
  /// A message as a frame from this vehicle.
  template <class M>
  mavlink::Frame frame_of(const M& message) {
    return mavlink::to_frame(message, self_, sequence_++);
  }

 private:
  struct Upload {
    mavlink::Address peer;
    std::uint8_t type = 0;
    std::size_t count = 0;
    std::vector<mavlink::MissionItemInt> items;
    UTime asked;
    int tries = 0;
  };
  /// An upload that has ended.
  struct Ended {
    mavlink::Address peer;
    std::uint8_t type = 0;
    std::size_t count = 0;
    std::uint8_t result = 0;
  };
  using Frames = std::vector<mavlink::Frame>;
  [[nodiscard]] bool is_for_me(std::uint8_t system, std::uint8_t component) const;
  template <class M, class Handle>
  bool handle(const mavlink::Frame& frame, const Handle& with);
  void on_count(const mavlink::MissionCount& count, mavlink::Address peer, UTime now, Frames& out);
  void on_item(const mavlink::MissionItemInt& item, mavlink::Address peer, UTime now, Frames& out);
  void on_clear(std::uint8_t type, mavlink::Address peer, Frames& out);
  void on_command(const mavlink::CommandLong& command, mavlink::Address peer, Frames& out);
  [[nodiscard]] mavlink::AutopilotVersion abilities() const;
  void send_count(std::uint8_t type, mavlink::Address peer, Frames& out);
  void send_item(std::uint16_t seq, std::uint8_t type, mavlink::Address peer, Frames& out);
  void finish(mavlink::Address peer, Frames& out);
  void request(UTime now, Frames& out);
  /// Hands items of a type to the taker, and stores them if it takes them. @return "" or why they are refused
  std::string hand_over(std::uint8_t type, std::vector<mavlink::MissionItemInt> items);
  [[nodiscard]] bool is_supported(std::uint8_t type) const;
  [[nodiscard]] float last_item() const { return static_cast<float>(items().size()) - 1.0F; }
  void acknowledge(std::uint8_t result, std::uint8_t type, mavlink::Address peer, Frames& out);
  void say(const std::string& text, Frames& out);

  mavlink::Address self_;
  MissionTaker taker_;
  std::optional<Upload> upload_;
  std::optional<Ended> ended_;                                  ///< the newest one
  std::array<std::vector<mavlink::MissionItemInt>, 2> stored_;  ///< missions and fences, by MAV_MISSION_TYPE
  std::uint8_t sequence_ = 0;
  std::uint16_t text_id_ = 0;
};

/// Returns an item of the wire. Coordinates of 2³¹ − 1 are not given.
Item item_of(const mavlink::MissionItemInt& wire);

/// Returns steps as items of the wire, for a download: waypoints, and changes of speed before them. Places are relative
/// to the origin; without an origin they are in W. Followed tracks have no item.
std::vector<mavlink::MissionItemInt> items_of(const std::vector<Step>& steps, const Site& site);

/// Returns the seq of each step's item among items_of(). A followed track has that of the next item.
std::vector<std::uint16_t> seqs_of(const std::vector<Step>& steps);

inline constexpr Duration kRequestAgain{1'500'000};
inline constexpr int kTries = 5;
inline constexpr std::size_t kMaxUploadedItems = 2'000;
/// MAV_MISSION_TYPE
inline constexpr std::uint8_t kMissionType = 0, kFenceType = 1, kAllTypes = 255;

/// MAV_MISSION_RESULT.
inline constexpr std::uint8_t kAccepted = 0, kUnsupported = 3, kNoSpace = 4, kInvalid = 5, kInvalidSequence = 13,
                              kDenied = 14, kCancelled = 15;

}  // namespace tern::mission
