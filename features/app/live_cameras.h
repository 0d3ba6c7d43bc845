// A live stereo pair through OpenCV's VideoCapture.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "features/gray_image.h"
#include "runtime/clock.h"

namespace tern {

struct LivePair {
  UTime at;  ///< when the left image arrived, by the process's clock; of a file: as it is played in its own time
  GrayImage left, right;
};

/// The state of the cameras.
struct LiveStatus {
  std::string trouble;       ///< in words; empty if images come
  std::int64_t skipped = 0;  ///< pairs replaced by a newer one before they were taken
};

/// Reads two devices, or one whose images are side by side, on a thread of its own: a read waits for the camera. It
/// keeps the newest pair. A camera that ends, or cannot be opened, is opened anew once a second. With two devices the
/// images are grabbed one right after the other; the cameras themselves must be synchronized by hardware.
class LiveCameras {
 public:
  /// @param left, right  number of a device, file, URL or GStreamer pipeline; right empty: side by side
  /// @pre `clock` outlives this object and is thread-safe
  LiveCameras(const Clock& clock, std::string left, std::string right);
  ~LiveCameras();
  LiveCameras(const LiveCameras&) = delete;
  LiveCameras& operator=(const LiveCameras&) = delete;

  /// Returns the newest pair, once.
  std::optional<LivePair> take();
  [[nodiscard]] LiveStatus status() const;

 private:
  void run();
  bool read(class OpenCameras& cameras);
  /// Waits. @return whether the thread goes on
  bool wait(Duration time);
  void report(const std::string& trouble);

  const Clock& clock_;
  std::string left_, right_;
  mutable std::mutex mutex_;
  std::condition_variable stopped_;
  bool stop_ = false;
  std::optional<LivePair> newest_;
  LiveStatus status_;
  std::thread thread_;  // last: it uses all others
};

}  // namespace tern
