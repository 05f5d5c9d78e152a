// SPDX-License-Identifier: Apache-2.0
// Figures of a run pass by pass: passes are independent, so their scatter says how well the mean is known, whatever the
// photons carry.
#pragma once
#include "tests/support/render.h"
#include "tests/support/statistics.h"

#include <boost/math/distributions/students_t.hpp>

namespace nephroid::test {

/// A mean over passes.
struct Estimate {
  double mean = 0, variance = 0; ///< variance of the mean
  double degrees = 1;            ///< variance's degrees of freedom
  double error() const { return std::sqrt(variance); }
};

/// Steps a new job to its end and hands back the mean of each of the figures that `figures` reads from it after every
/// pass; they have to be means over passes themselves (pixels, the energy balance), from which each pass's own is
/// worked out.
inline std::vector<Estimate> step_passes(job::Job& job, const std::function<std::vector<double>(job::Job&)>& figures) {
  std::vector<double> last;
  std::vector<Estimate> estimates;
  int pass = 0;
  while (!job.finished()) {
    job.advance();
    if (job.progress().step == pass) continue;
    const std::vector<double> mean = figures(job);
    last.resize(mean.size(), 0.0);
    estimates.resize(mean.size());
    for (std::size_t i = 0; i < mean.size(); ++i) { // Welford's sums
      const double own = (pass + 1) * mean[i] - pass * last[i], off = own - estimates[i].mean;
      estimates[i].mean += off / (pass + 1);
      estimates[i].variance += off * (own - estimates[i].mean);
    }
    last = mean;
    ++pass;
  }
  for (Estimate& e : estimates) {
    e.variance /= double(pass) * (pass - 1);
    e.degrees = pass - 1;
  }
  return estimates;
}

/// The same for a preset's job and the figures of its snapshots.
inline std::vector<Estimate> render_passes(const preset::Preset& preset,
                                           const std::function<std::vector<double>(const job::Snapshot&)>& figures) {
  return step_passes(*job_of(preset), [&](job::Job& job) { return figures(job.snapshot()); });
}

/// The same of several whole runs, each with a seed of its own: for passes that see what those before have left.
inline std::vector<Estimate> render_seeds(preset::Preset preset, int seeds,
                                          const std::function<std::vector<double>(const job::Snapshot&)>& figures) {
  std::vector<Estimate> estimates;
  for (int run = 0; run < seeds; ++run, ++preset.seed) {
    const std::vector<double> own = figures(render(preset));
    estimates.resize(own.size());
    for (std::size_t i = 0; i < own.size(); ++i) {
      const double off = own[i] - estimates[i].mean;
      estimates[i].mean += off / (run + 1);
      estimates[i].variance += off * (own[i] - estimates[i].mean) / (double(seeds) * (seeds - 1));
      estimates[i].degrees = seeds - 1;
    }
  }
  return estimates;
}

/// The chance that an estimate is at least so far from the truth, after Student with Bernstein's bound; bias: what it
/// may be off by besides.
inline double p_value(const Estimate& e, double truth, double bias = 0) {
  return bernstein(std::max(std::abs(e.mean - truth) - bias, 0.0), e.variance, 0, e.degrees);
}

/// The chance that figures with the same expectations, each but for its `bias`, are as different somewhere, after
/// Sidak.
inline double same_expectations(const std::vector<Estimate>& a, const std::vector<Estimate>& b,
                                std::vector<double> bias = {}) {
  bias.resize(a.size(), 0);
  double smallest = 1;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Estimate difference{a[i].mean - b[i].mean, a[i].variance + b[i].variance,
                              std::min(a[i].degrees, b[i].degrees)};
    if (difference.variance > 0) smallest = std::min(smallest, p_value(difference, 0, bias[i]));
  }
  return sidak(smallest, static_cast<double>(a.size()));
}

/// How far off such an estimate may be before its p-value is a false alarm: bernstein() turned round.
inline double tolerance(const Estimate& e) {
  return std::sqrt(e.variance * e.degrees * std::expm1(2 / e.degrees * std::log(2 / false_alarm)));
}

/// How far off a figure may be that scattered with this standard deviation over so many seeds: after Student's
/// distribution one run in a million is farther off, a thousand times as many as `false_alarm`, for which there were
/// never seeds enough. For passes that hang on each other, whose own scatter says nothing.
inline double tolerance_over_seeds(double standard_deviation, int seeds) {
  const boost::math::students_t distribution(seeds - 1);
  return standard_deviation * boost::math::quantile(boost::math::complement(distribution, 1e-6 / 2));
}

} // namespace nephroid::test
