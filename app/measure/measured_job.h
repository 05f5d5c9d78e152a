// SPDX-License-Identifier: Apache-2.0
// A job that measures itself: it steps another job, now and then compares its picture with a reference or with itself,
// keeps the history and ends at the error that was asked for.
#pragma once
#include "job/job.h"
#include "measure/metrics.h"

#include <chrono>

namespace nephroid::measure {

/// The picture that others are measured against, and how far it is off itself. run/reference.h finds or renders one.
struct Reference {
  int width = 0, height = 0;
  std::vector<float> rgb;             ///< linear sRGB, 3 a pixel
  std::string origin;                 ///< the file, also that of a recipe in the cache
  std::optional<Metrics> noise_floor; ///< a recipe's: one of its two seeds against the mean of both, which `rgb` is
  std::optional<Metrics> masked_noise_floor; ///< the same within the mask
  std::vector<unsigned char> mask;           ///< one a pixel, or empty
  std::vector<job::Layer> layers = {};       ///< where it is a picture of a run, which has them; else empty
  std::vector<float> error_draw = {}; ///< a recipe's: one seed minus the mean of both, laid out like `rgb`; else empty

  Pixels pixels() const { return {width, height, rgb, origin}; }
};

/// Measuring takes at most this part of the time of work, the first and the last measurement excepted.
inline constexpr double measuring_share = 0.04;
/// The same where an error may stop the run: what it overshoots costs more than measuring does.
inline constexpr double measuring_share_to_stop = 0.5;

/// Wraps a job. reference: null where there is none. began: when the run's wall clock started. Measurements come at
/// times that grow by a fifth, and where stop.error is about to be reached; a step measures or works, never both, and
/// measuring is not in Progress::work_seconds. Throws bad_input where stop.error is asked for with neither a reference
/// nor an estimate. The reference has the picture's size. times: of work, in order, at which to measure besides.
std::unique_ptr<job::Job> measured(std::unique_ptr<job::Job> job, const preset::Preset& preset,
                                   std::shared_ptr<const Reference> reference,
                                   std::chrono::steady_clock::time_point began = std::chrono::steady_clock::now(),
                                   std::vector<double> times = {});

} // namespace nephroid::measure
