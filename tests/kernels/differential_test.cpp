// SPDX-License-Identifier: Apache-2.0
// kernels/transport/differential.h against finite differences of the same paths in double precision, and a prism's
// angular dispersion in closed form.
#include "spectral/engine.h"
#include "tests/support/differential_reference.h"
#include "tests/support/render.h"
#include "tests/support/statistics.h"
#include "tracing/world.h"

namespace nephroid::differential_test {

using check::ball;

constexpr int steps = 24; // surfaces of a path

const char* const source = R"(#include "kernels/transport/scatter_path.h"
#include "kernels/tracing/random.h"
#include "kernels/tracing/work_item.h"

#define STEPS 24
// What each ray meets: triangle * 4 + (0: ends there, 1: reflected, 2: transmitted), and place, direction and their derivatives after that.
__kernel void follow(WORLD_ARGUMENTS, __global const float* rays, __global const int* clusters, uint2 seed, __global uint* meets,
                     __global int* lengths, __global float* states, uint count)
{
  const World world = WORLD;
  const uint i = work_item();
  if (i >= count) return;
  Path path = {vload3(2 * i, rays), vload3(2 * i + 1, rays), NEPHROID_NO_PRIMITIVE, {0}, full_throughput(), 0.0f};
  const Band band = whole_cluster(clusters[i]);
  lengths[i] = 0;
  for (int step = 0; step < STEPS; ++step) {
    const Hit hit = next_hit(&world, &path);
    if (hit.primitive == NEPHROID_NO_PRIMITIVE) return;
    const Interaction met = interaction_at(&world, hit);
    const Surface surface = met.surface;
    const float3 arriving = path.direction;
    uint event = 0;
    if (is_only_matt(&met.material))
      differential_to_surface(&path.differential, path.direction, hit.t, &surface);
    else {
      const WalkNumbers numbers = {random4(seed, 0u, i, (uint)step, 0u).x, (float2)(0.0f)};
      ScatterSample sample;
      if (!scatter_path(&world, &path, &met, &band, LOBES_ALL, numbers, &sample)) return;
      event = dot(arriving, surface.geometric) * dot(path.direction, surface.geometric) > 0.0f ? 2u : 1u;
    }
    const uint at = i * STEPS + (uint)step;
    meets[at] = hit.primitive * 4u + event;
    vstore3(surface.position, 4 * at, states);
    vstore3(path.direction, 4 * at + 1, states);
    vstore3(path.differential.position, 4 * at + 2, states);
    vstore3(path.differential.direction, 4 * at + 3, states);
    if (event == 0u) {
      lengths[i] = step + 1;
      return;
    }
  }
})";

struct Archive {
  glm::dvec3 position, direction, d_position, d_direction;
};

struct Followed {
  std::vector<Encounter> encounters;
  std::vector<Archive> states;
};

struct Lab {
  scene::Scene scene;
  photons::RunTables tables;
  tracing::World world;
  compute::Kernel kernel;
};

/// One for all tests: opening a device takes a second.
const TestKernels& kernels() {
  static const TestKernels once(source);
  return once;
}

std::unique_ptr<Lab> make_lab(const preset::Preset& preset) {
  auto lab = std::make_unique<Lab>();
  lab->scene = scene::load_scene(preset);
  const scene::Bvh bvh = scene::build_bvh(lab->scene.geometry);
  lab->tables = photons::make_lit_tables(spectral::settings(preset), lab->scene, bvh, {});
  lab->world = tracing::make_world(kernels().context(), lab->scene, bvh, lab->tables, {}, 1);
  compute::Defines defines = spectral::make_plan(preset, lab->scene, bvh).defines;
  defines["NEPHROID_DIFFERENTIALS"] = "1";
  lab->kernel = kernels().kernel("follow", defines);
  return lab;
}

/// The paths of rays, each in a cluster; those that never end are empty.
std::vector<Followed> follow(Lab& lab, const std::vector<Ray64>& rays, const std::vector<int>& clusters) {
  const compute::Context& context = lab.world.context;
  std::vector<float> numbers;
  for (const Ray64& r : rays)
    for (const glm::dvec3& v : {r.position, r.direction})
      for (int axis = 0; axis < 3; ++axis) numbers.push_back(static_cast<float>(v[axis]));
  const std::size_t all = rays.size() * steps;
  const compute::Buffer<float> in(context, "rays", std::span<const float>(numbers));
  const compute::Buffer<int> in_clusters(context, "clusters", std::span<const int>(clusters));
  compute::Buffer<std::uint32_t> meets(context, "meets", all);
  compute::Buffer<int> lengths(context, "lengths", rays.size());
  compute::Buffer<float> out(context, "states", all * 12);
  lab.world.run(lab.kernel, rays.size(), 64,
                {{"rays", in},
                 {"clusters", in_clusters},
                 {"seed", shared::uint2{1, 2}},
                 {"meets", meets},
                 {"lengths", lengths},
                 {"states", out},
                 {"count", static_cast<std::uint32_t>(rays.size())}});
  const std::vector<std::uint32_t> met = meets.read();
  const std::vector<int> length = lengths.read();
  const std::vector<float> values = out.read();
  std::vector<Followed> paths(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i)
    for (std::size_t step = 0; step < static_cast<std::size_t>(length[i]); ++step) {
      const std::size_t at = i * steps + step;
      const auto vector = [&](std::size_t k) {
        return glm::dvec3(values[12 * at + 3 * k], values[12 * at + 3 * k + 1], values[12 * at + 3 * k + 2]);
      };
      paths[i].encounters.push_back({met[at] / 4, met[at] % 4 == 2, false});
      paths[i].states.push_back({vector(0), vector(1), vector(2), vector(3)});
    }
  return paths;
}

/// A room of diffuse walls about the origin, so that every path ends, with glass and mirrors in it.
preset::Preset room() {
  preset::Preset p = empty_preset(8);
  p.scene.materials["wall"] = white();
  preset::Material& flint = p.scene.materials["flint"] = glass(1);
  flint.absorption = false;
  flint.dispersion.type = preset::Dispersion::Type::file;
  flint.dispersion.file = NEPHROID_SOURCE_DIR "/presets/materials/N-SF11.yml";
  preset::Material& crown = p.scene.materials["crown"] = flint;
  crown.dispersion.file = NEPHROID_SOURCE_DIR "/presets/materials/N-BK7.yml";
  p.scene.materials["mirror"].type = preset::Material::Type::mirror;
  p.scene.objects = {object("room", box(20, 20, 20), "wall")};
  p.scene.lights.resize(1);
  p.scene.lights[0].position = {0, 6, 0};
  spectral::settings(p).method = photons::Settings::Method::brute_force;
  return p;
}

preset::Shape prism_shape(double apex_deg) {
  preset::Shape prism;
  prism.type = preset::Shape::Type::prism;
  prism.side = prism.height = 2;
  prism.apex_deg = apex_deg;
  return prism;
}

/// Light that is reflected once inside an equilateral prism leaves it as from a plate, so this one is not.
preset::Preset prism() {
  preset::Preset p = room();
  p.scene.objects.push_back(object("prism", prism_shape(40), "flint", at({0, 0, 0}, {10, 20, 30})));
  return p;
}

preset::Preset ball_of_flint() {
  preset::Preset p = room();
  p.scene.objects.push_back(object("ball", ball(1), "flint"));
  return p;
}

preset::Preset ellipsoid() {
  preset::Preset p = ball_of_flint();
  p.scene.objects.back().transform = at({0.1, 0, 0}, {10, 20, 30});
  p.scene.objects.back().transform.scale = {1, 0.6, 1.3};
  return p;
}

preset::Preset rod(preset::Object::Normals normals) {
  preset::Preset p = room();
  preset::Shape cylinder;
  cylinder.type = preset::Shape::Type::cylinder;
  cylinder.radius = 1;
  cylinder.height = 2;
  cylinder.segments = 23; // no two facets are parallel
  p.scene.objects.push_back(object("rod", cylinder, "flint", at({0, 0, 0}, {10, 0, 20})));
  p.scene.objects.back().normals = normals;
  return p;
}
preset::Preset faceted_rod() { return rod(preset::Object::Normals::faceted); }
preset::Preset smooth_rod() { return rod(preset::Object::Normals::smooth); }

preset::Preset brilliant() {
  preset::Preset p = room();
  preset::Shape stone{.type = preset::Shape::Type::brilliant, .radius = 1};
  p.scene.objects.push_back(object("stone", stone, "flint", at({0, 0, 0}, {20, 10, 0})));
  return p;
}

/// A prism before a flat and a curved mirror.
preset::Preset mirrors() {
  preset::Preset p = prism();
  p.scene.objects.push_back(object("mirror", quad(8, 8), "mirror", at({0, -3, 0}, {10, 0, 5})));
  p.scene.objects.push_back(object("ball mirror", ball(1.5), "mirror", at({0, 3.5, 0})));
  return p;
}

/// Two curves: flint, a core of crown in it that takes its place, and a block of crown that overlaps both.
preset::Preset nested() {
  preset::Preset p = ball_of_flint();
  p.scene.objects.push_back(object("core", ball(0.5), "crown", at({0.2, 0.1, 0})));
  p.scene.objects.back().priority = 1;
  p.scene.objects.push_back(object("block", box(1, 1, 1), "crown", at({0.8, 0, 0}, {20, 30, 0})));
  return p;
}

/// From the room into the middle of it.
std::vector<Ray64> random_rays(std::size_t count, double radius) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Ray64> rays;
  while (rays.size() < count) {
    const glm::dvec3 d(uniform(random), uniform(random), uniform(random)),
        to(uniform(random), uniform(random), uniform(random));
    if (glm::length(d) > 1 || glm::length(d) < 0.1 || glm::length(to) > 1) continue;
    // Rounded as the kernel gets it, so that both follow the same ray.
    const glm::dvec3 from(glm::vec3(5.0 * glm::normalize(d)));
    rays.push_back({from, glm::dvec3(glm::vec3(glm::normalize(radius * to - from)))});
  }
  return rays;
}

double quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
}

struct DifferentialCase {
  const char* name;
  preset::Preset (*preset)();
  std::size_t surfaces; ///< a path of this many is among those tested
};

class Differential : public testing::TestWithParam<DifferentialCase> {};

/// n of every material where s is larger by ds than in the cluster.
std::vector<double> indices(const photons::RunTables& tables, int cluster, double ds) {
  const std::size_t materials = static_cast<std::size_t>(tables.scene.material_count),
                    row = static_cast<std::size_t>(cluster) * materials;
  std::vector<double> n;
  for (std::size_t m = 0; m < materials; ++m)
    n.push_back(double(tables.wavelengths.index_of_cluster[row + m]) +
                ds * double(tables.stretch.index_slope[row + m]));
  return n;
}

TEST_P(Differential, IsWhatFiniteDifferencesOfTheSamePathGive) {
  const auto lab = make_lab(GetParam().preset());
  const photons::RunTables& tables = lab->tables;
  const PathReference reference(lab->scene);
  // Of n, or of nanometres, each of which is some 10^-4 of n.
  const double h = tracing::stretch_parameter(lab->scene) == tracing::StretchParameter::index ? 1e-6 : 1e-2;
  const std::vector<Ray64> rays = random_rays(4000, 0.9);
  std::vector<int> clusters;
  for (std::size_t i = 0; i < rays.size(); ++i) clusters.push_back(static_cast<int>(i) % tables.scene.cluster_count);
  const std::vector<Followed> paths = follow(*lab, rays, clusters);

  std::vector<double> of_place, of_direction;
  std::size_t most = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    std::vector<Encounter> encounters = paths[i].encounters;
    if (encounters.size() < 2) continue;
    reference.retrace(rays[i], encounters, indices(tables, clusters[i], 0), true);
    const Ray64 above = reference.retrace(rays[i], encounters, indices(tables, clusters[i], h), false).back(),
                below = reference.retrace(rays[i], encounters, indices(tables, clusters[i], -h), false).back();
    const glm::dvec3 d_position = (above.position - below.position) / (2 * h),
                     d_direction = (above.direction - below.direction) / (2 * h);
    // Mirrors only, parallel faces (the ends of a rod), the critical angle.
    if (!std::isfinite(glm::length(d_position)) || glm::length(d_direction) < 1e-4) continue;
    const Archive& last = paths[i].states.back();
    of_place.push_back(glm::distance(last.d_position, d_position) / glm::length(d_position));
    of_direction.push_back(glm::distance(last.d_direction, d_direction) / glm::length(d_direction));
    most = std::max(most, encounters.size());
  }
  ASSERT_GT(of_place.size(), 1000u);
  EXPECT_GE(most, GetParam().surfaces);
  // Single precision follows a path to about 10^-6, which each smooth surface and each near critical angle magnifies.
  for (const auto& [what, errors] : {std::pair("place", of_place), std::pair("direction", of_direction)}) {
    RecordProperty(std::string(what) + ": paths", static_cast<int>(errors.size()));
    RecordProperty(std::string(what) + ": median relative error", std::to_string(1e6 * quantile(errors, 0.5)) + "e-6");
    RecordProperty(std::string(what) + ": 99 % below", std::to_string(1e6 * quantile(errors, 0.99)) + "e-6");
    EXPECT_LT(quantile(errors, 0.5), 2e-5) << what;
    EXPECT_LT(quantile(errors, 0.99), 5e-3) << what;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, Differential,
    testing::Values(DifferentialCase{"Prism", prism, 3}, DifferentialCase{"Ball", ball_of_flint, 3},
                    DifferentialCase{"Ellipsoid", ellipsoid, 3}, DifferentialCase{"FacetedRod", faceted_rod, 4},
                    DifferentialCase{"SmoothRod", smooth_rod, 3}, DifferentialCase{"Brilliant", brilliant, 8},
                    DifferentialCase{"Mirrors", mirrors, 5}, DifferentialCase{"NestedTwoCurves", nested, 6}),
    [](const auto& scene) { return scene.param.name; });

// A prism of apex A at minimum deviation: both refractions are alike, sin((A + d) / 2) = n sin(A / 2). There the
// deviation d does not change with the angle of incidence, so for a fixed ray too
//   dd/dn = 2 sin(A / 2) / cos((A + d) / 2) = 2 sin(A / 2) / sqrt(1 - n^2 sin^2(A / 2)).
TEST(PrismDifferential, IsTheAngularDispersionAtMinimumDeviation) {
  preset::Preset p = room();
  p.scene.objects.push_back(object("prism", prism_shape(60), "flint"));
  const auto lab = make_lab(p);
  const photons::RunTables& tables = lab->tables;
  // The prism's axis is y and its apex points to +z; light goes towards +x and is bent to -z.
  const double half_apex = std::numbers::pi / 6;
  std::vector<Ray64> rays;
  std::vector<int> clusters;
  for (int cluster = 0; cluster < tables.scene.cluster_count; cluster += 20) clusters.push_back(cluster);
  const auto flint = std::find_if(lab->scene.materials.begin(), lab->scene.materials.end(),
                                  [](const auto& m) { return m.name == "flint"; });
  const auto material = static_cast<std::size_t>(flint - lab->scene.materials.begin());
  for (const int cluster : clusters) {
    const double n = indices(tables, cluster, 0)[material];
    const double half_deviation = std::asin(n * std::sin(half_apex)) - half_apex; // upwards before, downwards after
    const glm::dvec3 direction(std::cos(half_deviation), 0, std::sin(half_deviation));
    rays.push_back({-4.0 * direction, direction});
  }
  const std::vector<Followed> paths = follow(*lab, rays, clusters);
  double worst = 0;
  int through = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Followed& path = paths[i];
    if (path.encounters.size() != 3 || !path.encounters[0].transmitted || !path.encounters[1].transmitted) continue;
    const double n = indices(tables, clusters[i], 0)[material], sine = std::sin(half_apex);
    const double dispersion = 2 * sine / std::sqrt(1 - n * n * sine * sine);
    const Archive& out = path.states[1];
    // Further down, about the axis.
    const glm::dvec3 down(out.direction.z, 0, -out.direction.x);
    worst = std::max(worst, glm::distance(out.d_direction, dispersion * down) / dispersion);
    ++through;
  }
  EXPECT_GE(through, 10); // Fresnel reflects a tenth at each face
  EXPECT_LT(worst, 1e-5);
  RecordProperty("worst relative error", std::to_string(1e6 * worst) + "e-6");
}

} // namespace nephroid::differential_test
