// SPDX-License-Identifier: Apache-2.0
#include "meters/reading.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace nephroid::meters {
namespace {

/// Student's t of 0.975 for one degree of freedom less than parts: 2 to 16 of them (Abramowitz and Stegun, table 26.10).
double students_t(std::size_t parts) {
  constexpr double t[] = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306,
                          2.262,  2.228, 2.201, 2.179, 2.160, 2.145, 2.131};
  return t[std::min(parts, std::size(t) + 1) - 2];
}

constexpr std::size_t parts_count = photons::meter_parts;
using Parts = std::array<double, parts_count>;

/// A quantity of the cells in each part: [part][cell].
class CellParts {
public:
  CellParts(std::span<const double> both, Quantity quantity)
      : both_(both), cells_(both.size() / (2 * parts_count)), quantity_(static_cast<std::size_t>(quantity)),
        scale_(quantity == Quantity::illuminance ? preset::lumens_per_watt : 1) {}
  std::size_t cells() const { return cells_; }
  double operator()(std::size_t part, std::size_t cell) const {
    return scale_ * both_[2 * (part * cells_ + cell) + quantity_];
  }
  Parts of(std::size_t cell) const {
    Parts parts;
    for (std::size_t part = 0; part < parts_count; ++part) parts[part] = (*this)(part, cell);
    return parts;
  }

private:
  std::span<const double> both_;
  std::size_t cells_, quantity_;
  double scale_;
};

/// The highest cell by `better`, which is greater or less. Who looks for the highest of noisy cells finds one whose
/// noise is high. So each part's value is taken of the cell that the others find. Their mean may be of cells that are
/// not quite the highest; the highest of all means is above the truth: the interval holds both. Of cells that are alike
/// to the others but for rounding, one is taken that is as high in the part itself.
Interval extreme(const CellParts& parts, const std::vector<double>& means, std::size_t found, double rounding,
                 const std::function<bool(double, double)>& better) {
  Parts values;
  std::vector<double> of_others(means.size());
  for (std::size_t part = 0; part < parts_count; ++part) {
    double best = 0;
    for (std::size_t cell = 0; cell < means.size(); ++cell) {
      of_others[cell] = (means[cell] * parts_count - parts(part, cell)) / (parts_count - 1);
      if (cell == 0 || better(of_others[cell], best)) best = of_others[cell];
    }
    std::optional<std::size_t> chosen;
    for (std::size_t cell = 0; cell < means.size(); ++cell)
      if (std::abs(of_others[cell] - best) <= 2 * rounding * best && (!chosen || better(means[cell], means[*chosen])))
        chosen = cell;
    values[part] = parts(part, *chosen);
  }
  Interval interval = interval_of(values, rounding);
  interval.low = std::min(interval.low, means[found] * (1 - rounding));
  interval.high = std::max(interval.high, means[found] * (1 + rounding));
  return interval;
}

Numbers numbers_of(const CellParts& parts, const scene::MeterSurface& surface, double area_m2) {
  const std::vector<double>& areas = surface.areas;
  Numbers numbers;
  std::vector<double> means(parts.cells(), 0);
  Parts of_all{};
  double area = 0;
  for (std::size_t cell = 0; cell < means.size(); ++cell) {
    area += areas[cell];
    for (std::size_t part = 0; part < parts_count; ++part) {
      const double value = parts(part, cell);
      means[cell] += value / parts_count;
      of_all[part] += value * areas[cell];
    }
  }
  for (double& value : of_all) value /= area;
  numbers.mean = interval_of(of_all, surface.rounding);
  numbers.total = {numbers.mean.value * area_m2, numbers.mean.low * area_m2, numbers.mean.high * area_m2};
  numbers.peak_cell = static_cast<std::size_t>(std::ranges::max_element(means) - means.begin());
  const auto least_cell = static_cast<std::size_t>(std::ranges::min_element(means) - means.begin());
  numbers.peak = extreme(parts, means, numbers.peak_cell, surface.rounding, std::greater());
  numbers.least = extreme(parts, means, least_cell, surface.rounding, std::less());
  numbers.least.low = std::max(numbers.least.low, 0.0);
  if (numbers.mean.low > 0)
    numbers.uniformity = {numbers.least.value / numbers.mean.value, numbers.least.low / numbers.mean.high,
                          std::min(numbers.least.high / numbers.mean.low, 1.0)};
  else
    numbers.uniformity = {0, 0, 1};
  return numbers;
}

LayerReading layer_reading(std::string name, std::span<const double> both, const scene::MeterSurface& surface,
                           double area_m2) {
  LayerReading layer;
  layer.name = std::move(name);
  for (const Quantity quantity : quantities) {
    const auto q = static_cast<std::size_t>(quantity);
    const CellParts parts(both, quantity);
    layer.of[q] = numbers_of(parts, surface, area_m2);
    layer.cells[q].resize(surface.count());
    for_ranges(surface.count(), 1 << 12, [&](std::size_t, Range range) {
      for (std::size_t cell = range.begin; cell < range.end; ++cell)
        layer.cells[q][cell] = interval_of(parts.of(cell), surface.rounding);
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

Interval interval_of(std::span<const double> parts, double rounding) {
  const auto count = static_cast<double>(parts.size());
  double mean = 0, square = 0;
  for (const double part : parts) mean += part / count;
  for (const double part : parts) square += (part - mean) * (part - mean);
  const double half =
      students_t(parts.size()) * std::sqrt(square / (count * (count - 1))) + rounding * std::abs(mean);
  return {mean, mean - half, mean + half};
}

Reading read(const preset::Meter& meter, const scene::MeterSurface& surface, double metres_per_unit,
             const std::vector<photons::MeterLayer>& layers) {
  Reading reading;
  for (const double area : surface.areas) reading.area_m2 += area * metres_per_unit * metres_per_unit;
  std::vector<double> all(2 * parts_count * surface.count(), 0);
  for (const photons::MeterLayer& layer : layers)
    for (std::size_t i = 0; i < all.size(); ++i) all[i] += layer.parts[i];
  reading.layers.push_back(layer_reading("all", all, surface, reading.area_m2));
  for (const photons::MeterLayer& layer : layers)
    reading.layers.push_back(layer_reading(layer.name, layer.parts, surface, reading.area_m2));
  if (meter.threshold) {
    const preset::Quantity threshold = *preset::quantity_in(*meter.threshold); // preset::check has looked
    const auto q = static_cast<std::size_t>(quantity_of(threshold.unit));
    reading.share_above =
        share_above(reading.all().cells[q], surface.areas, threshold.value * preset::size_of(threshold.unit));
  }
  return reading;
}

double relative_half_width(const preset::Meter& meter, const Reading& reading) {
  const Numbers& numbers = reading.all().numbers(quantity_of(meter.unit));
  if (!(numbers.mean.value > 0)) return 0; // it is dark
  return std::max(numbers.mean.half() / numbers.mean.value, numbers.peak.half() / numbers.peak.value);
}

} // namespace nephroid::meters
