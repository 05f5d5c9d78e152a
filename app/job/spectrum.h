// SPDX-License-Identifier: Apache-2.0
// What some jobs can tell besides their picture: the spectrum of a pixel. It is made when somebody asks (Worker::watch_spectrum): what it
// is made of stays on the device.
#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

namespace nephroid::job {

struct PixelSpectrum {
  struct Layer {
    std::string name;             ///< as in the picture
    std::vector<double> radiance; ///< W m^-2 sr^-1 nm^-1, one a wavelength of optics/wavelength.h
  };
  std::array<int, 2> pixel{}; ///< column and row from the top
  std::vector<Layer> layers;
  std::string why_not;            ///< why the run has none, with what to do; else empty
  std::string remedy;             ///< the change of the preset with which a run has one, as for --set; empty: there is none
  std::vector<std::string> notes; ///< how it differs from the picture's pixel, a sentence each
};

/// A job that knows spectra is one of these, too.
class SpectrumSource {
public:
  virtual ~SpectrumSource() = default;
  /// As the picture of a snapshot at the same time. On the job's thread. Null outside of the picture, and where it never has one.
  virtual std::shared_ptr<const PixelSpectrum> spectrum(const std::array<int, 2>& pixel) = 0;
};

} // namespace nephroid::job
