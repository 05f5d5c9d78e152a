// SPDX-License-Identifier: Apache-2.0
// The pictures of docs/window-panels.md: the panels "Dispersion" and "Spectra" beside a picture that follows them, while real X
// events drag a control point and choose another light. With the folder docs in NEPHROID_PICTURES they are written there. What they
// are to show is tested all the same. Skipped where there is no Xvfb, no xdotool or no ImageMagick.
#include "optics/dispersion.h"
#include "places.h"
#include "real_window.h"
#include "spectra_scene.h"
#include "ui/spectral/dispersion/panel.h"
#include "ui/spectral/spectra/panel.h"

namespace nephroid::ui::panel_pictures_test {

constexpr std::array<int, 2> size{1200, 720};

class PanelPictures : public test::RealWindow {
protected:
  PanelPictures() : RealWindow({"Xvfb", "xdotool", "import", "convert"}) {}
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
    spectral::settings(preset).differentials = false;
    preset.stop = {};
    preset.stop.seconds = 600;
    return preset;
  }
  test::PlayedWindow open(const std::string& file, const std::string& layout) const
  {
    return {file, {"--layout", layout, "--size", fmt::format("{}x{}", size[0], size[1])}, folder.path()};
  }
  /// How often a run was begun: what is done of a run falls back to nothing when the next takes its place.
  static int runs_begun(const test::PlayedWindow& window)
  {
    int begun = 0;
    double before = 1;
    for (const auto& state : window.states()) {
      begun += state.fraction < before;
      before = state.fraction;
    }
    return begun;
  }
  /// A picture of the window as soon as it satisfies a condition. Where pictures are asked for it is taken when the run has had some
  /// seconds more and is kept, with 256 colours, which is a fifth of its bytes.
  template <class Condition>
  image::Image taken(const test::PlayedWindow& window, const std::string& name, const std::string& what, Condition condition) const
  {
    image::Image picture;
    window.until(what, [&] { return condition(picture = window.picture(name)); });
    const char* kept = std::getenv("NEPHROID_PICTURES");
    if (!kept) return picture;
    std::this_thread::sleep_for(std::chrono::seconds(8));
    picture = window.picture(name);
    const std::string command = fmt::format("convert '{}' +dither -colors 256 'png8:{}/{}'", (folder.path() / name).string(), kept, name);
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return picture;
  }
};

/// Clicks in a window like the real one; where that was.
template <class Draw>
test::Pixel click(const std::array<double, 2>& place, test::Headless& imgui, Draw draw)
{
  const test::Pixel at = pixel(place);
  imgui.move(at[0], at[1]);
  for (const bool down : {true, false}) {
    draw();
    imgui.button(0, down);
  }
  for (int i = 0; i < 4; ++i) draw();
  return at;
}

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

/// Of the pixels of the View.
std::vector<std::array<int, 3>> colours_in(const image::Image& screen, const Canvas& canvas)
{
  std::vector<std::array<int, 3>> colours;
  for (double y = canvas.corner[1]; y < canvas.corner[1] + canvas.size[1]; ++y)
    for (double x = canvas.corner[0]; x < canvas.corner[0] + canvas.size[0]; ++x) colours.push_back(test::bytes_at(screen, x, y));
  return colours;
}

/// Of what the View shows before there is a picture, a ground and a line of text, there are a few dozen colours.
auto picture_in(const Canvas& canvas)
{
  return [&canvas](const image::Image& screen) { return count(colours_in(screen, canvas)) > 200; };
}

/// Red over blue of what the View shows, without the greys beside the picture.
double warmth(const image::Image& screen, const Canvas& canvas)
{
  double red = 0, blue = 0;
  for (const auto& colour : colours_in(screen, canvas)) {
    if (colour[0] == colour[2]) continue;
    red += colour[0];
    blue += colour[2];
  }
  return red / blue;
}

TEST_F(PanelPictures, AControlPointIsDragged)
{
  const preset::Preset preset = prism();
  const std::string file = folder.write("prism.json", preset::to_json(preset));
  std::array<test::Pixel, 2> way;
  const auto [plot, canvas] = in_window_like(size, "dispersion", file, [&](const Workspace& workspace, auto&, auto) {
    const std::vector<ControlPoint> points = sorted_points(preset.scene.materials.at("glass").dispersion);
    const ControlPoint point = points[points.size() / 2];
    way = {pixel(workspace.panel<ui::DispersionPanel>().plot().to_screen(point)),
           pixel(workspace.panel<ui::DispersionPanel>().plot().to_screen({point[0] + 20, point[1] + 0.055}))};
    return std::pair(workspace.panel<ui::DispersionPanel>().plot(), workspace.panel<ui::ViewPanel>().canvas());
  });
  test::PlayedWindow window = open(file, "dispersion");
  const auto before = strip(taken(window, "window-dispersion.png", "a picture of the run", picture_in(canvas)), plot);
  EXPECT_GT(count(before), 24u);
  window.until("some of the run is done", [&] { return window.states().back().fraction > 0; });
  window.move(way[0]);
  window.press();
  window.glide(way[0], way[1]);
  // n is no longer monotone.
  taken(window, "window-dispersion-dragged.png", "clusters that have parts on both sides of the bend",
        [&](const image::Image& picture) { return returns(strip(picture, plot)) > returns(before) + 3; });
  window.until("the picture follows", [&] { return runs_begun(window) > 1; });
  window.let_go();
  window.save();
  EXPECT_EQ(window.quit().exit_code, 0);
}

TEST_F(PanelPictures, AnotherLightIsChosen)
{
  preset::Preset preset = prism();
  preset.scene.lights.at(0).spectrum.illuminant = "F10";
  spectral::settings(preset).relight = true;
  const std::string file = folder.write("prism.json", preset::to_json(preset));
  const std::string found = "illuminant", field = "/scene/lights/0/spectrum/illuminant";
  test::Pixel search, box, other;
  const Canvas canvas =
      in_window_like<test::SeeingRuns>(size, "spectra", file, [&](const Workspace& workspace, test::Headless& imgui, auto draw) {
        const auto field_at = [&](const std::string& widget) { return workspace.panel<ui::ParametersPanel>().place_of(widget).value(); };
        search = click(field_at("search"), imgui, draw);
        ImGui::GetIO().AddInputCharactersUTF8(found.c_str());
        for (int i = 0; i < 3; ++i) draw();
        box = click(field_at(field), imgui, draw);
        other = pixel(field_at(field + ":A"));
        return workspace.panel<ui::ViewPanel>().canvas();
      });
  test::PlayedWindow window = open(file, "spectra");
  const image::Image before = taken(window, "window-spectra.png", "a picture of the run", picture_in(canvas));
  window.click(search);
  for (const char letter : found) window.key({letter});
  window.click(box);
  window.click(other);
  window.move({size[0] - 9, 9});
  taken(window, "window-spectra-relit.png", "a warmer picture",
        [&](const image::Image& picture) { return warmth(picture, canvas) > 1.2 * warmth(before, canvas); });
  EXPECT_EQ(runs_begun(window), 1) << "the same run went on";
  window.save();
  EXPECT_EQ(window.quit().exit_code, 0);
  EXPECT_EQ(preset::read_preset(file).scene.lights[0].spectrum.illuminant, "A");
}

TEST_F(PanelPictures, AnImpossibleFieldIsSaid)
{
  const std::string file = folder.write("prism.json", preset::to_json(prism()));
  const std::string wrong = "200", field = "/scene/camera/fov_deg";
  std::vector<test::Pixel> way;
  test::Pixel said;
  const Canvas canvas =
      in_window_like<test::SeeingRuns>(size, "parameters", file, [&](const Workspace& workspace, test::Headless& imgui, auto draw) {
        const auto place_of = [&](const std::string& widget) { return workspace.panel<ui::ParametersPanel>().place_of(widget).value(); };
        for (const std::string& widget : {std::string("/scene:label"), std::string("/scene/camera:label"), field})
          way.push_back(click(place_of(widget), imgui, draw));
        ImGui::GetIO().AddInputCharactersUTF8(wrong.c_str());
        draw();
        for (const bool down : {true, false}) {
          imgui.key(ImGuiKey_Enter, down);
          draw();
        }
        for (int i = 0; i < 4; ++i) draw(); // it is brought into sight
        said = pixel(place_of(field + ":problem"));
        return workspace.panel<ui::ViewPanel>().canvas();
      });
  test::PlayedWindow window = open(file, "parameters");
  window.until("a picture of the run", [&] { return picture_in(canvas)(window.picture("before.png")); });
  for (const test::Pixel& at : way) window.click(at);
  for (const char digit : wrong) window.key({digit});
  window.key("Return");
  taken(window, "window-parameters.png", "what is wrong, at the field", [&](const image::Image& picture) {
    int found = 0;
    for (int y = said[1] - 10; y < said[1] + 10; ++y)
      for (int x = said[0] - 80; x < said[0] + 80; ++x) {
        const auto colour = test::bytes_at(picture, x, y); // the letters' edges are between their red and the ground's grey
        found += colour[0] > colour[1] + 50;
      }
    return found > 50;
  });
  EXPECT_EQ(runs_begun(window), 1) << "the run goes on";
  EXPECT_EQ(window.quit().exit_code, 0);
  EXPECT_EQ(preset::read_preset(file).scene.camera.fov_deg, 34);
}

} // namespace nephroid::ui::panel_pictures_test
