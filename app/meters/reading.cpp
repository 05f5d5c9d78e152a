// SPDX-License-Identifier: Apache-2.0
#include "meters/reading.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace nephroid::meters {
namespace {

/// Student's t of 0.975 for one degree of freedom less than `count`: 2 to 16 of them (Abramowitz and Stegun, table
/// 26.10).
double students_t(std::size_t count) {
  constexpr double t[] = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306,
                          2.262,  2.228, 2.201, 2.179, 2.160, 2.145, 2.131};
  return t[std::min(count, std::size(t) + 1) - 2];
}

/// Of all light around a goniometer, whose cells are off by more.
constexpr double rounding_of_sums = 4e-6;

constexpr std::size_t replicates = photons::meter_replicates;
using Replicates = std::array<double, replicates>;

/// A quantity of the cells in each replicate.
class CellValues {
public:
  CellValues(std::span<const double> both, Quantity quantity)
      : both_(both), cells_(both.size() / (2 * replicates)), quantity_(static_cast<std::size_t>(quantity)),
        scale_(quantity == Quantity::illuminance ? preset::lumens_per_watt : 1) {}
  std::size_t cells() const { return cells_; }
  double operator()(std::size_t replicate, std::size_t cell) const {
    return scale_ * both_[2 * (replicate * cells_ + cell) + quantity_];
  }
  Replicates cell(std::size_t cell) const {
    Replicates values;
    for (std::size_t r = 0; r < replicates; ++r) values[r] = (*this)(r, cell);
    return values;
  }

private:
  std::span<const double> both_;
  std::size_t cells_, quantity_;
  double scale_;
};

/// The highest cell by `better`, which is greater or less. Who looks for the highest of noisy cells finds one whose
/// noise is high. So half of the replicates choose a cell, and the other half measures it, and the other way round:
/// that is not above the highest but for chance. It may be of another cell, which is lower. The highest of all means,
/// at `found`, is not below the highest but for chance. The interval goes from the one to the other. Of cells that are
/// alike to a half but for rounding, the one is taken that is highest to all.
Interval extreme(const CellValues& values_of, const std::vector<double>& means, std::size_t found, double rounding,
                 const std::function<bool(double, double)>& better) {
  constexpr std::size_t half = replicates / 2;
  double mean = 0, square = 0;
  std::vector<double> chosen_by(means.size());
  for (std::size_t chooser = 0; chooser < 2; ++chooser) {
    double best = 0;
    for (std::size_t cell = 0; cell < means.size(); ++cell) {
      chosen_by[cell] = 0;
      for (std::size_t r = 0; r < half; ++r) chosen_by[cell] += values_of(2 * r + chooser, cell) / half;
      if (cell == 0 || better(chosen_by[cell], best)) best = chosen_by[cell];
    }
    std::optional<std::size_t> chosen;
    for (std::size_t cell = 0; cell < means.size(); ++cell)
      if (std::abs(chosen_by[cell] - best) <= 2 * rounding * std::abs(best) &&
          (!chosen || better(means[cell], means[*chosen])))
        chosen = cell;
    std::array<double, half> values;
    double of_half = 0;
    for (std::size_t r = 0; r < half; ++r) of_half += (values[r] = values_of(2 * r + 1 - chooser, *chosen));
    for (const double value : values) square += std::pow(value - of_half / half, 2);
    mean += of_half / replicates;
  }
  const double half_width =
      students_t(replicates - 1) * std::sqrt(square / ((replicates - 2) * replicates)) + rounding * std::abs(mean);
  const Interval own = interval_of(values_of.cell(found), rounding);
  if (better(1, 0)) return {own.value, std::min(std::max(mean - half_width, 0.0), own.value), own.high};
  return {own.value, own.low, std::max(mean + half_width, own.value)};
}

Numbers numbers_of(const CellValues& values_of, const scene::MeterSurface& surface, double extent) {
  const std::vector<double>& areas = surface.weights();
  Numbers numbers;
  std::vector<double> means(values_of.cells(), 0);
  Replicates of_all{};
  double area = 0;
  for (std::size_t cell = 0; cell < means.size(); ++cell) {
    area += areas[cell];
    for (std::size_t r = 0; r < replicates; ++r) {
      const double value = values_of(r, cell);
      means[cell] += value / replicates;
      of_all[r] += value * areas[cell];
    }
  }
  for (double& value : of_all) value /= area;
  numbers.mean = interval_of(of_all, surface.is_goniometer() ? rounding_of_sums : surface.rounding);
  numbers.total = {numbers.mean.value * extent, numbers.mean.low * extent, numbers.mean.high * extent};
  numbers.peak_cell = static_cast<std::size_t>(std::ranges::max_element(means) - means.begin());
  const auto least_cell = static_cast<std::size_t>(std::ranges::min_element(means) - means.begin());
  numbers.peak = extreme(values_of, means, numbers.peak_cell, surface.rounding, std::greater());
  numbers.least = extreme(values_of, means, least_cell, surface.rounding, std::less());
  numbers.least.low = std::max(numbers.least.low, 0.0);
  if (numbers.mean.low > 0)
    numbers.uniformity = {numbers.least.value / numbers.mean.value, numbers.least.low / numbers.mean.high,
                          std::min(numbers.least.high / numbers.mean.low, 1.0)};
  else
    numbers.uniformity = {0, 0, 1};
  return numbers;
}

LayerReading layer_reading(std::string name, std::span<const double> both, const scene::MeterSurface& surface,
                           double extent) {
  LayerReading layer;
  layer.name = std::move(name);
  for (const Quantity quantity : quantities) {
    const auto q = static_cast<std::size_t>(quantity);
    const CellValues values_of(both, quantity);
    layer.of[q] = numbers_of(values_of, surface, extent);
    layer.cells[q].resize(surface.count());
    for_ranges(surface.count(), 1 << 12, [&](std::size_t, Range range) {
      for (std::size_t cell = range.begin; cell < range.end; ++cell)
        layer.cells[q][cell] = interval_of(values_of.cell(cell), surface.rounding);
    });
  }
  return layer;
}

/// The part of the area whose cells are above: surely, by their means, and as it may be.
Interval share_above(const std::vector<Interval>& cells, const std::vector<double>& areas, double threshold) {
  Interval share;
  double area = 0;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    area += areas[cell];
    if (cells[cell].value > threshold) share.value += areas[cell];
    if (cells[cell].low > threshold) share.low += areas[cell];
    if (cells[cell].high > threshold) share.high += areas[cell];
  }
  return {share.value / area, share.low / area, share.high / area};
}

} // namespace

Interval interval_of(std::span<const double> values, double rounding) {
  const auto count = static_cast<double>(values.size());
  double mean = 0, square = 0;
  for (const double value : values) mean += value / count;
  for (const double value : values) square += (value - mean) * (value - mean);
  const double half = students_t(values.size()) * std::sqrt(square / (count * (count - 1))) + rounding * std::abs(mean);
  return {mean, std::max(mean - half, std::min(mean, 0.0)), mean + half};
}

Reading read(const preset::Meter& meter, const scene::MeterSurface& surface, double metres_per_unit,
             std::vector<photons::MeterLayer> layers) {
  Reading reading;
  const double square_metres = metres_per_unit * metres_per_unit;
  for (const double area : surface.weights()) reading.extent += area * (surface.is_goniometer() ? 1 : square_metres);
  std::vector<double> all(2 * replicates * surface.count(), 0);
  for (photons::MeterLayer& layer : layers)
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::size_t cell = i / 2 % surface.count();
      if (surface.is_goniometer()) // what crosses the cell, by its solid angle
        layer.replicates[i] *= surface.areas[cell] * square_metres / surface.steradians[cell];
      all[i] += layer.replicates[i];
    }
  reading.layers.push_back(layer_reading("all", all, surface, reading.extent));
  for (const photons::MeterLayer& layer : layers)
    reading.layers.push_back(layer_reading(layer.name, layer.replicates, surface, reading.extent));
  if (meter.threshold) {
    const preset::Quantity threshold = *preset::quantity_in(*meter.threshold); // preset::check has looked
    const auto q = static_cast<std::size_t>(quantity_of(threshold.unit));
    reading.share_above =
        share_above(reading.all().cells[q], surface.weights(), threshold.value * preset::size_of(threshold.unit));
  }
  return reading;
}

double relative_half_width(const preset::Meter& meter, const Reading& reading) {
  const Numbers& numbers = reading.all().numbers(quantity_of(meter.unit));
  if (!(numbers.mean.value > 0)) return std::numeric_limits<double>::infinity(); // it is dark, or none was found yet
  return std::max(numbers.mean.half() / numbers.mean.value, numbers.peak.half() / numbers.peak.value);
}

} // namespace nephroid::meters
