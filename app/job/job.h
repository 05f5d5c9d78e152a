// SPDX-License-Identifier: Apache-2.0
// The one interface of all engines: a job advances in slices of about 30 ms and shows itself as immutable snapshots.
#pragma once
#include "base/bytes.h"
#include "job/history.h"
#include "preset/preset.h"

#include <functional>
#include <limits>

namespace nephroid::meters {
struct Readings;
}

namespace nephroid::job {

struct Layer {
  std::string name;                    ///< "direct", "caustic", ...
  std::vector<float> rgb;              ///< linear sRGB, 3 a pixel, row 0 at the top, divided by the preset's white
  std::vector<float> error_draw = {};  ///< as Picture::error_draw; only in Snapshot::left and Beginning
  std::vector<double> replicates = {}; ///< of a meter, in the place of rgb: [replicate][cell][3] (photons/meter.h)
};

struct Picture {
  int width = 0, height = 0;
  std::vector<float> rgb; ///< the sum of the layers
  std::vector<Layer> layers;
  /// An independent draw of the picture's own error, laid out like rgb. It is the difference of two independent halves
  /// of a and b samples, times sqrt(a b) / (a + b). Its covariance is that of rgb. Empty where a half has no sample.
  std::vector<float> error_draw;
};

/// What an engine calls its units of work: "2 passes", "3 M photons/s".
struct Units {
  std::string_view step = "pass", steps = "passes", work = "photon", works = "photons";
};

/// Where a job is. All counts are of the whole run, resumed parts included.
struct Progress {
  double fraction = 0;     ///< 0..1 of the preset's own stop; 1 when finished
  std::int64_t step = 0;   ///< steps completed; the one in hand is in `fraction` and `work` only
  std::int64_t steps = -1; ///< in all; -1: it stops by time
  std::uint64_t work = 0;  ///< done so far: photons sent, facets tried, ...
  double work_seconds = 0; ///< spent on advancing, without start-up and snapshots
  bool whole = true;       ///< false: parts of the picture are black since nothing was computed for them yet
  Units units = {};
};

/// A further picture beside the one that is shown and measured.
struct NamedPicture {
  std::string name; ///< its files': "receiver_1"
  std::shared_ptr<const Picture> picture;
};

/// A figure of the run: run.json has it under group and name, and the report shows it.
struct Scalar {
  std::string group, name; ///< "energy", "emitted_w"; one of a list: "lights/0", "hidden"
  double value = 0;
};

/// Figures over the work done, other than the error: a file NAME.csv, and a chart in the report.
struct Curve {
  std::string name;
  std::vector<std::string> columns;      ///< the first is what the others are drawn over
  std::vector<std::vector<double>> rows; ///< a value a column
};

/// A file that an engine adds to a run's folder. It is made while it is written, for it can be as large as the memory.
struct ExtraFile {
  std::string name;
  std::function<void(ByteSink&)> write; ///< the same bytes whenever it is called; holds what it needs
};

struct Snapshot {
  std::shared_ptr<const Picture> picture; ///< the one that the window shows first and that is measured
  std::shared_ptr<const Picture> in_view; ///< what the window shows alone, in the place of `picture`; null: that itself
  std::string caption;    ///< a sentence on what it shows, where that is not what the preset asks for; else empty
  bool stands_in = false; ///< the picture comes before the first one of what was asked for: no result
  std::vector<NamedPicture> pictures; ///< the others
  Progress progress;
  std::vector<Scalar> scalars;
  std::vector<Curve> curves;
  std::vector<ExtraFile> files;
  std::vector<Layer> left; ///< by an animation's frame for the next: what is noisy, not yet smoothed, with its draws
  std::vector<std::string> warnings;                  ///< what makes the picture doubtful, a sentence each
  std::vector<std::pair<std::string, double>> phases; ///< seconds a phase, e.g. {"photons", 3.2}
  std::shared_ptr<const History> history;             ///< its error's so far; null where nothing is measured
  std::uint64_t adoption = 0; ///< the newest Worker::adopt() that it knows of; the worker's to set
  std::shared_ptr<const meters::Readings> meters = nullptr; ///< what the preset's meters show; null before the first
};

/// A scalar's value; NaN where there is none.
inline double scalar(const Snapshot& snapshot, std::string_view group, std::string_view name) {
  for (const Scalar& s : snapshot.scalars)
    if (s.group == group && s.name == name) return s.value;
  return std::numeric_limits<double>::quiet_NaN();
}

/// What an animation's frame begins with.
struct Beginning {
  /// Snapshot::left of the frame before, moved to this frame's pixels, over this frame's white. A pixel whose place the
  /// frame before did not show is NaN. Null: there is none.
  std::shared_ptr<const std::vector<Layer>> before;
  std::uint64_t seed = 0; ///< of this frame's photons and paths: their noise must not be that of `before`
};

class Job {
public:
  virtual ~Job() = default;
  /// Makes the job a frame of an animation, before its first advance(), or after adopt(). Its pictures become the best
  /// mixtures of its own and the one before, and it leaves something for the next. What has no noise takes no notice.
  virtual void begin_with(const Beginning&) {}
  /// One short piece of work, about 30 ms. Never called once finished() is true.
  virtual void advance() = 0;
  virtual bool finished() const = 0;
  virtual Progress progress() const = 0;
  /// Reads the device's state and makes a picture of it. Takes milliseconds; a tenth of a second with smoothing.
  virtual Snapshot snapshot() = 0;
  /// Whether its pictures come with a draw of their error (Picture::error_draw).
  virtual bool estimates_error() const { return true; }
  /// The history of its error so far, without a snapshot; null where nothing is measured.
  virtual std::shared_ptr<const History> history() const { return nullptr; }
  /// Writes everything needed to go on later with the same bits. Opaque; of the engine's state_version.
  virtual void save(ByteSink& to) = 0;
  /// Reads what save() wrote of the same preset, to its end. Throws bad_input where that is cut.
  virtual void load(ByteSource& from) = 0;
  /// Takes on another preset without starting again, and keeps what was computed so far. True only where the engine can
  /// do so (engine::adoptable): a relighting run can where only the light differs. Throws bad_input at
  /// FILE#/scene/lights/... for a spectrum that cannot be used. Then, and where it returns false, nothing has changed.
  /// After any other exception the next adopt() comes before any advance() or snapshot().
  virtual bool adopt(const preset::Preset&) { return false; }
};

/// What some jobs can tell besides their picture, when somebody asks (Worker::watch_spectrum).
struct PixelSpectrum {
  struct Layer {
    std::string name;             ///< as in the picture
    std::vector<double> radiance; ///< W m^-2 sr^-1 nm^-1, one a wavelength of optics/wavelength.h
  };
  std::array<int, 2> pixel{}; ///< column and row from the top
  std::vector<Layer> layers;
  std::string why_not; ///< why the run has none, with what to do; else empty
  std::string remedy;  ///< the change of the preset with which a run has one, as for --set; empty: there is none
  std::vector<std::string> notes; ///< how it differs from the picture's pixel, a sentence each
};

/// A job that knows spectra is one of these, too.
class SpectrumSource {
public:
  virtual ~SpectrumSource() = default;
  /// As the picture of a snapshot at the same time, on the job's thread. Null where there never is one.
  virtual std::shared_ptr<const PixelSpectrum> spectrum(const std::array<int, 2>& pixel) = 0;
};

} // namespace nephroid::job
