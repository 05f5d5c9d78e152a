// SPDX-License-Identifier: Apache-2.0
#include "photons/relight/layer_film.h"

#include "base/counted.h"
#include "photons/clusters/scene_clusters.h"
#include "photons/energy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace nephroid::photons {
namespace {

/// How often a pixel sees a reflector; its own samples outweigh those of all its neighbours together.
struct ReflectorCount {
  int reflector = 0, count = 0;
};

void add_samples(const ReflectorSurvey& survey, int x, int y, int weight, std::vector<ReflectorCount>& list) {
  const std::size_t pixel =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(survey.width) + static_cast<std::size_t>(x);
  const auto samples = static_cast<std::size_t>(survey.samples);
  for (const int reflector : survey.seen.subspan(pixel * samples, samples)) {
    if (reflector < 0) continue;
    const auto seen = std::ranges::find_if(list, [&](const ReflectorCount& s) { return s.reflector == reflector; });
    if (seen == list.end())
      list.push_back({reflector, weight});
    else
      seen->count += weight;
  }
}

/// The weight of a pixel's own sample; a neighbour's sample has 1.
int own_weight(const ReflectorSurvey& survey) { return 1 + 8 * survey.samples; }

/// Lists what a pixel sees, by falling count; of equal ones the smaller number first.
void count_reflectors(const ReflectorSurvey& survey, int x, int y, std::vector<ReflectorCount>& list) {
  list.clear();
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      if (x + dx >= 0 && x + dx < survey.width && y + dy >= 0 && y + dy < survey.height)
        add_samples(survey, x + dx, y + dy, dx == 0 && dy == 0 ? own_weight(survey) : 1, list);
  std::ranges::sort(list, [](const ReflectorCount& a, const ReflectorCount& b) {
    return a.count != b.count ? a.count > b.count : a.reflector < b.reflector;
  });
}

constexpr std::size_t spare_cells = 8192; // small pictures may have edges everywhere

std::size_t pixel_count(const shared::DeviceCamera& camera) {
  return static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
}

/// Numbers the cells reflector by reflector.
void number_cells(int reflector_count, LayerCells& result) {
  std::vector<int> next(static_cast<std::size_t>(reflector_count) + 1, 0);
  for (const shared::LayerCell& cell : result.cells) ++next[static_cast<std::size_t>(cell.reflector) + 1];
  for (int r = 0; r < reflector_count; ++r) {
    const int blocks = (next[static_cast<std::size_t>(r) + 1] + LAYER_BLOCK - 1) / LAYER_BLOCK;
    result.reflector_of_block.insert(result.reflector_of_block.end(), static_cast<std::size_t>(blocks), r);
    next[static_cast<std::size_t>(r) + 1] = next[static_cast<std::size_t>(r)] + blocks * LAYER_BLOCK;
  }
  for (shared::LayerCell& cell : result.cells) cell.cell = next[static_cast<std::size_t>(cell.reflector)]++;
}

/// factors(half, layer) gives what a layer's colours are multiplied by in the two pictures.
template <class Factors>
LayerFilmWeights make_weights(std::span<const std::array<double, 3>> colours, int reflectors, std::size_t halves,
                              Factors factors) {
  const auto r_count = static_cast<std::size_t>(reflectors);
  const std::size_t layers = r_count > 0 ? colours.size() / r_count : 0;
  std::vector<std::array<double, 6>> exact;
  exact.reserve(r_count * halves * layers);
  double largest = 0;
  for (std::size_t r = 0; r < r_count; ++r)
    for (std::size_t half = 0; half < halves; ++half)
      for (std::size_t layer = 0; layer < layers; ++layer) {
        const auto [first, second] = factors(half, layer);
        const std::array<double, 3>& c = colours[layer * r_count + r];
        exact.push_back({c[0] * first, c[1] * first, c[2] * first, c[0] * second, c[1] * second, c[2] * second});
        for (const double value : exact.back()) largest = std::max(largest, std::abs(value));
      }
  LayerFilmWeights weights{{}, largest > 0 ? std::ilogb(largest) : 0};
  weights.weights.reserve(exact.size());
  const auto number = [&](double value) { return static_cast<float>(std::ldexp(value, -weights.exponent)); };
  for (const std::array<double, 6>& v : exact)
    weights.weights.push_back({{number(v[0]), number(v[1]), number(v[2])}, {number(v[3]), number(v[4]), number(v[5])}});
  return weights;
}

PlanPart plan_relighting(const PlanInput& input) {
  if (!input.settings.relight) return {};
  const std::size_t lights = input.tables.lights.size(), clusters = input.tables.wavelengths.clusters.size();
  const std::string split =
      input.tables.wavelengths.takes_light
          ? fmt::format("; in a cluster, what a material leaves of two wavelengths differs by at most {}",
                        largest_loss_difference)
          : "";
  return {.decisions =
              {{"relighting", true,
                fmt::format(
                    "{} of {} in {} are kept apart, so that spectra and powers can change; dark ones too, for which "
                    "half of the photons go to every cluster alike{}",
                    counted(lights * clusters, "layer"), counted(lights, "light"),
                    counted(clusters, "wavelength cluster"), split),
                "/spectral/relight", true}},
          .buffers = {{"survey and weighing", input.pixels() * SURVEY_PLACES * (1 + SURVEY_PATHS) * sizeof(int)}}};
}

} // namespace

LayerCells make_layer_cells(const ReflectorSurvey& survey, std::size_t most, EmptyPixel unseen) {
  const std::size_t pixels = static_cast<std::size_t>(survey.width) * static_cast<std::size_t>(survey.height);
  std::vector<std::vector<ReflectorCount>> seen(pixels);
  std::size_t longest = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    std::vector<ReflectorCount> list;
    count_reflectors(survey, static_cast<int>(i) % survey.width, static_cast<int>(i) / survey.width, list);
    if (list.empty() && unseen == EmptyPixel::a_cell && survey.reflector_count > 0)
      list.push_back({i > 0 ? seen[i - 1][0].reflector : 0, 0});
    longest = std::max(longest, list.size());
    seen[i] = std::move(list);
  }
  // Every pixel gets its first reflector before any gets its second, and its own before those of its neighbours.
  std::vector<std::size_t> kept(pixels, 0);
  std::size_t left = most;
  for (const int fewest : {own_weight(survey), 0})
    for (std::size_t rank = 0; rank < longest && left > 0; ++rank)
      for (std::size_t i = 0; i < pixels && left > 0; ++i)
        if (kept[i] == rank && seen[i].size() > rank && seen[i][rank].count >= fewest) ++kept[i], --left;

  LayerCells result;
  for (std::size_t i = 0; i < pixels; ++i) {
    result.first.push_back(static_cast<int>(result.cells.size()));
    for (std::size_t k = 0; k < kept[i]; ++k) result.cells.push_back({seen[i][k].reflector, 0});
  }
  result.first.push_back(static_cast<int>(result.cells.size()));
  number_cells(survey.reflector_count, result);
  return result;
}

std::size_t padded_cells(std::size_t cells, int reflector_count) {
  // Each reflector leaves at most one block partly filled.
  const std::size_t blocks = cells / LAYER_BLOCK + static_cast<std::size_t>(std::max(reflector_count, 1));
  return LAYER_BLOCK * blocks;
}

std::size_t unbent_cells(const shared::DeviceCamera& camera) {
  const std::size_t pixels = pixel_count(camera);
  return pixels + pixels / 4 + spare_cells;
}

std::size_t bent_cells(const shared::DeviceCamera& camera, std::span<const scene::Sphere> spheres) {
  const auto vec = [](const shared::float4& v) { return glm::vec3(v.x, v.y, v.z); };
  const glm::vec3 position = vec(camera.position), right = vec(camera.right), up = vec(camera.up),
                  forward = vec(camera.forward);
  const auto width = static_cast<float>(camera.width), height = static_cast<float>(camera.height);
  const std::size_t pixels = pixel_count(camera);
  // Cells go to neighbours too, and places are anywhere in a pixel: about two pixels beyond a sphere.
  const float margin = 6 * std::max(camera.tan_x / width, camera.tan_y / height);
  const auto may_see = [&](const glm::vec3& way, const scene::Sphere& sphere) {
    const glm::vec3 to = sphere.centre - position;
    const float depth = glm::dot(to, forward), reach = sphere.radius + margin * depth;
    if (depth <= sphere.radius) return depth > -sphere.radius; // beside the camera or about it
    const glm::vec3 aside = glm::cross(to, way);
    return glm::dot(aside, aside) <= reach * reach;
  };
  std::size_t bent = camera.inside.latest != 0 ? pixels : 0;
  for (int pixel = 0; bent < pixels && pixel < camera.width * camera.height; ++pixel) {
    const int column = pixel % camera.width, row = pixel / camera.width;
    const float x = 2 * (static_cast<float>(column) + 0.5f) / width - 1,
                y = 1 - 2 * (static_cast<float>(row) + 0.5f) / height;
    const glm::vec3 way = glm::normalize(forward + x * camera.tan_x * right + y * camera.tan_y * up);
    if (std::ranges::any_of(spheres, [&](const scene::Sphere& sphere) { return may_see(way, sphere); })) ++bent;
  }
  return bent > 0 ? 2 * bent + spare_cells : 0;
}

static_assert(sizeof(LayerWeight) == 6 * sizeof(float), "the weights as kernels/photons/relight_weigh.cl reads them");

LayerFilm::LayerFilm(const mpi::RankContext& context, const std::string& name, const LayerCells& cells,
                     std::size_t layers, std::size_t halves, const compute::Defines& defines)
    : context_(context), layers_(layers), halves_(halves), pixels_(cells.first.size() - 1), cell_count_(cells.count()),
      first_(context, name + ": cells of each pixel", cells.first),
      reflector_of_block_(context, name + ": reflectors", cells.reflector_of_block),
      cells_(context, name + ": cells", cells.cells), sums_(context, name, halves * layers * cell_count_),
      weighed_(context, name + ": weighed", 6 * cell_count_), pictures_(context, name + ": pictures", 6 * pixels_) {
  const compute::Program program(context, "photons/relight_weigh.cl", defines);
  weigh_ = program.kernel("weigh");
  gather_ = program.kernel("gather_cells");
  sums_.fill_zero();
}

std::array<std::vector<float>, 2> LayerFilm::weigh(const LayerFilmWeights& by) {
  std::array<std::vector<float>, 2> pictures;
  for (std::vector<float>& picture : pictures) picture.resize(3 * pixels_);
  if (cell_count_ == 0) return pictures;
  const std::span<const float> numbers(by.weights.front().first.data(), 6 * by.weights.size());
  if (weights_.size() == numbers.size())
    weights_.write(numbers);
  else
    weights_ = compute::Buffer<float>(context_, "weights of layers", numbers);
  const Communicator& communicator = context_.communicator();
  if (!communicator.is_alone()) sums_.write(context_.all_reduced_sum(sums_));
  weigh_.run(cell_count_ / 8, 64,
             {{"sums", sums_},
              {"block_count", static_cast<int>(cell_count_ / LAYER_BLOCK)},
              {"rows", static_cast<int>(halves_ * layers_)},
              {"reflector_of_block", reflector_of_block_},
              {"weights", weights_},
              {"weighed", weighed_}});
  gather_.run(pixels_, 64,
              {{"first", first_},
               {"cells", cells_},
               {"weighed", weighed_},
               {"pixel_count", static_cast<int>(pixels_)},
               {"pictures", pictures_}});
  if (!communicator.is_root()) sums_.fill_zero(); // rank 0 has the sums
  const std::size_t bytes = 3 * pixels_ * sizeof(float);
  pictures_.RawBuffer::read(pictures[0].data(), bytes, 0);
  pictures_.RawBuffer::read(pictures[1].data(), bytes, bytes);
  const double unit = std::ldexp(1.0, by.exponent);
  for (std::vector<float>& picture : pictures)
    for (float& value : picture) value = static_cast<float>(value * unit);
  return pictures;
}

std::vector<LayerSums> LayerFilm::pixel(std::size_t index) const {
  std::vector<LayerSums> cells;
  std::array<int, 2> range{};
  first_.RawBuffer::read(range.data(), sizeof(range), index * sizeof(int));
  for (int i = range[0]; i < range[1]; ++i) {
    shared::LayerCell cell{};
    cells_.RawBuffer::read(&cell, sizeof(cell), static_cast<std::size_t>(i) * sizeof(cell));
    const auto number = static_cast<std::size_t>(cell.cell);
    std::vector<std::int64_t> block(halves_ * layers_ * LAYER_BLOCK);
    const std::size_t bytes = block.size() * sizeof(std::int64_t);
    sums_.RawBuffer::read(block.data(), bytes, number / LAYER_BLOCK * bytes);
    LayerSums sums{cell.reflector, {}};
    for (std::size_t row = 0; row < halves_ * layers_; ++row)
      sums.sums.push_back(static_cast<double>(block[row * LAYER_BLOCK + number % LAYER_BLOCK]));
    cells.push_back(std::move(sums));
  }
  return cells;
}

LayerFilmWeights mean_and_draw(std::span<const std::array<double, 3>> colours, std::span<const HalfCounts> counts,
                               int reflectors, std::size_t halves, double quanta_per_unit) {
  return make_weights(colours, reflectors, halves, [&](std::size_t half, std::size_t layer) -> std::array<double, 2> {
    const auto [a, b] = counts[layer];
    if (a + b <= 0) return {0, 0};
    const double mean = 1 / ((a + b) * quanta_per_unit);
    if (a <= 0 || b <= 0) return {mean, 0};
    // The draw is (A / a - B / b) sqrt(a b) / (a + b), with the sums A and B.
    return {mean, half == 0 ? mean * std::sqrt(b / a) : -mean * std::sqrt(a / b)};
  });
}

LayerFilmWeights half_sums(std::span<const std::array<double, 3>> colours, int reflectors, std::size_t halves,
                           double quanta_per_unit) {
  return make_weights(colours, reflectors, halves, [&](std::size_t half, std::size_t) -> std::array<double, 2> {
    return half == 0 ? std::array{1 / quanta_per_unit, 0.0} : std::array{0.0, 1 / quanta_per_unit};
  });
}

const RunPart relighting_part{plan_relighting};

void plan_layer_film(const char* name, std::size_t layers, std::size_t cells, const PlanInput& input, PlanPart& part) {
  const std::uint64_t padded = padded_cells(cells, input.tables.wavelengths.reflector_count), pixels = input.pixels();
  part.buffers.push_back({name, sizeof(std::int64_t) * input.halves() * layers * padded});
  // The places of the cells, and two weighed pictures by cell and by pixel.
  part.buffers.push_back({"survey and weighing", padded * sizeof(shared::LayerCell) + pixels * sizeof(int) +
                                                     6 * sizeof(float) * (padded + pixels)});
}

const Relighting& relighting_of(StageContext& world, const scene::Scene& scene) {
  if (world.relighting) return *world.relighting;
  const RunTables& tables = world.tables;
  world.relighting = std::make_shared<Relighting>();
  Relighting& relighting = *world.relighting;
  relighting.light = layer_light(scene, world.white);
  relighting.weights = layer_weights(relighting.light, tables.wavelengths);
  const FlatLight flat = flat_light(tables.wavelengths);
  relighting.mean_reflectance =
      compute::Buffer<float>(world.context, "mean reflectances", std::span(flat.mean_reflectance));
  relighting.luminance_share =
      compute::Buffer<float>(world.context, "luminance of each cluster", std::span(flat.luminance_share));

  const int width = tables.camera.width, height = tables.camera.height, reflectors = tables.wavelengths.reflector_count;
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  compute::Buffer<int> unbent(world.context, "survey", pixels * SURVEY_PLACES),
      bent(world.context, "survey through glass", pixels * SURVEY_PLACES * SURVEY_PATHS);
  compute::Kernel survey = compute::Program(world.context, "photons/relight_direct.cl", world.defines).kernel("survey");
  world.run(survey, pixels, 64, {{"camera", tables.camera}, {"seed", world.seed}, {"unbent", unbent}, {"bent", bent}});
  const std::vector<int> seen = unbent.read(), seen_bent = bent.read();
  relighting.unbent = make_layer_cells({seen, width, height, SURVEY_PLACES, reflectors}, unbent_cells(tables.camera),
                                       EmptyPixel::a_cell);
  relighting.bent = make_layer_cells({seen_bent, width, height, SURVEY_PLACES * SURVEY_PATHS, reflectors},
                                     bent_cells(tables.camera, tables.spheres), EmptyPixel::no_cell);
  return relighting;
}

void change_light(Relighting& relighting, StageContext& world, LayerLight light) {
  relighting.weights = layer_weights(light, world.tables.wavelengths);
  relighting.light = std::move(light);
  ++relighting.changes;
  world.tables.energy_scale = layer_energy_scale(relighting.light, world.tables);
  std::vector<std::int64_t> sums = world.context.all_reduced_sum(world.energy);
  for (int outcome = 0; outcome < OUTCOME_COUNT; ++outcome)
    if (!is_count(static_cast<std::size_t>(outcome))) sums[static_cast<std::size_t>(outcome)] = 0;
  world.energy.write(sums);
}

} // namespace nephroid::photons
