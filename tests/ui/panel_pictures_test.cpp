// SPDX-License-Identifier: Apache-2.0
// The pictures of docs/window-panels.md, docs/window-pictures.md and docs/window.md: panels beside a picture that
// follows them, while real X events drag a control point, choose another light, compare two pictures, drag a ball by
// its arrow. With the folder docs in NEPHROID_PICTURES they are written there. What they are to show is tested all the
// same. Skipped where there is no Xvfb, no xdotool or no ImageMagick.
#include "optics/dispersion.h"
#include "optics/dispersion_file.h"
#include "real_window.h"
#include "scenes.h"
#include "spectral/settings.h"
#include "ui/meters/panel.h"
#include "window_fixture.h"

namespace nephroid::ui::panel_pictures_test {

constexpr std::array<int, 2> size{1200, 720}, tall{1200, 900};

class PanelPictures : public test::PicturedWindow {
protected:
  /// Newton's prism, of N-SF66 as control points, and a board of which one half is painted. It is not over before its
  /// pictures are taken.
  static preset::Preset prism() {
    preset::Preset preset = preset::read_preset(NEPHROID_SOURCE_DIR "/presets/spectral/thesis/newton.json");
    preset::Scene& scene = preset.scene;
    const optics::Spectrum n = optics::sample_n(
        optics::load_dispersion(NEPHROID_SOURCE_DIR "/presets/materials/N-SF66.yml"), optics::Extrapolation::automatic);
    scene.materials.at("glass").dispersion = with_points({}, fit_points(n, 1e-3).points);
    // What N-SF66 bends as far as the preset's glass with 60 degrees, turned until what its base reflects misses the
    // board.
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
    preset.stop = {};
    preset.stop.seconds = 600;
    return preset;
  }
  test::PlayedWindow open(const std::string& file, const std::string& layout) const {
    return {file, {"--layout", layout, "--size", fmt::format("{}x{}", size[0], size[1])}, folder.path()};
  }
  /// How often a run was begun: what is done of a run falls back to nothing when the next takes its place.
  static int runs_begun(const test::PlayedWindow& window) {
    int begun = 0;
    double before = 1;
    for (const auto& state : window.states()) {
      begun += state.fraction < before;
      before = state.fraction;
    }
    return begun;
  }
  /// A picture of the window as soon as it satisfies a condition. Where pictures are asked for it is taken when the run
  /// has had some seconds more and is kept.
  template <class Condition>
  image::Image taken(const test::PlayedWindow& window, const std::string& name, const std::string& what,
                     Condition condition) const {
    image::Image picture;
    window.until(what, [&] { return condition(picture = window.picture(name)); });
    if (!std::getenv("NEPHROID_PICTURES")) return picture;
    std::this_thread::sleep_for(std::chrono::seconds(8));
    picture = window.picture(name);
    keep_for_docs(folder.path() / name);
    return picture;
  }
};

/// Clicks in a window like the real one; where that was.
test::Pixel click(const Point& place, test::HeadlessWindow<test::SceneRuns>& like) {
  like.click(place);
  like.frames(3);
  return pixel(place);
}

/// Colours of the strip of clusters at the foot of the plot, from 380 to 780 nm.
std::vector<std::array<int, 3>> strip(const image::Image& screen, const DispersionPlot& plot) {
  const auto left = plot.to_screen({380, 0}), right = plot.to_screen({780, 0});
  const double y = plot.area()[1] + plot.area()[3] - 4;
  std::vector<std::array<int, 3>> colours;
  for (double x = left[0]; x < right[0]; ++x) colours.push_back(test::bytes_at(screen, x, y));
  return colours;
}

std::size_t count(const std::vector<std::array<int, 3>>& colours) {
  return std::set(colours.begin(), colours.end()).size();
}

/// Of wavelengths that are not neighbours in one colour: how many places of a strip continue a colour that was left
/// before.
std::size_t returns(const std::vector<std::array<int, 3>>& colours) {
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
std::vector<std::array<int, 3>> colours_in(const image::Image& screen, const Canvas& canvas) {
  std::vector<std::array<int, 3>> colours;
  for (double y = canvas.corner[1]; y < canvas.corner[1] + canvas.size[1]; ++y)
    for (double x = canvas.corner[0]; x < canvas.corner[0] + canvas.size[0]; ++x)
      colours.push_back(test::bytes_at(screen, x, y));
  return colours;
}

/// Of what the View shows before there is a picture, a ground and a line of text, there are a few dozen colours.
auto picture_in(const Canvas& canvas) {
  return [&canvas](const image::Image& screen) { return count(colours_in(screen, canvas)) > 200; };
}

/// Red over blue of what the View shows, without the greys beside the picture.
double warmth(const image::Image& screen, const Canvas& canvas) {
  double red = 0, blue = 0;
  for (const auto& colour : colours_in(screen, canvas)) {
    if (colour[0] == colour[2]) continue;
    red += colour[0];
    blue += colour[2];
  }
  return red / blue;
}

TEST_F(PanelPictures, AControlPointIsDragged) {
  const preset::Preset preset = prism();
  const std::string file = folder.write("prism.json", preset::to_json(preset));
  const test::HeadlessWindow<> like(size, "dispersion", file);
  const DispersionPlot& plot = like.workspace.panel<DispersionPanel>().plot();
  const Canvas& canvas = like.view().canvas();
  const std::vector<ControlPoint> points = sorted_points(preset.scene.materials.at("glass").dispersion);
  const ControlPoint point = points[points.size() / 2];
  const std::array way{pixel(plot.to_screen(point)), pixel(plot.to_screen({point[0] + 20, point[1] + 0.08}))};
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

TEST_F(PanelPictures, AnotherLightIsChosen) {
  preset::Preset preset = prism();
  preset.scene.lights.at(0).spectrum.illuminant = "F10";
  spectral::settings(preset).relight = true;
  const std::string file = folder.write("prism.json", preset::to_json(preset));
  const std::string found = "illuminant", field = "/scene/lights/0/spectrum/illuminant";
  test::HeadlessWindow<test::SceneRuns> like(size, "spectra", file);
  const Canvas& canvas = like.view().canvas();
  const auto field_at = [&](const std::string& widget) {
    return like.workspace.panel<ParametersPanel>().place_of(widget).value();
  };
  const test::Pixel search = click(field_at("search"), like);
  like.type(found);
  like.frame();
  const test::Pixel box = click(field_at(field), like), other = pixel(field_at(field + ":A"));
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

TEST_F(PanelPictures, AnImpossibleFieldIsSaid) {
  const std::string file = folder.write("prism.json", preset::to_json(prism()));
  const std::string wrong = "200", field = "/scene/camera/fov_deg";
  test::HeadlessWindow<test::SceneRuns> like(size, "parameters", file);
  const Canvas& canvas = like.view().canvas();
  const auto place_of = [&](const std::string& widget) {
    return like.workspace.panel<ParametersPanel>().place_of(widget).value();
  };
  std::vector<test::Pixel> way;
  for (const std::string& widget : {std::string("/scene:label"), std::string("/scene/camera:label"), field})
    way.push_back(click(place_of(widget), like));
  like.type(wrong);
  like.press(ImGuiKey_Enter);
  like.frames(4); // it is brought into sight
  const test::Pixel said = pixel(place_of(field + ":problem"));
  test::PlayedWindow window = open(file, "parameters");
  window.until("a picture of the run", [&] { return picture_in(canvas)(window.picture("before.png")); });
  for (const test::Pixel& at : way) window.click(at);
  for (const char digit : wrong) window.key({digit});
  window.key("Return");
  taken(window, "window-parameters.png", "what is wrong, at the field", [&](const image::Image& picture) {
    int found = 0;
    for (int y = said[1] - 10; y < said[1] + 10; ++y)
      for (int x = said[0] - 80; x < said[0] + 80; ++x) {
        const auto colour =
            test::bytes_at(picture, x, y); // the letters' edges are between their red and the ground's grey
        found += colour[0] > colour[1] + 50;
      }
    return found > 50;
  });
  EXPECT_EQ(runs_begun(window), 1) << "the run goes on";
  EXPECT_EQ(window.quit().exit_code, 0);
  EXPECT_EQ(preset::read_preset(file).scene.camera.fov_deg, 34);
}

/// The picture that README.md shows, as if another program had made it, beside the run that begins; then both cut at a
/// line. The panel Runs is not in front: it names the folder of the picture.
TEST_F(PanelPictures, TwoPicturesAreCompared) {
  const std::string preset = NEPHROID_SOURCE_DIR "/presets/first-light.json",
                    png = NEPHROID_SOURCE_DIR "/docs/first-light.png";
  test::HeadlessWindow<> like(size, "", preset);
  like.apply({command::Arrange{Arrangement::split}});
  const Canvas& canvas = like.view().canvas();
  const double half = canvas.size[0] / 2;
  const Canvas left{canvas.corner, {half - 6, canvas.size[1]}},
      right{{canvas.corner[0] + half + 6, canvas.corner[1]}, left.size};
  test::PlayedWindow window(preset, {png, "--size", fmt::format("{}x{}", size[0], size[1])}, folder.path());
  window.until("a picture of the run", [&] { return picture_in(canvas)(window.picture("before.png")); });
  window.chord({"shift"}, "2");
  window.key("v");
  const auto both = [&](const image::Image& picture) {
    return picture_in(left)(picture) && picture_in(right)(picture);
  };
  window.move(
      {static_cast<int>(canvas.corner[0] + 0.7 * half), static_cast<int>(canvas.corner[1] + canvas.size[1] / 2)});
  taken(window, "window-compared.png", "both pictures side by side", both);
  window.key("c");
  const Pixel line{static_cast<int>(canvas.corner[0] + half), static_cast<int>(canvas.corner[1] + canvas.size[1] / 3)};
  window.until("both in one place", [&] { return both(window.picture("split.png")); });
  window.drag(line, {line[0] + 100, line[1]});
  window.until("both pictures cut at a line", [&] { return both(window.picture("split.png")); });
  EXPECT_EQ(window.quit().exit_code, 0);
}

constexpr double right_by = 0.8; ///< metres

/// A glass ball over a floor, seen from above its side, so that no axis is straight across the picture.
constexpr const char* scene_text = R"({
  "name": "Handles", "engine": "spectral", "unit": "m", "white": 1.5,
  "scene": {
    "camera": {"position": [1.5, 2.2, 5], "target": [0, 0.4, 0], "fov_deg": 40, "resolution": [480, 360]},
    "materials": {"glass": {"type": "dielectric", "dispersion": 1.5}, "floor": {"type": "diffuse", "reflectance": 0.8}},
    "objects": [{"name": "ball", "shape": {"type": "sphere", "radius": 0.5}, "material": "glass", "transform": {"translate": [-0.7, 0.6, 0]}},
                {"name": "floor", "shape": {"type": "quad", "size": [6, 1, 6]}, "material": "floor"}],
    "lights": [{"type": "spot", "power_w": 40, "position": [0.6, 1.7, -1], "direction": [-0.75, -1, 0.5], "half_angle_deg": 40},
               {"type": "area", "power_w": 30, "position": [-1.6, 1.5, 0.6], "direction": [0.6, -1, 0], "size": [0.5, 0.3]}]
  },
  "stop": {"passes": 1000000}
})";

TEST_F(PanelPictures, AMetalIsChosen) {
  preset::Preset preset = preset::parse_preset(scene_text, "test");
  preset.scene.materials["metal"].type = preset::Material::Type::conductor;
  preset.scene.objects[0].material = "metal";
  const std::string file = folder.write("metal.json", preset::to_json(preset));
  const std::string metal = "/scene/materials/metal";
  test::HeadlessWindow<test::SceneRuns> like(size, "parameters", file);
  const auto place_of = [&](const std::string& widget) {
    return like.workspace.panel<ParametersPanel>().place_of(widget).value();
  };
  const test::Pixel search = click(place_of("search"), like);
  like.type("materials.metal");
  ASSERT_TRUE(
      like.until([&] { return like.workspace.panel<ParametersPanel>().place_of(metal + ":picture").has_value(); }));
  const test::Pixel ball = pixel(place_of(metal + ":picture")), list = pixel(place_of(metal + "/metal:shipped"));
  test::PlayedWindow window = open(file, "parameters");
  window.click(search);
  window.type("materials.metal");
  const auto blue_part = [&](const image::Image& picture) {
    const auto colour = test::bytes_at(picture, ball[0], ball[1] + 10); // it mirrors the ground: gold .45, silver .77
    return static_cast<double>(colour[2]) / std::max(colour[0], 1);
  };
  window.until("a golden ball", [&] { return blue_part(window.picture("gold.png")) < 0.6; });
  window.click(list);
  window.type("o");
  taken(window, "window-materials.png", "a golden ball", [&](const auto& picture) { return blue_part(picture) < 0.6; });
  window.key("BackSpace");
  window.type("silv");
  window.key("Return");
  window.until("a silver ball", [&] { return blue_part(window.picture("silver.png")) > 0.7; });
  window.save();
  EXPECT_EQ(window.quit().exit_code, 0);
  EXPECT_EQ(preset::read_preset(file).scene.materials.at("metal").metal, "silver");
}

TEST_F(PanelPictures, AMetersMapLiesOnThePicture) {
  const std::string file = NEPHROID_SOURCE_DIR "/presets/measuring/concave-facade.json";
  test::HeadlessWindow<test::SceneRuns> like(tall, "meters", file);
  const Canvas canvas = like.view().canvas();
  const test::Pixel box = pixel(like.workspace.panel<MetersPanel>().place_of("on the picture").value());
  test::PlayedWindow window(file, {"--layout", "meters", "--size", fmt::format("{}x{}", tall[0], tall[1])},
                            folder.path());
  window.until("a picture of the run", [&] { return picture_in(canvas)(window.picture("before.png")); });
  window.click(box);
  window.move({9, tall[1] - 9});
  taken(window, "window-meters.png", "violet on the street", [&](const image::Image& picture) {
    return std::ranges::count_if(colours_in(picture, canvas), [](const std::array<int, 3>& colour) {
             return colour[2] > colour[1] + 40 && colour[0] > colour[1] + 15;
           }) > 2000;
  });
  EXPECT_EQ(window.quit().exit_code, 0);
}

TEST_F(PanelPictures, AnAnimationIsScrubbed) {
  const std::string file = NEPHROID_SOURCE_DIR "/presets/spectral/turning-prism.json";
  Pixel bar;
  {
    test::HeadlessWindow<test::SceneRuns> like(tall, "runs", file);
    bar = pixel(like.view().place_of("frame").value());
  }
  test::PlayedWindow window(file, {"--layout", "runs", "--size", fmt::format("{}x{}", tall[0], tall[1])},
                            folder.path());
  const image::Image before = window.picture("before.png");
  window.click(bar);
  taken(window, "window-animation.png", "another frame's picture", [&](const image::Image& picture) {
    std::size_t other = 0;
    for (std::size_t i = 0; i < picture.data.size(); ++i) other += std::abs(picture.data[i] - before.data[i]) > 0.05f;
    return other > picture.data.size() / 50;
  });
  EXPECT_EQ(window.quit().exit_code, 0);
}

class GizmoWindowTest : public test::PicturedWindow {};

TEST_F(GizmoWindowTest, AnArrowMovesABall) {
  const std::string file = folder.write("handles.json", scene_text);
  const preset::Preset before = preset::read_preset(file);
  const preset::Vec3 from = before.scene.objects[0].transform.translate;
  Pixel ball, tip, end; // of the arrow along x: where it is, and where it goes
  {
    test::HeadlessWindow<test::SceneRuns> like(tall, "", file);
    const auto& resolution = before.scene.camera.resolution;
    const Pinhole pinhole =
        *make_pinhole(before.scene.camera, place(ViewSettings{}, like.view().canvas(), resolution), resolution);
    const glm::dvec3 middle = to_vector(from);
    const Point at = *pinhole.to_screen(middle);
    like.click(at);
    like.frames(2);
    const Point arrow = like.view().overlay().gizmo().places().value()[1];
    // The tip stays under the mouse. The arrow is as long on the screen everywhere, so it shortens in the scene as it
    // comes nearer.
    const Ray ray = pinhole.ray(arrow);
    const double away = (middle.z - ray.origin.z) / ray.direction.z; // in the plane of x and y through the middle
    const glm::dvec3 there = middle + glm::dvec3(right_by, 0, 0);
    const double length = (ray.origin + away * ray.direction - middle).x * pinhole.depth(there) / pinhole.depth(middle);
    ball = pixel(at), tip = pixel(arrow), end = pixel(*pinhole.to_screen(there + glm::dvec3(length, 0, 0)));
  }
  test::PlayedWindow window(file, {"--size", fmt::format("{}x{}", tall[0], tall[1])}, folder.path());
  window.click(ball);
  window.move(tip);
  window.press();
  window.glide(tip, end);
  window.until("the picture follows while the ball is held", [&] {
    const image::Image picture = window.picture("held.png");
    const auto green = [&](const Pixel& at) { return test::bytes_at(picture, at[0], at[1])[1]; };
    return green({ball[0], ball[1] + 150}) > 40 &&
           green({ball[0] - 20, ball[1] - 55}) < 20; // the floor is lit; where it was it is dark
  });
  if (std::getenv("NEPHROID_PICTURES")) {
    std::this_thread::sleep_for(std::chrono::seconds(4)); // until it is where the hand is
    window.picture("window-handles.png");
    keep_for_docs(folder.path() / "window-handles.png");
  }
  window.let_go();
  window.save();
  const test::Ended ended = window.quit();
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const preset::Preset after = preset::read_preset(file);
  const preset::Vec3 to = after.scene.objects[0].transform.translate;
  EXPECT_NEAR(to[0] - from[0], right_by, 0.02 * right_by);
  EXPECT_EQ(to[1], from[1]);
  EXPECT_EQ(to[2], from[2]);
  EXPECT_EQ(after.scene.camera, before.scene.camera) << "nothing orbited";
}

} // namespace nephroid::ui::panel_pictures_test
