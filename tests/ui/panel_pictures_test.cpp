// SPDX-License-Identifier: Apache-2.0
// The pictures of docs/window.md: the panels "Dispersion" and "Spectra and importance" beside a picture that follows them, while real X
// events drag a control point and choose another light. With the folder docs in NEPHROID_PICTURES they are written there. What they
// are to show is tested all the same. Skipped where there is no xvfb-run, no xdotool or no ImageMagick.
#include "base/files.h"
#include "image/image.h"
#include "optics/dispersion.h"
#include "places.h"
#include "preset/read.h"
#include "real_window.h"
#include "spectra_scene.h"
#include "ui/dispersion_panel.h"
#include "ui/spectra_panel.h"

#include <fmt/format.h>

#include <cstdlib>
#include <set>
#include <sstream>

namespace nephroid::ui {
namespace {

using test::in_window_like, test::pixel;

constexpr std::array<int, 2> size{1200, 720};

class PanelPictures : public test::RealWindow {
protected:
  void SetUp() override
  {
    for (const char* tool : {"xvfb-run", "xdotool", "import", "convert"})
      if (!test::there_is(tool)) GTEST_SKIP() << "no " << tool;
  }
  /// Newton's prism, of N-SF66 as control points, and a board of which one half is painted. It is not over before its pictures are taken.
  static preset::Preset prism()
  {
    preset::Preset preset = preset::read_preset(NEPHROID_SOURCE_DIR "/presets/spectral/thesis/newton.json");
    preset::Scene& scene = preset.scene;
    const optics::Spectrum n =
        optics::sample_n(optics::load_dispersion(NEPHROID_SOURCE_DIR "/presets/materials/N-SF66.yml"), optics::Outside::automatic);
    scene.materials.at("glass").dispersion = with_points({}, fit_points(n, 1e-3).points);
    // What N-SF66 bends as far as the preset's glass with 60 degrees, turned until what its base reflects misses the board.
    scene.objects.at(0).shape->apex_deg = 53;
    scene.objects.at(0).transform.rotate_deg = {-90, 0, 28};
    preset::Object painted = scene.objects.at(1);
    painted.name = painted.material = "red";
    painted.shape->size = {26, 1, 6};
    painted.transform.translate = {14.5, 0.02, 3};
    scene.objects.push_back(painted);
    scene.materials["red"] = scene.materials.at("screen");
    scene.materials["red"].reflectance = {preset::Reflectance::Type::patch, 0, "red", {}};
    scene.camera.target = {11, 0, 0};
    scene.camera.fov_deg = 34;
    scene.camera.resolution = {480, 360};
    preset.spectral.differentials = false;
    preset.stop = {};
    preset.stop.seconds = 3600;
    return preset;
  }
  /// Plays events to a window of this layout.
  void play_to(const std::string& file, const std::string& layout, const std::string& events)
  {
    const std::string options = fmt::format("--layout {} --size {}x{} --frame-times {}", layout, size[0], size[1], quoted("times.csv"));
    ASSERT_EQ(play(file, options, events), 0) << read_file(log);
  }
  /// How often a run was made ready.
  int runs_started() const
  {
    int started = 0;
    std::string before, line;
    for (std::istringstream lines(read_file(folder.path() / "times.csv")); std::getline(lines, line); before = line)
      started += before.find("preparing") == std::string::npos && line.find("preparing") != std::string::npos;
    return started;
  }
  const char* kept = std::getenv("NEPHROID_PICTURES");
  int seconds = kept ? 8 : 2; ///< that a run gets before its picture is taken

  /// A picture that was taken; kept with 256 colours, which is a fifth of its bytes, where pictures are asked for.
  image::Image taken(const std::string& name) const
  {
    if (kept) {
      const std::string command = fmt::format("convert {} +dither -colors 256 'png8:{}/{}'", quoted(name), kept, name);
      EXPECT_EQ(test::shell(command, log), 0) << read_file(log);
    }
    return image::read_image(folder.path() / name);
  }
};

/// Colours of the strip of clusters at the foot of the plot, from 380 to 780 nm.
std::vector<std::array<int, 3>> strip(const image::Image& screen, const DispersionPlot& plot)
{
  const auto left = plot.to_screen({380, 0}), right = plot.to_screen({780, 0});
  const double y = plot.area()[1] + plot.area()[3] - 4;
  std::vector<std::array<int, 3>> colours;
  for (double x = left[0]; x < right[0]; ++x) colours.push_back(test::bytes_at(screen, x, y));
  return colours;
}

std::size_t count(const std::vector<std::array<int, 3>>& colours) { return std::set(colours.begin(), colours.end()).size(); }

/// Of wavelengths that are not neighbours in one colour: how many places of a strip continue a colour that was left before.
std::size_t returns(const std::vector<std::array<int, 3>>& colours)
{
  std::set<std::array<int, 3>> left;
  std::size_t found = 0;
  for (std::size_t i = 1; i < colours.size(); ++i) {
    if (colours[i] == colours[i - 1]) continue;
    left.insert(colours[i - 1]);
    found += left.contains(colours[i]);
  }
  return found;
}

TEST_F(PanelPictures, AControlPointIsDragged)
{
  const preset::Preset preset = prism();
  const std::string file = folder.write("prism.json", preset::to_json(preset));
  std::array<std::array<int, 2>, 2> way;
  const DispersionPlot plot = in_window_like(size, "dispersion", file, [&](const Workspace& workspace, auto&, auto) {
    const std::vector<ControlPoint> points = sorted_points(preset.scene.materials.at("glass").dispersion);
    const ControlPoint point = points[points.size() / 2];
    way = {pixel(workspace.dispersion().plot().to_screen(point)),
           pixel(workspace.dispersion().plot().to_screen({point[0] + 20, point[1] + 0.055}))};
    return workspace.dispersion().plot();
  });
  play_to(file, "dispersion",
          fmt::format("sleep {}\npicture {}\nat {} {}\npress\nglide {} {} {} {}\nsleep {}\npicture {}\nlet_go\nchord s\nchord q", seconds,
                      quoted("window-dispersion.png"), way[0][0], way[0][1], way[0][0], way[0][1], way[1][0], way[1][1], seconds,
                      quoted("window-dispersion-dragged.png")));
  const auto before = strip(taken("window-dispersion.png"), plot), dragged = strip(taken("window-dispersion-dragged.png"), plot);
  EXPECT_GT(count(before), 24u);
  EXPECT_GT(runs_started(), 1) << "the picture followed";
  EXPECT_GT(returns(dragged), returns(before) + 3) << "n is no longer monotone: clusters have parts on both sides of the bend";
}

/// Red over blue of what the View shows.
double warmth(const image::Image& screen, const Canvas& canvas)
{
  double red = 0, blue = 0;
  for (double y = canvas.corner[1]; y < canvas.corner[1] + canvas.size[1]; ++y)
    for (double x = canvas.corner[0]; x < canvas.corner[0] + canvas.size[0]; ++x) {
      const auto colour = test::bytes_at(screen, x, y);
      red += colour[0];
      blue += colour[2];
    }
  return red / blue;
}

TEST_F(PanelPictures, AnotherLightIsChosen)
{
  preset::Preset preset = prism();
  preset.scene.lights.at(0).spectrum.illuminant = "F10";
  preset.spectral.relight = true;
  const std::string file = folder.write("prism.json", preset::to_json(preset));
  std::array<int, 2> box, other;
  const Canvas canvas =
      in_window_like<test::SeeingRuns>(size, "spectra", file, [&](const Workspace& workspace, test::Headless& imgui, auto draw) {
        box = pixel(workspace.spectra().place_of("illuminant").value());
        imgui.move(box[0], box[1]);
        for (const bool down : {true, false}) {
          draw();
          imgui.button(0, down);
        }
        for (int i = 0; i < 3; ++i) draw();
        other = pixel(workspace.spectra().place_of("illuminant A").value());
        return workspace.view().canvas();
      });
  play_to(file, "spectra",
          fmt::format("sleep {}\npicture {}\nclick {} {}\nclick {} {}\nat {} 9\nsleep 1\npicture {}\nchord s\nchord q", seconds,
                      quoted("window-spectra.png"), box[0], box[1], other[0], other[1], size[0] - 9, quoted("window-spectra-relit.png")));
  EXPECT_EQ(preset::read_preset(file).scene.lights[0].spectrum.illuminant, "A");
  EXPECT_EQ(runs_started(), 1) << "the same run went on";
  EXPECT_GT(warmth(taken("window-spectra-relit.png"), canvas), 1.2 * warmth(taken("window-spectra.png"), canvas));
}

} // namespace
} // namespace nephroid::ui
