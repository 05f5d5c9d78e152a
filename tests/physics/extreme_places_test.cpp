// SPDX-License-Identifier: Apache-2.0
// Extreme places and shapes: scenes of any size, far from the origin, tiny objects beside large ones, thin plates,
// needles, meshes that are open, doubled, inside out or inside each other. docs/notebook/extremes.md sums it up.
#include "optics/fresnel.h"
#include "spectral/settings.h"
#include "tests/support/extremes.h"
#include "tests/support/meshes.h"

namespace nephroid::extreme_places_test {

constexpr int photons = 1 << 17;

/// A glass ball over a floor with a lamp, all lengths times `size`, moved by `shift`, with the power that keeps the
/// radiance.
preset::Preset ball(double size, double shift = 0) {
  preset::Preset p = empty_preset(32);
  p.scene.materials["white"] = white(0.8);
  p.scene.materials["glass"] = glass(1.5);
  const auto place = [&](double x, double y, double z) {
    return preset::Vec3{x * size + shift, y * size - shift, z * size + shift};
  };
  p.scene.objects = {object("ball", sphere(0.5 * size), "glass", at(place(0, 0, 0))),
                     object("floor", quad(4 * size, 4 * size), "white", at(place(0, -1, 0)))};
  p.scene.objects[0].normals = preset::Object::Normals::smooth;
  p.scene.lights.resize(1);
  p.scene.lights[0].position = place(0.75, 3, 0.5);
  p.scene.lights[0].power_w = size * size;
  p.scene.camera.position = place(0, 2, 3);
  p.scene.camera.target = place(0, -1, 0);
  spectral::settings(p).direct = true;
  spectral::settings(p).pixel_samples = 4;
  p.stop.passes = 4;
  return p;
}

/// The picture of the ball is that of the ball of size 1: light knows no lengths.
Outcome same_picture(const preset::Preset& p, double tolerance) {
  const job::Snapshot truth = render(ball(1)), snapshot = render(p);
  EXPECT_EQ(photons::energy_of(snapshot).refused_contributions, 0u);
  return at_most(largest_difference(snapshot.picture->rgb, truth.picture->rgb), tolerance);
}

/// A ball over a floor as before, but only the ball is small. The far floor catches the same share as for any other
/// small ball.
preset::Preset small_ball(double radius) {
  preset::Preset p = over_floor(1 << 14);
  p.scene.materials["glass"] = glass(1.5);
  p.scene.objects.push_back(object("ball", sphere(radius), "glass"));
  p.scene.lights.resize(1);
  p.scene.lights[0].position = {0.4, 1, 0.3};
  return p;
}

/// A ball of radius 1 of a million triangles, as OBJ.
std::string write_ball(const std::filesystem::path& folder) {
  const scene::Mesh mesh = sphere_mesh(1024, 512);
  const std::filesystem::path file = folder / "ball.obj";
  std::ofstream out(file);
  for (const glm::vec3& p : mesh.positions) out << fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  for (const glm::uvec3& t : mesh.triangles) out << fmt::format("f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1);
  return file.string();
}

Outcome small_ball_is_like_any(double radius) {
  const double truth = deposited(small_ball(1e-2));
  // The same random numbers make the same paths but for the angle that the ball fills, 1e-2.
  return near(deposited(small_ball(radius)), truth, 2e-3);
}

/// Seconds a pass, the best of a few.
double seconds(const preset::Preset& p) {
  double best = INFINITY;
  for (int i = 0; i < 3; ++i) best = std::min(best, render(p).progress.work_seconds);
  return best;
}

/// A plate of 1 m under a pencil at 45 degrees, turned about z together with the pencil.
preset::Preset thin_plate(double thickness, double turn_deg) {
  preset::Preset p = over_floor(photons);
  p.source = "p.json";
  p.scene.materials["glass"] = glass(1.5);
  p.scene.objects.push_back(object("plate", box(1, thickness, 1), "glass", at({0, 0, 0}, {0, 0, turn_deg})));
  const double angle = (45 + turn_deg) * degree;
  p.scene.lights = {
      pencil({-0.2 * std::sin(angle), 0.2 * std::cos(angle), 0.01}, {std::sin(angle), -std::cos(angle), 0}, 0.01)};
  return p;
}

Outcome thin_plate_is_fresnels(double thickness, double turn_deg) {
  const double r = optics::fresnel_reflectance(std::cos(45 * degree), 1, 1.5);
  return share(deposited(thin_plate(thickness, turn_deg)), (1 - r) / (1 + r), photons);
}

/// A pencil straight down on what stands at the origin.
preset::Preset under_pencil(const preset::Object& standing) {
  preset::Preset p = over_floor(photons);
  p.source = "p.json";
  p.scene.materials["glass"] = glass(1.5);
  p.scene.objects.push_back(standing);
  p.scene.lights = {pencil({0.01, 2, 0.02}, {0, -1, 0}, 0.01)};
  return p;
}

constexpr double r15 = 0.04;
constexpr double one_plate = (1 - r15) / (1 + r15), two_plates = (1 - r15) / (1 + 3 * r15);

/// Two boxes, one standing on the other, turned about z by the angle, with a pencil along their common axis.
Outcome box_on_box(double turn_deg) {
  preset::Preset p = over_floor(photons);
  p.scene.materials["glass"] = glass(1.5);
  const double s = std::sin(turn_deg * degree), c = std::cos(turn_deg * degree);
  for (const double y : {-0.25, 0.25})
    p.scene.objects.push_back(object("", box(1, 0.5, 1), "glass", at({-y * s, y * c, 0}, {0, 0, turn_deg})));
  p.scene.lights = {pencil({-2 * s, 2 * c, 0.01}, {s, -c, 0}, 0.01)};
  const double gave = deposited(p);
  const double tolerance = sigmas * std::sqrt(one_plate * (1 - one_plate) / photons);
  // A gap of air makes two plates, no gap makes one: either is a right answer, anything else is lost light.
  Outcome outcome =
      near(gave, std::abs(gave - one_plate) < std::abs(gave - two_plates) ? one_plate : two_plates, tolerance);
  return outcome;
}

/// A mesh file of boxes: half edges, and whether its faces look inwards.
struct Box {
  double x, y, z;
  bool inwards = false;
  int inverted_face = -1;
};
std::string write_boxes(const std::filesystem::path& file, const std::vector<Box>& boxes,
                        const std::string& more = "") {
  std::ofstream obj(file);
  const int faces[12][3] = {{1, 3, 4}, {1, 4, 2}, {5, 6, 8}, {5, 8, 7}, {1, 2, 6}, {1, 6, 5},
                            {3, 7, 8}, {3, 8, 4}, {1, 5, 7}, {1, 7, 3}, {2, 4, 8}, {2, 8, 6}};
  int first = 0;
  for (const Box& b : boxes) {
    for (int i = 0; i < 8; ++i)
      obj << "v " << (i & 1 ? b.x : -b.x) << " " << (i & 2 ? b.y : -b.y) << " " << (i & 4 ? b.z : -b.z) << "\n";
    for (int i = 0; i < 12; ++i) {
      const bool inwards = b.inwards != (i == b.inverted_face);
      obj << "f " << first + faces[i][0] << " " << first + faces[i][inwards ? 2 : 1] << " "
          << first + faces[i][inwards ? 1 : 2] << "\n";
    }
    first += 8;
  }
  obj << more;
  return file.string();
}

preset::Preset mesh_under_pencil(const std::vector<Box>& boxes, const std::string& more = "") {
  static const TemporaryFolder folder;
  static int count = 0;
  preset::Object mesh;
  mesh.name = "mesh";
  mesh.material = "glass";
  mesh.mesh = write_boxes(folder.path() / fmt::format("{}.obj", count++), boxes, more);
  return under_pencil(mesh);
}

/// The warning that loading gives, and the share that gets through.
Outcome warned(const preset::Preset& p, const std::string& line, double truth) {
  const scene::Scene scene = scene::load_scene(p);
  std::string lines;
  for (const std::string& warning : scene.warnings) lines += (lines.empty() ? "" : " / ") + warning;
  return both(says(lines, line), share(deposited(p), truth, photons));
}

const std::vector<Extreme> extremes = {
    {"Millimetre", "a scene of 1 mm", "scale invariance: the picture of 1 m",
     [] { return same_picture(ball(0x1p-10), 0); }},
    {"Kilometre", "a scene of 1 km", "the same", [] { return same_picture(ball(0x1p10), 0); }},
    {"Micrometre", "a scene of 2 um", "the same", [] { return same_picture(ball(0x1p-19), 0); }},
    {"ThousandKilometres", "a scene of 1000 km", "the same", [] { return same_picture(ball(0x1p20), 0); }},
    {"UnitOfMillimetres", "the same numbers in mm, 1e-6 of the power", "the same",
     [] {
       preset::Preset p = ball(1);
       p.unit = preset::Preset::Unit::mm;
       p.scene.lights[0].power_w *= 1e-6;
       return same_picture(p, 1e-5);
     }},
    {"Far1e4", "everything moved by 1e4 scene sizes", "the same", [] { return same_picture(ball(1, 1e4), 1e-3); }},
    {"Far1e5", "moved by 1e5", "the same", [] { return same_picture(ball(1, 1e5), 1e-3); }},
    {"Far1e6", "moved by 1e6", "the same", [] { return same_picture(ball(1, 1e6), 1e-3); }},
    {"SmallBall1em3", "a ball of 1e-3 in a scene of 1", "the share of a ball of 1e-2 but for its angle",
     [] { return small_ball_is_like_any(1e-3); }},
    {"SmallBall1em5", "a ball of 1e-5", "the same", [] { return small_ball_is_like_any(1e-5); }},
    {"SmallBall1em6", "a ball of 1e-6", "the same", [] { return small_ball_is_like_any(1e-6); }},
    {"SmallBallTime", "seconds for it over seconds for a ball of 1e-2", "a small object has as many triangles",
     [] { return at_most(seconds(small_ball(1e-6)) / seconds(small_ball(1e-2)), 20); }},
    {"TooSmall", "a ball of 1e-7", "refused",
     [] {
       preset::Preset p = small_ball(1e-7);
       p.source = "p.json";
       return refused([&] { scene::load_scene(p); },
                      "p.json#/scene/objects/1: is 2e-07 units across; at least 1e-06; choose a smaller unit");
     }},
    {"ThinPlate1em3", "a plate of 1e-3 of its size, 45 degrees", "Fresnel",
     [] { return thin_plate_is_fresnels(1e-3, 0); }},
    {"ThinPlate1em5", "1e-5", "Fresnel", [] { return thin_plate_is_fresnels(1e-5, 0); }},
    {"ThinPlate1em6", "1e-6", "Fresnel", [] { return thin_plate_is_fresnels(1e-6, 0); }},
    {"ThinPlate1em7", "1e-7: less than rays are started off a surface", "refused",
     [] {
       return refused([] { scene::load_scene(thin_plate(1e-7, 0)); },
                      "p.json#/scene/objects/1: is 1e-07 units thick, too little for single precision; at least "
                      "9.54e-07 for what is 1 units "
                      "long; make it thicker or smaller");
     }},
    {"ThinPlateTurned1em4", "a plate of 1e-4, turned by 30 degrees", "Fresnel",
     [] { return thin_plate_is_fresnels(1e-4, 30); }},
    {"ThinPlateTurned1em5", "1e-5", "Fresnel", [] { return thin_plate_is_fresnels(1e-5, 30); }},
    {"ThinPlateTurned1em6", "1e-6", "Fresnel", [] { return thin_plate_is_fresnels(1e-6, 30); }},
    {"Needles", "a pencil on the vertex of 4096 needles of 2 km x 3 m", "Fresnel: a plate",
     [] {
       preset::Shape disc;
       disc.type = preset::Shape::Type::cylinder;
       disc.radius = 2000;
       disc.height = 1;
       disc.segments = 4096;
       preset::Preset p = under_pencil(object("disc", disc, "glass"));
       p.scene.lights[0].position = {0, 1, 0};
       return share(deposited(p), one_plate, photons);
     }},
    {"MillionTriangles", "a ball of a million triangles", "the exact one",
     [] {
       const TemporaryFolder folder;
       preset::Preset exact = small_ball(1);
       exact.scene.objects[1].transform.translate = {0, 0.1, 0}; // a mesh that touches the floor would be drawn in
       preset::Preset fine = exact;
       fine.scene.objects[1].shape.reset();
       fine.scene.objects[1].mesh = write_ball(folder.path());
       fine.scene.objects[1].normals = preset::Object::Normals::smooth;
       exact.scene.lights[0].position = fine.scene.lights[0].position = {0.4, 5, 0.3};
       return near(deposited(fine), deposited(exact), 1e-3);
     }},
    {"InsideOut", "a closed mesh whose triangles look inwards", "turned round: Fresnel",
     [] {
       return warned(mesh_under_pencil({{0.5, 0.5, 0.5, true}}),
                     "object 'mesh': is inside out; its triangles are turned round", one_plate);
     }},
    {"Duplicated", "a face given twice, and one without area", "dropped: Fresnel",
     [] {
       return warned(mesh_under_pencil({{0.5, 0.5, 0.5}}, "f 3 7 8\nf 3 7 7\n"),
                     "object 'mesh': 1 triangle without area dropped / object 'mesh': 1 duplicated triangle dropped",
                     one_plate);
     }},
    {"OneInverted", "one triangle of a box looks inwards, beside the light's way",
     "warned; Fresnel where the light goes",
     [] {
       return warned(mesh_under_pencil({{0.5, 0.5, 0.5, false, 8}}),
                     "object 'mesh': dielectric, but its inside is not clear: 3 edges with more than two triangles, or "
                     "with two that face "
                     "opposite ways",
                     one_plate);
     }},
    {"OpenMesh", "glass that is a single sheet", "warned; one surface: T = 1 - R",
     [] {
       return warned(
           under_pencil(object("sheet", quad(1, 1), "glass")),
           "object 'sheet': dielectric, but not closed: 4 edges with one triangle; light that enters may never leave",
           1 - r15);
     }},
    {"Cavity", "a mesh inside a mesh, looking inwards: a cavity", "Fresnel: two plates",
     [] {
       return warned(mesh_under_pencil({{0.5, 0.5, 0.5}, {0.3, 0.3, 0.3, true}}), "", two_plates);
     }},
    {"MeshInMesh", "a mesh inside a mesh, looking outwards", "the union: one plate",
     [] {
       return warned(mesh_under_pencil({{0.5, 0.5, 0.5}, {0.3, 0.3, 0.3}}), "", one_plate);
     }},
    {"BoxOnBox", "a glass box standing exactly on another", "Fresnel: one plate, or two with a gap",
     [] { return box_on_box(0); }},
    {"BoxOnBoxTurned", "the same turned by 30 degrees", "the same", [] { return box_on_box(30); }},
    {"TwoInOne", "a glass box given twice", "one plate, whichever is entered first",
     [] {
       preset::Preset p = under_pencil(object("first", box(1, 1, 1), "glass"));
       p.scene.objects.push_back(object("second", box(1, 1, 1), "glass"));
       return share(deposited(p), one_plate, photons);
     }},
    {"ThinOnFloor", "a plate of 1e-5 of its size lying exactly on the floor", "Fresnel",
     [] {
       preset::Preset p = under_pencil(object("plate", box(1, 1e-5, 1), "glass", at({0, -1 + 0.5e-5, 0})));
       return share(deposited(p), one_plate, photons);
     }},
};

class Places : public testing::TestWithParam<Extreme> {};
TEST_P(Places, AreRight) { expect_right(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Extremes, Places, testing::ValuesIn(extremes),
                         [](const auto& tested) { return tested.param.name; });

} // namespace nephroid::extreme_places_test
