// SPDX-License-Identifier: Apache-2.0
// The meters of a preset, measured: a cycle of each in turn.
#pragma once
#include "meters/shown.h"
#include "run/prepare.h"

#include <memory>
#include <string>
#include <vector>

namespace nephroid::run {

/// A meter at work.
struct MeterInHand {
  preset::Meter meter;
  std::shared_ptr<const scene::MeterSurface> surface; ///< never null
  glm::dvec3 origin{0};                               ///< preset coordinates of the scene's (0, 0, 0)
  photons::RunPlan plan;
  std::unique_ptr<photons::MeterRun> run;
  std::shared_ptr<const meters::Reading> reading; ///< nothing before the first
  double seconds = 0;                             ///< of work until the reading
  std::uint64_t photons = 0;                      ///< sent until then
  std::vector<meters::HistoryRow> history;        ///< of all readings
  bool is_dark() const { return plan.layers == 0; }
  double relative_half_width() const {
    return is_dark() ? 0 : reading ? meters::relative_half_width(meter, *reading) : 1e9;
  }
};

/// Throws bad_input where the preset has no meter, where its engine has no scene, and as scene::make_meter.
void check_meters(const Prepared& prepared);

class Metering {
public:
  /// Measures the meter of that name, or all where it is empty, in the light of the preset: its sky may be another one
  /// than the loaded scene's. Throws bad_input: the preset has none, or none of that name, its engine has no scene, as
  /// scene::make_meter and photons::plan_meter; failed where memory lacks.
  Metering(const Prepared& prepared, const mpi::RankContext& context, const std::string& only = {});

  /// Does a slice of about 30 ms of one of the meters, which take turns of a cycle. True where it has made a reading
  /// anew: after cycles 1, 2, 3, 4, 6, 8, 12, ..., and after the first one that ends.
  bool advance();
  /// Whether all have the intervals that they ask for, or `percent` where they ask for none.
  bool is_enough(double percent) const;
  /// Whether each has a reading.
  bool all_read() const;
  /// What they show; reads the device.
  meters::Readings readings() const;
  /// Everything needed to go on later, but the readings: they come with the cycles in hand.
  void serialize(tracing::Archive& archive);
  double work_seconds() const;
  /// Of what wavelengths the numbers are: of the solar range where a light reaches beyond the visible.
  optics::SpectralRange range() const { return range_; }
  /// What the light is, what of it had to be assumed, and what the plans say besides, a line each, once.
  std::vector<std::string> notes() const;
  /// What its sky is; one of the notes. Empty: there is none.
  const std::string& sky() const { return sky_; }
  const std::vector<MeterInHand>& meters() const { return meters_; }
  const Prepared& prepared() const { return prepared_; }

private:
  void read(MeterInHand& meter, bool steers);

  Prepared prepared_;
  optics::SpectralRange range_ = optics::SpectralRange::visible;
  std::string sky_;
  std::vector<std::string> notes_;
  std::vector<MeterInHand> meters_;
  std::size_t next_ = 0;
};

/// The settings of a meter's photons: the preset's, or of engines that have none the usual ones.
photons::Settings meter_settings(const preset::Preset& preset);

} // namespace nephroid::run
