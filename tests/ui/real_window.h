// SPDX-License-Identifier: Apache-2.0
// The real program in a real window on a virtual display of its own, played to by real X events. Nothing waits for a
// time: after each event the window draws frames, and the file of --frame-times has a line of each as it is drawn.
#pragma once
#include "image/image.h"
#include "tests/support/x_display.h"

namespace nephroid::test {

using Pixel = std::array<int, 2>;

/// Of a screenshot.
inline std::array<int, 3> bytes_at(const image::Image& picture, double x, double y) {
  const std::size_t index =
      static_cast<std::size_t>(static_cast<int>(y) * picture.width + static_cast<int>(x)) * picture.channels.size();
  std::array<int, 3> bytes{};
  for (std::size_t c = 0; c < 3; ++c) bytes[c] = static_cast<int>(std::lround(255 * picture.data[index + c]));
  return bytes;
}

/// A window that events are played to, in pixels of the window; needs Xvfb and xdotool. Throws where a minute passes
/// before what it waits for.
class PlayedWindow {
public:
  /// Opens a preset, until its run has begun and strips and panels, which show what the run was made with, are in their
  /// places. Files are written to the folder.
  PlayedWindow(const std::string& preset, std::vector<std::string> options, const fs::path& folder)
      : folder_(folder), program_(arguments(preset, std::move(options)), folder, folder, display_.environment()) {
    until("a run has begun", [&] {
      const std::vector<State> all = states();
      return !all.empty() && all.back().name != "no run" && all.back().name != "preparing";
    });
    find();
  }

  /// The window as a person begins with it in a folder where he works; without options on its start page. It keeps
  /// sessions in folder/state and caches in folder/cache.
  PlayedWindow(std::vector<std::string> options, const fs::path& folder, const fs::path& works_in)
      : folder_(folder), program_(with_times(std::move(options), folder / "frames.csv"), works_in, folder,
                                  with_own_folders(display_.environment(), folder)) {
    find();
  }

  void move(const Pixel& to) { send({"mousemove", "--window", id_, std::to_string(to[0]), std::to_string(to[1])}); }
  /// The left button.
  void press() { send({"mousedown", "1"}); }
  void let_go() { send({"mouseup", "1"}); }
  void turn_wheel() { send({"click", "4"}); }
  void glide(const Pixel& from, const Pixel& to) {
    constexpr int moves = 4;
    for (int i = 1; i <= moves; ++i)
      move({from[0] + (to[0] - from[0]) * i / moves, from[1] + (to[1] - from[1]) * i / moves});
  }
  void drag(const Pixel& from, const Pixel& to) {
    move(from);
    press();
    glide(from, to);
    let_go();
  }
  void click(const Pixel& at) {
    move(at);
    press();
    let_go();
  }
  void key(const std::string& name) {
    send({"keydown", name});
    send({"keyup", name});
  }
  /// A key while others are held.
  void chord(const std::vector<std::string>& held, const std::string& name) {
    for (const std::string& modifier : held) send({"keydown", modifier});
    key(name);
    for (const std::string& modifier : held) send({"keyup", modifier});
  }
  void type(const std::string& text) { send({"type", "--delay", "40", text}); }
  void resize(const Pixel& size) { send({"windowsize", id_, std::to_string(size[0]), std::to_string(size[1])}); }
  /// Ctrl+S, until the title has no mark of a preset that is not saved.
  void save() {
    chord({"ctrl"}, "s");
    until("the preset is saved", [&] { return !title().starts_with("* "); });
  }
  /// Ctrl+Q; what became of the program. Its last frame is in screen.png.
  Ended quit() {
    send({"keydown", "ctrl"});
    xdotool({"keydown", "q"});
    until("it closes", [&] { return program_.gone(); });
    return program_.wait();
  }

  Ended kill() {
    program_.send(SIGKILL);
    return program_.wait();
  }

  std::string title() const { return xdotool({"getwindowname", id_}); }
  /// Of the run, when a frame was drawn.
  struct State {
    std::string name;
    double fraction = 0; ///< done
    int run = 0;         ///< how many were started
  };
  /// A frame each; at least one.
  std::vector<State> states() const {
    std::vector<State> all;
    for (const std::string& line : frames()) {
      const std::size_t fraction = line.rfind(','), name = line.rfind(',', fraction - 1),
                        run = line.rfind(',', name - 1);
      all.push_back({line.substr(name + 1, fraction - name - 1), std::stod(line.substr(fraction + 1)),
                     std::stoi(line.substr(run + 1))});
    }
    return all;
  }
  /// What the window shows now, which is written to a file, too; needs ImageMagick.
  image::Image picture(const std::string& name) const {
    run("import", {"-window", id_, "png24:" + (folder_ / name).string()});
    return image::read_image(folder_ / name);
  }
  template <class Condition>
  void until(const std::string& what, Condition condition) const {
    if (!program_.until(condition)) throw std::runtime_error("the window does not come to this: " + what);
  }

  /// Until so many frames more have been drawn: the one that was being drawn when xdotool ended, for then the X server
  /// has the event; the next, which reads it; and one more, for Dear ImGui knows a frame late what lies under the
  /// mouse.
  void settle(std::size_t more = 3) const {
    const std::size_t before = frames().size();
    until("it draws", [&] { return frames().size() >= before + more; });
  }

private:
  void find() {
    settle(5);
    const std::string found = xdotool({"search", "--onlyvisible", "--name", "Nephroid"});
    id_ = found.substr(0, found.find('\n'));
    send({"windowfocus", "--sync", id_});
  }
  static std::vector<std::string> with_times(std::vector<std::string> options, const fs::path& file) {
    fs::remove(file); // of a window before this one
    options.insert(options.end(), {"--frame-times", file.string()});
    return options;
  }
  static Environment with_own_folders(Environment environment, const fs::path& folder) {
    environment["XDG_STATE_HOME"] = (folder / "state").string();
    environment.merge(own_cache(folder / "cache"));
    return environment;
  }
  std::vector<std::string> arguments(const std::string& preset, std::vector<std::string> options) const {
    options.insert(options.begin(), preset);
    // A limit that is not reached, with which the screenshot is of the frame that closes the window.
    options.insert(options.end(), {"--frames", "1000000", "--screenshot", "screen.png", "--frame-times", "frames.csv"});
    return options;
  }
  /// The line of each frame that has been drawn.
  std::vector<std::string> frames() const {
    std::vector<std::string> lines;
    std::ifstream file(folder_ / "frames.csv");
    for (std::string line; std::getline(file, line) && !file.eof();)
      lines.push_back(line);                        // a line's end is written last
    if (!lines.empty()) lines.erase(lines.begin()); // the columns' names
    return lines;
  }
  std::string run(const std::string& program, const std::vector<std::string>& arguments) const {
    const Ended ended = display_.run(program, arguments);
    if (ended.exit_code != 0) throw std::runtime_error(fmt::format("{} {}: {}", program, arguments[0], ended.err));
    return ended.out;
  }
  std::string xdotool(const std::vector<std::string>& arguments) const { return run("xdotool", arguments); }
  void send(const std::vector<std::string>& event) const {
    xdotool(event);
    settle();
  }

  fs::path folder_;
  XDisplay display_;
  Child program_;
  std::string id_;
};

class RealWindow : public testing::Test {
protected:
  void SetUp() override {
    for (const char* tool : {"Xvfb", "xdotool"})
      if (!there_is(tool)) GTEST_SKIP() << "no " << tool;
  }
  image::Image screen() const { return image::read_image(folder.path() / "screen.png"); }

  TemporaryFolder folder;
};

/// Of which pictures are taken; ImageMagick does that.
class PicturedWindow : public RealWindow {
protected:
  void SetUp() override {
    RealWindow::SetUp();
    if (!there_is("import")) GTEST_SKIP() << "no import";
  }
};

/// With the folder docs in NEPHROID_PICTURES a picture of its pages is written there, with 256 colours: that is a fifth
/// of its bytes.
inline void keep_for_docs(const fs::path& picture) {
  const char* docs = std::getenv("NEPHROID_PICTURES");
  if (!docs) return;
  const std::string command =
      fmt::format("convert '{}' +dither -colors 256 'png8:{}/{}'", picture.string(), docs, picture.filename().string());
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
}

} // namespace nephroid::test
