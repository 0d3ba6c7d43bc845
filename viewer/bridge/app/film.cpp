#include "viewer/bridge/app/film.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "runtime/child_process.h"
#include "viewer/bridge/app/devtools.h"

namespace tern {
namespace {

namespace fs = std::filesystem;

std::string program(const char* variable, const char* usual) {
  const char* named = std::getenv(variable);
  return named != nullptr && *named != '\0' ? named : usual;
}

bool is_installed(const std::string& name) {
  const pid_t asked = start_child({.command = {"sh", "-c", "command -v \"$0\" >/dev/null", name}});
  const ProcessEnd end = await_child(asked);
  return end.signal == 0 && end.exit_code == 0;
}

/// A folder of its own, which goes with it.
struct Workplace {
  Workplace() {
    std::string name = (fs::temp_directory_path() / "tern-film-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error(name + " cannot be made");
    folder = name;
  }
  ~Workplace() {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
  fs::path folder;
};

/// ffmpeg, which reads pictures from a pipe.
class Encoder {
 public:
  explicit Encoder(const std::string& file) {
    int pictures[2];
    if (pipe2(pictures, O_CLOEXEC) != 0) throw std::runtime_error("no pipe can be made");
    to_ = pictures[1];
    const std::string rate = std::to_string(kFilmRate);
    ffmpeg_ = start_child({.command = {program("TERN_FFMPEG", "ffmpeg"), "-loglevel", "error", "-y", "-f", "image2pipe",
                                       "-framerate", rate, "-c:v", "mjpeg", "-i", fmt::format("pipe:{}", pictures[0]),
                                       "-pix_fmt", "yuv420p", "-movflags", "+faststart", file},
                           .inherited = {pictures[0]}});
    close(pictures[0]);
  }
  void add(const std::string& picture) {
    for (std::size_t done = 0; done < picture.size();) {
      const ssize_t n = write(to_, picture.data() + done, picture.size() - done);
      if (n <= 0) throw std::runtime_error("ffmpeg does not take the pictures");
      done += static_cast<std::size_t>(n);
    }
  }
  void finish() {
    close(to_);
    const ProcessEnd end = await_child(ffmpeg_);
    if (end.signal != 0 || end.exit_code != 0) throw std::runtime_error("ffmpeg failed");
  }

 private:
  int to_ = -1;
  pid_t ffmpeg_ = 0;
};

}  // namespace

Result<bool> make_film(const Film& film) try {
  const std::string chromium = program("TERN_CHROMIUM", "chromium"), ffmpeg = program("TERN_FFMPEG", "ffmpeg");
  for (const std::string& name : {chromium, ffmpeg}) {
    if (!is_installed(name)) return fail(name + " is not installed: a film needs Chromium and ffmpeg");
  }
  std::signal(SIGPIPE, SIG_IGN);
  const Workplace workplace;
  const fs::path page = workplace.folder / "flight.html";
  std::ofstream(page, std::ios::binary) << film.html;
  Devtools browser(chromium, workplace.folder / "profile", kFilmWidth, kFilmHeight);
  browser.open("file://" + page.string() + "?quality=high&theme=dark#cam=" + film.camera,
               "window.tern?.counts.drawn > 1");
  Encoder encoder(film.file);
  const int pictures = static_cast<int>(std::ceil(film.seconds * kFilmRate));
  for (int k = 0; k < pictures; ++k) {
    browser.evaluate(fmt::format("tern.film({:.4f}, {:.4f})", static_cast<double>(k) / kFilmRate, 1.0 / kFilmRate));
    encoder.add(browser.picture());
  }
  encoder.finish();
  return true;
} catch (const std::exception& e) {
  return fail(e.what());
}

}  // namespace tern
