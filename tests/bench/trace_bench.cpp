// SPDX-License-Identifier: Apache-2.0
// Closest hits of kernels/tracing/bvh.h against Embree's rtcIntersect1: the same rays, both in one run. Each benchmark
// times the two in turn and reports million rays a second of each and their ratio (kernel over Embree; above 1 the
// kernel is faster), and the ratio by processor time, which says more where other programs run at the same time. The
// best of all turns counts on either side, since whatever else the machine does can only slow a turn down.
// NEPHROID_BENCH_RAYS sets how many rays (default a million), NEPHROID_BENCH_KERNELS a folder to take the kernels from.
#include "tests/support/meshes.h"
#include "tests/support/tracer.h"

#include <benchmark/benchmark.h>

namespace {

using namespace nephroid;
using test::Hit;
using test::Ray;

constexpr unsigned embree_threads = 2;

compute::Context open_context() {
  const char* folder = std::getenv("NEPHROID_BENCH_KERNELS");
  return compute::Context::open({.kernels = folder ? folder : ""});
}

std::size_t ray_count() {
  const char* text = std::getenv("NEPHROID_BENCH_RAYS");
  return text ? std::strtoul(text, nullptr, 10) : 1000000;
}

/// A square picture of the mesh (which placed() put inside the unit sphere).
std::vector<Ray> primary_rays(std::size_t count) {
  const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(count)));
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < side * side; ++i) {
    const glm::vec2 p = (glm::vec2(i % side, i / side) + 0.5f) / static_cast<float>(side) * 2.0f - 1.0f;
    rays.push_back({.origin = {0, 0, 4}, .direction = glm::normalize(glm::vec3(p.x, -p.y, -4))});
  }
  return rays;
}

/// Between random points of the sphere about the mesh.
std::vector<Ray> random_rays(std::size_t count) {
  std::mt19937 random(1);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 from = test::random_direction(random), to = test::random_direction(random);
    rays.push_back({.origin = from, .direction = glm::normalize(to - from)});
  }
  return rays;
}

/// Away from where the primary rays hit, in random directions; rays that hit nothing start again from the first that
/// did.
std::vector<Ray> bounce_rays(std::size_t count, const scene::Mesh& mesh, const test::EmbreeTracer& embree) {
  std::mt19937 random(2);
  std::vector<Ray> rays;
  const std::vector<Ray> primary = primary_rays(count);
  while (rays.size() < count)
    for (const Ray& ray : primary) {
      const Hit hit = embree.closest(ray);
      if (hit.primitive == test::no_primitive) continue;
      const glm::uvec3& t = mesh.triangles[hit.primitive];
      glm::vec3 normal = glm::normalize(
          glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]));
      if (glm::dot(normal, ray.direction) > 0) normal = -normal;
      const glm::vec3 direction = glm::normalize(normal + 0.999f * test::random_direction(random));
      rays.push_back({.origin = ray.origin + hit.t * ray.direction + 1e-4f * normal, .direction = direction});
      if (rays.size() == count) break;
    }
  return rays;
}

void embree_closest(const test::EmbreeTracer& embree, const std::vector<Ray>& rays, std::vector<Hit>& hits) {
  std::vector<std::jthread> threads;
  for (unsigned part = 0; part < embree_threads; ++part)
    threads.emplace_back([&, part] {
      for (std::size_t i = rays.size() * part / embree_threads; i < rays.size() * (part + 1) / embree_threads; ++i)
        hits[i] = embree.closest(rays[i]);
    });
}

struct Seconds {
  double wall = 1e9, processor = 1e9; ///< processor: of all threads of this program together

  void keep_best(const Seconds& other) {
    wall = std::min(wall, other.wall), processor = std::min(processor, other.processor);
  }
};

template <class F>
Seconds measure(const F& f) {
  const auto start = std::chrono::steady_clock::now();
  const double processor_start = test::processor_seconds();
  f();
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
          test::processor_seconds() - processor_start};
}

enum class Rays { primary, bounce, random };

void closest_hit(benchmark::State& state, const scene::Mesh& mesh, Rays kind) {
  test::KernelTracer kernel(open_context(), mesh);
  const test::EmbreeTracer embree(mesh, RTC_SCENE_FLAG_NONE);
  const std::vector<Ray> rays = kind == Rays::primary  ? primary_rays(ray_count())
                                : kind == Rays::bounce ? bounce_rays(ray_count(), mesh, embree)
                                                       : random_rays(ray_count());
  std::vector<Hit> hits(rays.size());
  kernel.set_rays(rays);
  kernel.run_closest(); // compiles
  Seconds ours, theirs;
  for (auto _ : state) {
    const Seconds turn = measure([&] { kernel.run_closest(); });
    state.SetIterationTime(turn.wall);
    ours.keep_best(turn);
    theirs.keep_best(measure([&] { embree_closest(embree, rays, hits); }));
  }
  const double million_rays = static_cast<double>(rays.size()) * 1e-6;
  state.counters["Mrays/s"] = million_rays / ours.wall;
  state.counters["Embree"] = million_rays / theirs.wall;
  state.counters["ratio"] = theirs.wall / ours.wall;
  state.counters["ratio_cpu"] = theirs.processor / ours.processor;
}

const scene::Mesh& bunny() {
  static const scene::Mesh mesh =
      test::placed(scene::load_mesh("/usr/share/glmark2/models/bunny.obj"), 1, glm::vec3(0));
  return mesh;
}

const scene::Mesh& million() {
  static const scene::Mesh mesh = test::sphere_mesh(1000, 501);
  return mesh;
}

#define NEPHROID_BENCH(mesh, kind)                                                                                     \
  BENCHMARK_CAPTURE(closest_hit, mesh##_##kind, mesh(), Rays::kind)                                                    \
      ->UseManualTime()                                                                                                \
      ->Unit(benchmark::kMillisecond)                                                                                  \
      ->Iterations(9)
NEPHROID_BENCH(bunny, primary);
NEPHROID_BENCH(bunny, bounce);
NEPHROID_BENCH(bunny, random);
NEPHROID_BENCH(million, primary);
NEPHROID_BENCH(million, bounce);
NEPHROID_BENCH(million, random);

} // namespace
