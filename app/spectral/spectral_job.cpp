// SPDX-License-Identifier: Apache-2.0
// The job of engine 1: passes of one sample a pixel of the direct layer and photons_per_pass photons of the caustic layer, cut into
// steps. Sums are exact, so how a pass is cut changes no bit.
#include "base/error.h"
#include "spectral/device_buffers.h"
#include "spectral/engine.h"
#include "spectral/film.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

namespace nephroid::spectral {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double step_seconds = 0.05;
constexpr std::uint32_t checkpoint_version = 2;

constexpr const char *direct_source = "direct.cl", *photon_source = "photons.cl"; // kernel_sources has all of them

struct Uint2 {
  std::uint32_t x, y;
};

/// How much work fits into a step, learned from the steps before.
class StepSize {
public:
  explicit StepSize(double start) : amount_(start) {}
  double amount() const { return amount_; }
  /// By little at a time: the first step of a kernel also compiles it, and the rows of a picture differ.
  void learn(double done, double seconds)
  {
    amount_ = std::clamp(done * step_seconds / std::max(seconds, 1e-6), 0.25 * amount_, 1.5 * amount_);
  }

private:
  double amount_;
};

/// Where a run is; all that a checkpoint holds beside the sums.
struct Position {
  std::int64_t pass = 0;              ///< passes completed
  std::int64_t row = 0;               ///< rows of this pass's direct samples done
  std::int64_t slice = 0, slices = 1; ///< of this pass's photons; slice s has the photons s, s + slices, ...
  double work_seconds = 0, direct_seconds = 0, photon_seconds = 0;
};

bool runs(const plan::Plan& plan, const std::string& name)
{
  const auto pass = std::find_if(plan.passes.begin(), plan.passes.end(), [&](const plan::Pass& p) { return p.name == name; });
  return pass != plan.passes.end() && pass->runs;
}

class SpectralJob final : public job::Job {
public:
  SpectralJob(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh, const plan::Plan& plan,
              const compute::Context& context)
      : context_(context), tables_(make_device_tables(preset, scene)),
        buffers_(upload(context, scene, bvh, tables_)), seed_{static_cast<std::uint32_t>(preset.seed),
                                                              static_cast<std::uint32_t>(preset.seed >> 32)},
        white_(preset.white), stop_seconds_(preset.stop.seconds), pixel_samples_(preset.spectral.pixel_samples),
        direct_(runs(plan, "direct")), photons_(runs(plan, "photons")), halves_(preset.measure.estimate ? 2 : 1)
  {
    if (preset.stop.passes || !(preset.stop.seconds || preset.stop.error)) passes_ = preset.stop.passes.value_or(preset::default_passes);
    // Without photons a run is over when every pixel has its samples.
    if (!photons_ && (passes_ < 0 || passes_ > pixel_samples_)) passes_ = pixel_samples_;
    tables_.scene.root = bvh.root;
    const std::size_t sums = halves_ * 3 * static_cast<std::size_t>(tables_.camera.width) * static_cast<std::size_t>(tables_.camera.height);
    compute::Defines defines = plan.defines;
    photons_per_item_ = context.device().type == "cpu" ? 16 : 1;
    defines["NEPHROID_PHOTONS_PER_ITEM"] = std::to_string(photons_per_item_);
    energy_ = zeroed("energy", OUTCOME_COUNT);
    if (direct_) {
      direct_film_ = zeroed("film direct", sums);
      direct_kernel_ = compute::Program(context, direct_source, plan.defines).kernel("direct");
    }
    if (photons_) {
      caustic_film_ = zeroed("film caustic", sums);
      photon_kernel_ = compute::Program(context, photon_source, defines).kernel("photons");
    }
  }

  bool finished() const override
  {
    if (!direct_ && !photons_) return true;
    if (stop_seconds_ && at_.work_seconds >= *stop_seconds_) return true;
    return at_.pass >= (passes_ >= 0 ? passes_ : preset::max_passes); // sums are exact so long
  }

  void step() override
  {
    const auto begin = Clock::now();
    const bool direct = direct_left() > 0;
    direct ? step_direct() : step_photons();
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    at_.work_seconds += seconds;
    (direct ? at_.direct_seconds : at_.photon_seconds) += seconds;
    if (direct)
      rows_a_step_.learn(static_cast<double>(last_amount_), seconds);
    else
      photons_a_step_.learn(static_cast<double>(last_amount_), seconds);
    if (direct_left() == 0 && (!photons_ || at_.slice == at_.slices)) {
      ++at_.pass;
      at_.row = at_.slice = 0;
      at_.slices = 1;
    }
  }

  job::Progress progress() const override
  {
    job::Progress p;
    p.step = at_.pass;
    p.steps = passes_;
    p.photons = static_cast<std::uint64_t>(photon_passes() * (photons_ ? tables_.photons_per_pass : 0));
    p.work_seconds = at_.work_seconds;
    const double by_seconds = stop_seconds_ ? at_.work_seconds / *stop_seconds_ : 0,
                 by_passes = passes_ > 0 ? passes_with_part() / passes_ : 0;
    p.fraction = finished() ? 1 : std::min(std::max(by_seconds, by_passes), 1.0);
    return p;
  }

  job::Snapshot snapshot() override
  {
    auto picture = std::make_shared<job::Picture>();
    picture->width = tables_.camera.width;
    picture->height = tables_.camera.height;
    picture->rgb.assign(3 * static_cast<std::size_t>(picture->width) * static_cast<std::size_t>(picture->height), 0.0f);
    picture->error_draw = picture->rgb;
    if (direct_) picture->layers.push_back(develop_film("direct", direct_film_, tables_.direct_scale, picture->error_draw));
    if (photons_) picture->layers.push_back(develop_film("caustic", caustic_film_, tables_.caustic_scale, picture->error_draw));
    if (picture->layers.empty() || halves_ == 1) picture->error_draw.clear();
    for (const job::Layer& layer : picture->layers)
      for (std::size_t i = 0; i < layer.rgb.size(); ++i) picture->rgb[i] += layer.rgb[i];

    job::Snapshot snapshot;
    snapshot.picture = std::move(picture);
    snapshot.progress = progress();
    snapshot.energy = energy_balance();
    snapshot.phases = {{"direct", at_.direct_seconds}, {"photons", at_.photon_seconds}};
    return snapshot;
  }

  std::vector<std::byte> save() override
  {
    std::vector<std::byte> bytes;
    append(bytes, &checkpoint_version, sizeof checkpoint_version);
    append(bytes, &at_, sizeof at_);
    for (const compute::Buffer<std::int64_t>* buffer : films()) {
      const std::vector<std::int64_t> sums = buffer->read();
      append(bytes, sums.data(), sums.size() * sizeof sums[0]);
    }
    return bytes;
  }

  void load(std::span<const std::byte> checkpoint) override
  {
    std::uint32_t version = 0;
    Position position;
    std::size_t expected = sizeof version + sizeof position;
    for (const compute::Buffer<std::int64_t>* buffer : films()) expected += buffer->bytes();
    if (checkpoint.size() != expected)
      throw bad_input("checkpoint", "has " + std::to_string(checkpoint.size()) + " bytes", std::to_string(expected) + " are expected",
                      "delete it and start again");
    take(checkpoint, &version, sizeof version);
    if (version != checkpoint_version)
      throw bad_input("checkpoint", "is of version " + std::to_string(version),
                      "this program writes version " + std::to_string(checkpoint_version), "delete it and start again");
    take(checkpoint, &position, sizeof position);
    for (compute::Buffer<std::int64_t>* buffer : films()) {
      std::vector<std::int64_t> sums(buffer->size());
      take(checkpoint, sums.data(), buffer->bytes());
      buffer->write(sums);
    }
    context_.finish();
    at_ = position;
  }

private:
  compute::Buffer<std::int64_t> zeroed(const char* name, std::size_t count)
  {
    compute::Buffer<std::int64_t> buffer(context_, name, count);
    buffer.fill_zero();
    return buffer;
  }

  std::vector<compute::Buffer<std::int64_t>*> films()
  {
    std::vector<compute::Buffer<std::int64_t>*> list{&energy_};
    if (direct_) list.push_back(&direct_film_);
    if (photons_) list.push_back(&caustic_film_);
    return list;
  }

  static void append(std::vector<std::byte>& to, const void* from, std::size_t count)
  {
    const std::size_t size = to.size();
    to.resize(size + count);
    std::memcpy(to.data() + size, from, count);
  }

  static void take(std::span<const std::byte>& from, void* to, std::size_t count)
  {
    std::memcpy(to, from.data(), count);
    from = from.subspan(count);
  }

  job::Layer develop_film(const char* name, const compute::Buffer<std::int64_t>& film, double scale, std::vector<float>& error_draw)
  {
    const bool direct = &film == &direct_film_;
    const auto samples = [&](int row) -> std::array<double, 2> {
      const std::int64_t passes = direct ? std::min(at_.pass, pixel_samples_) : at_.pass;
      const std::int64_t odd = passes / 2, even = passes - odd; // the first pass is number 0
      std::array<double, 2> both{static_cast<double>(even), static_cast<double>(odd)};
      const double part = !direct ? static_cast<double>(at_.slice) / static_cast<double>(at_.slices) : row < at_.row ? 1 : 0;
      both[static_cast<std::size_t>(at_.pass % 2)] += part;
      return both;
    };
    const std::vector<std::int64_t> sums = film.read();
    return develop(name, {sums, tables_.camera.width, tables_.camera.height, scale * white_, samples}, error_draw);
  }

  std::int64_t direct_left() const { return direct_ && at_.pass < pixel_samples_ ? tables_.camera.height - at_.row : 0; }
  /// Passes of photons done, with the part of the one in hand: what sums of photons are divided by.
  double photon_passes() const { return static_cast<double>(at_.pass) + static_cast<double>(at_.slice) / static_cast<double>(at_.slices); }
  /// Passes done with the part of the one in hand, whose rows come before its photons and count as much.
  double passes_with_part() const
  {
    const bool rows = direct_ && at_.pass < pixel_samples_;
    const double row_part = static_cast<double>(at_.row) / tables_.camera.height,
                 photon_part = static_cast<double>(at_.slice) / static_cast<double>(at_.slices);
    const double part = rows && photons_ ? (row_part + photon_part) / 2 : rows ? row_part : photon_part;
    return static_cast<double>(at_.pass) + part;
  }

  /// Runs a kernel whose arguments begin with WORLD_ARGUMENTS (kernels/world.h), and waits for it.
  template <class... Rest>
  void run_in_world(compute::Kernel& kernel, std::size_t global, std::size_t local, const Rest&... rest)
  {
    const DeviceBuffers& b = buffers_;
    kernel.run(global, local, b.nodes, b.blocks, b.corners, b.positions, b.normals, b.object_of_triangle, b.objects, b.materials, b.lights,
               b.index_of_refraction, b.reflected_xyz, b.cluster_first, b.cluster_wavelengths, b.coefficient, b.light_xyz, b.reflectance,
               tables_.wavelengths.reflector_count, tables_.scene, rest...);
    context_.finish();
  }

  /// A scale for powers as the device knows them.
  float on_device(double scale) const { return static_cast<float>(scale * tables_.power_unit); }

  void step_direct()
  {
    const auto rows = std::clamp<std::int64_t>(std::llround(rows_a_step_.amount()), 1, direct_left());
    const std::size_t items = static_cast<std::size_t>(rows) * static_cast<std::size_t>(tables_.camera.width);
    run_in_world(direct_kernel_, items, 64, buffers_.reflected_xyz_all, buffers_.cluster_cdf, direct_film_, energy_, tables_.camera, seed_,
                 static_cast<std::uint32_t>(at_.pass), static_cast<int>(at_.row), static_cast<int>(rows), on_device(tables_.direct_scale),
                 static_cast<float>(tables_.direct_limit));
    at_.row += rows;
    last_amount_ = rows;
  }

  void step_photons()
  {
    const std::uint32_t all = tables_.photons_per_pass;
    if (at_.slice == 0) at_.slices = std::clamp<std::int64_t>(std::llround(all / photons_a_step_.amount()), 1, all);
    const auto slices = static_cast<std::uint32_t>(at_.slices), slice = static_cast<std::uint32_t>(at_.slice);
    const std::uint32_t count = (all - slice + slices - 1) / slices;
    run_in_world(photon_kernel_, (count + photons_per_item_ - 1) / photons_per_item_, 32, buffers_.targets, buffers_.emitters,
                 caustic_film_, energy_, tables_.camera, seed_, static_cast<std::uint32_t>(at_.pass), slice, slices, count,
                 on_device(tables_.caustic_scale), on_device(tables_.energy_scale));
    ++at_.slice;
    last_amount_ = count;
  }

  job::EnergyBalance energy_balance()
  {
    const std::vector<std::int64_t> sums = energy_.read();
    const double passes = photon_passes();
    const auto watts = [&](int outcome) {
      return passes > 0 ? static_cast<double>(sums[static_cast<std::size_t>(outcome)]) / (tables_.energy_scale * passes) : 0;
    };
    job::EnergyBalance e;
    e.emitted_w = watts(OUTCOME_EMITTED);
    e.deposited_w = watts(OUTCOME_DEPOSITED);
    e.missed_w = watts(OUTCOME_MISSED);
    e.absorbed_w = watts(OUTCOME_ABSORBED);
    e.escaped_w = watts(OUTCOME_ESCAPED);
    e.lost_w = watts(OUTCOME_LOST);
    e.refused_contributions = static_cast<std::uint64_t>(sums[OUTCOME_REFUSED]);
    return e;
  }

  compute::Context context_;
  DeviceTables tables_;
  DeviceBuffers buffers_;
  Uint2 seed_;
  double white_;
  std::optional<double> stop_seconds_;
  std::int64_t passes_ = -1; ///< -1: until stop_seconds_, or until whoever steps it has enough
  std::int64_t pixel_samples_;
  bool direct_, photons_;
  std::size_t halves_; ///< of a film
  unsigned photons_per_item_ = 1;
  compute::Buffer<std::int64_t> energy_, direct_film_, caustic_film_;
  compute::Kernel direct_kernel_, photon_kernel_;
  Position at_;
  StepSize rows_a_step_{16}, photons_a_step_{8192};
  std::int64_t last_amount_ = 0;
};

} // namespace

std::unique_ptr<job::Job> make_job(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh, const plan::Plan& plan,
                                   const compute::Context& context)
{
  return std::make_unique<SpectralJob>(preset, scene, bvh, plan, context);
}

std::string kernel_sources(const compute::Context& context)
{
  return compute::kernel_source(context, direct_source) + compute::kernel_source(context, photon_source);
}

} // namespace nephroid::spectral
