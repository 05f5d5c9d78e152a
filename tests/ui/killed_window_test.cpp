// SPDX-License-Identifier: Apache-2.0
// A window that is killed in the middle of edits comes back with them: what its session had kept is there, and can be undone. Real windows,
// real X events, real kills. NEPHROID_KILLS=20 for twenty.
#include "real_window.h"

#include "base/files.h"
#include "ui/state/session.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <random>
#include <thread>

namespace nephroid::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* preset_text = R"({
  "name": "Killed", "engine": "spectral", "unit": "m",
  "scene": {
    "camera": {"position": [0, 0, 4], "target": [0, 0, 0], "up": [0, 1, 0], "fov_deg": 40, "resolution": [64, 48]},
    "materials": {"wall": {"type": "diffuse", "reflectance": 0.5}},
    "objects": [{"name": "wall", "shape": {"type": "quad", "size": [2, 1, 2]}, "material": "wall", "transform": {"rotate_deg": [90, 0, 0]}}],
    "lights": [{"type": "point", "power_w": 10, "position": [0.5, 0.5, 1]}]
  },
  "stop": {"passes": 100000}
})";

/// The window as a person has it, who keeps sessions in a folder.
class KeptWindow {
public:
  KeptWindow(const std::vector<std::string>& arguments, const fs::path& folder)
      : state_(folder / "state"), environment_(with_state(display_.environment(), state_)),
        program_(arguments, folder, folder, environment_)
  {
    until("the window is there", [&] {
      const Ended found = display_.run("xdotool", {"search", "--onlyvisible", "--name", "Nephroid"});
      id_ = found.out.substr(0, found.out.find('\n'));
      return found.exit_code == 0 && !id_.empty();
    });
  }
  /// Edits that the newest session has kept; -1 while there is none.
  int kept() const
  {
    const std::optional<ui::Session> session = newest();
    return session && session->edits ? static_cast<int>(session->edits->index) : -1;
  }
  std::optional<ui::Session> newest() const
  {
    std::optional<ui::Session> session;
    std::optional<fs::file_time_type> time;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(state_ / "nephroid/sessions", ignored)) {
      const fs::path file = entry.path() / "session.json";
      const auto written = fs::last_write_time(file, ignored);
      if (ignored || (time && written < *time)) continue;
      time = written;
      session = ui::parse_session(read_file(file), file.string());
    }
    return session;
  }
  std::string title() const { return display_.run("xdotool", {"getwindowname", id_}).out; }
  /// One edit: the camera is a notch of the wheel further away or nearer. Wheel turns within 0.6 s would be one.
  void turn_wheel() const
  {
    display_.run("xdotool", {"mousemove", "--window", id_, "300", "400", "click", "4"});
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
  }
  void kill() { program_.send(SIGKILL); }
  Ended wait() { return program_.wait(); }
  template <class Condition>
  void until(const std::string& what, Condition condition)
  {
    if (!program_.until(condition)) throw std::runtime_error("the window does not come to this: " + what);
  }

private:
  static Environment with_state(Environment environment, const fs::path& state)
  {
    environment["XDG_STATE_HOME"] = state.string();
    return environment;
  }
  fs::path state_;
  XDisplay display_;
  Environment environment_;
  Child program_;
  std::string id_;
};

class KilledWindow : public RealWindow {};

TEST_F(KilledWindow, ComesBackWithItsEdits)
{
  const char* asked = std::getenv("NEPHROID_KILLS");
  const int kills = asked ? std::atoi(asked) : 2;
  std::mt19937 random(1);
  folder.write("killed.json", preset_text);
  int kept = 0;
  std::vector<std::string> arguments{"killed.json"};
  for (int i = 0; i < kills; ++i) {
    KeptWindow window(arguments, folder.path());
    // As it was before: the first has its file, the others begin with nothing but the session.
    window.until("the session is kept", [&] { return window.kept() >= kept && window.title().find("Killed") != std::string::npos; });
    const int edits = 1 + static_cast<int>(random() % 3);
    for (int edit = 0; edit < edits; ++edit) window.turn_wheel();
    if (i % 2 == 0) window.until("an edit is kept", [&] { return window.kept() > kept; });
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 1500));
    window.kill();
    EXPECT_EQ(window.wait().signal, SIGKILL);
    const int before = kept;
    kept = window.kept();
    EXPECT_GE(kept, before) << "nothing that was kept is lost";
    EXPECT_LE(kept, before + edits);
    arguments.clear();
  }
  EXPECT_GT(kept, 0);
}

} // namespace
} // namespace nephroid::test
