// SPDX-License-Identifier: Apache-2.0
#include "optics/dispersion.h"

#include "base/error.h"
#include "base/monotone_cubic.h"
#include "optics/tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace nephroid::optics {
namespace {

/// Range ends are printed in micrometres with few digits: .5893 um times 1000 is above 589.3 nm.
constexpr double range_tolerance = 1e-6;

bool is_outside(double nm, double low_nm, double high_nm) {
  return nm < low_nm * (1 - range_tolerance) || nm > high_nm * (1 + range_tolerance);
}

Error refusal(const DispersionCurve& curve, const char* quantity, double nm, double low_nm, double high_nm) {
  return bad_input(curve.source, fmt::format("{} has no {} at {} nm", curve.name, quantity, nm),
                   fmt::format("expected a wavelength in its range {:.6g}..{:.6g} nm", low_nm, high_nm),
                   "outside \"hold\" or \"extrapolate\" goes beyond it");
}

/// A formula gives no n at a wavelength: past its range it may be held, inside it its coefficients are wrong.
Error no_index(const DispersionCurve& curve, double nm, Extrapolation outside) {
  const double low = curve.n->low_nm, high = curve.n->high_nm;
  const std::string what = fmt::format("the formula of {} gives no number at {} nm", curve.name, nm);
  if (is_outside(nm, low, high) && outside != Extrapolation::hold)
    return bad_input(curve.source, what, fmt::format("its range is {:.6g}..{:.6g} nm", low, high),
                     "use outside \"hold\", or choose another file");
  return bad_input(curve.source, what + ": n^2 is negative or infinite there", "expected n^2 above 0",
                   "check the coefficients: does a resonance lie inside the range?");
}

double value_at(const Curve& curve, double nm, Extrapolation outside) {
  const bool hold = outside == Extrapolation::hold || !curve.formula;
  return curve.value(hold ? std::clamp(nm, curve.low_nm, curve.high_nm) : nm);
}

void require_finite(std::span<const double> values, const char* kind) {
  if (values.empty()) throw bad_input(kind, "there are no coefficients", "expected at least one");
  for (double value : values)
    if (!std::isfinite(value)) throw bad_input(kind, "a coefficient is not finite");
}

void require_range(double low_nm, double high_nm, const char* kind) {
  if (!(low_nm > 0) || !(high_nm >= low_nm))
    throw bad_input(kind, fmt::format("the range is {}..{} nm", low_nm, high_nm), "expected 0 < low <= high");
}

DispersionCurve index_only(const char* kind, Curve n) { return {kind, kind, std::move(n), std::nullopt}; }

/// Coefficients as the database counts them, from 1; those that a file leaves out are 0.
class Coefficients {
public:
  explicit Coefficients(std::span<const double> values) : values_(values) {}
  double operator[](std::size_t number) const { return number <= values_.size() ? values_[number - 1] : 0; }

  /// The sum of term(factor, parameter) over the pairs from (first, first + 1) to the end.
  template <class Term>
  double sum(std::size_t first, Term term) const {
    double result = 0;
    for (std::size_t i = first; i <= values_.size(); i += 2)
      if ((*this)[i] != 0) result += term((*this)[i], (*this)[i + 1]);
    return result;
  }

private:
  std::span<const double> values_;
};

/// Formula 4's resonance c l^p / (l^2 - a^b); 0 where c is 0, even on the pole (a = b = 0 gives a^b = 1).
double resonance(double c, double p, double a, double b, double um) {
  return c == 0 ? 0 : c * std::pow(um, p) / (um * um - std::pow(a, b));
}

double gas(const Coefficients& c, double um) {
  return 1 + c[1] + c.sum(2, [&](double b, double pole) { return b / (pole - 1 / (um * um)); });
}

double herzberger(const Coefficients& c, double um) {
  const double l2 = um * um, pole = 1 / (l2 - 0.028);
  return c[1] + c[2] * pole + c[3] * pole * pole + c[4] * l2 + c[5] * l2 * l2 + c[6] * l2 * l2 * l2;
}

/// Formula 8, a Lorentz-Lorenz form: (n^2 - 1) / (n^2 + 2) = r, so n^2 = (1 + 2 r) / (1 - r).
double retro(const Coefficients& c, double um) {
  const double l2 = um * um;
  const double r = c[1] + (c[2] == 0 ? 0 : c[2] * l2 / (l2 - c[3])) + c[4] * l2;
  return std::sqrt((1 + 2 * r) / (1 - r));
}

double exotic(const Coefficients& c, double um) {
  const double l2 = um * um, d = um - c[5];
  return std::sqrt(c[1] + (c[2] == 0 ? 0 : c[2] / (l2 - c[3])) + (c[4] == 0 ? 0 : c[4] * d / (d * d + c[6])));
}

} // namespace

int most_coefficients(int formula) {
  constexpr int most[formula_count] = {0, 0, 0, 17, 0, 0, 6, 4, 6};
  return most[formula - 1];
}

double index_by_formula(int formula, std::span<const double> coefficients, double um) {
  const Coefficients c(coefficients);
  const double l2 = um * um;
  const auto power = [&](double factor, double exponent) { return factor * std::pow(um, exponent); };
  switch (formula) {
  case 1: return std::sqrt(1 + c[1] + c.sum(2, [&](double b, double pole) { return b * l2 / (l2 - pole * pole); }));
  case 2: return std::sqrt(1 + c[1] + c.sum(2, [&](double b, double pole) { return b * l2 / (l2 - pole); }));
  case 3: return std::sqrt(c[1] + c.sum(2, power));
  case 4:
    return std::sqrt(c[1] + resonance(c[2], c[3], c[4], c[5], um) + resonance(c[6], c[7], c[8], c[9], um) +
                     c.sum(10, power));
  case 5: return c[1] + c.sum(2, power);
  case 6: return gas(c, um);
  case 7: return herzberger(c, um);
  case 8: return retro(c, um);
  case 9: return exotic(c, um);
  default: return std::numeric_limits<double>::quiet_NaN();
  }
}

std::array<double, 2> DispersionCurve::range_nm() const {
  const std::optional<Curve>& main = n ? n : k;
  return main ? std::array{main->low_nm, main->high_nm} : std::array{0.0, 0.0};
}

IndexSample DispersionCurve::sample(double nm, Extrapolation outside) const {
  if (!std::isfinite(nm) || !(nm > 0))
    throw bad_input(source, fmt::format("the wavelength is {} nm", nm), "expected a number above 0");
  const auto [low, high] = range_nm();
  IndexSample result;
  result.nm = nm;
  result.extrapolated = is_outside(nm, low, high);
  if (result.extrapolated && outside == Extrapolation::refuse) throw refusal(*this, n ? "n" : "k", nm, low, high);
  if (n) {
    const double value = value_at(*n, nm, outside);
    if (std::isfinite(value)) result.n = value;
  }
  if (k) result.k = value_at(*k, nm, outside);
  return result;
}

Spectrum sample_n(const DispersionCurve& curve, Extrapolation outside, SpectralRange range) {
  if (!curve.n)
    throw bad_input(curve.source, curve.name + " has no index of refraction n, only k", {}, "choose another file");
  if (const auto gap = curve.n->gap_nm; gap && outside == Extrapolation::refuse)
    throw bad_input(
        curve.source, fmt::format("{} has no n between {:.6g} and {:.6g} nm", curve.name, gap->front(), gap->back()),
        "expected a table without gaps from 380 to 780 nm", "outside \"hold\" draws a straight line across");
  return spectrum_of(
      [&](double nm) {
        std::optional<double> n = curve.sample(nm, outside).n;
        if (range != SpectralRange::visible && outside != Extrapolation::refuse && !(n && *n > 0))
          n = curve.sample(nm, Extrapolation::hold).n;
        if (!n) throw no_index(curve, nm, outside);
        if (!(*n > 0))
          throw bad_input(curve.source, fmt::format("{} has n = {} at {} nm", curve.name, *n, nm),
                          "expected n above 0");
        return *n;
      },
      range);
}

Spectrum sample_k(const DispersionCurve& curve, Extrapolation outside, SpectralRange range) {
  if (!curve.k) return {};
  const double low = curve.k->low_nm, high = curve.k->high_nm;
  return spectrum_of(
      [&](double nm) {
        if (outside == Extrapolation::refuse && is_outside(nm, low, high)) throw refusal(curve, "k", nm, low, high);
        return std::max(0.0, curve.k->value(std::clamp(nm, low, high)));
      },
      range);
}

Curve curve_of(LinearTable table) {
  const double low = table.low(), high = table.high();
  const auto gap = gap_between(table.rows(), first_nm, last_nm);
  return {std::move(table), low, high, false, gap};
}

std::optional<double> abbe_number(const DispersionCurve& curve) {
  const IndexSample d = curve.sample(line_d_nm), f = curve.sample(line_f_nm), c = curve.sample(line_c_nm);
  if (d.extrapolated || f.extrapolated || c.extrapolated || !d.n || !f.n || !c.n || *f.n == *c.n) return std::nullopt;
  return (*d.n - 1) / (*f.n - *c.n);
}

std::string outside_note(const DispersionCurve& curve, Extrapolation outside, SpectralRange range) {
  if (!curve.n) return {};
  const double from = cells(range).nm.front(), to = cells(range).nm.back();
  const double low = curve.n->low_nm, high = curve.n->high_nm;
  const auto outside_of = [&](double low_nm, double high_nm) {
    std::string where;
    if (is_outside(from, low_nm, high_nm)) where = fmt::format("below {:.6g} nm", std::min(low_nm, to));
    if (is_outside(to, low_nm, high_nm))
      where += fmt::format("{}above {:.6g} nm", where.empty() ? "" : " and ", std::max(high_nm, from));
    return where;
  };
  const std::string where = outside_of(low, high);
  std::vector<std::string> notes;
  if (range != SpectralRange::visible && curve.k) // pictures hold it silently: few data of k begin at 380 nm
    if (const std::string of_k = outside_of(curve.k->low_nm, curve.k->high_nm); !of_k.empty())
      notes.push_back(fmt::format("k is held {}", of_k));
  const bool held = outside == Extrapolation::hold || !curve.n->formula;
  if (!where.empty())
    notes.push_back(
        fmt::format("n is {} {} (data: {:.6g}..{:.6g} nm)", held ? "held" : "extrapolated", where, low, high));
  if (const auto gap = curve.n->gap_nm)
    notes.push_back(fmt::format("n is a straight line from {:.6g} to {:.6g} nm, where the table has a gap",
                                gap->front(), gap->back()));
  return notes.empty() ? std::string{} : fmt::format("{}: {}", curve.name, fmt::join(notes, "; "));
}

DispersionCurve constant_index(double n) {
  if (!std::isfinite(n) || !(n > 0))
    throw bad_input("constant", fmt::format("the index of refraction is {}", n), "expected a number above 0");
  return index_only("constant", {[n](double) { return n; }, 0, std::numeric_limits<double>::infinity(), true});
}

DispersionCurve sellmeier(std::span<const double> b, std::span<const double> c_um2, double low_nm, double high_nm) {
  if (b.size() != c_um2.size())
    throw bad_input("sellmeier", fmt::format("there are {} values of b and {} of c", b.size(), c_um2.size()),
                    "expected as many of one as of the other");
  require_finite(b, "sellmeier");
  require_finite(c_um2, "sellmeier");
  require_range(low_nm, high_nm, "sellmeier");
  std::vector<double> coefficients{0};
  for (std::size_t i = 0; i < b.size(); ++i) coefficients.insert(coefficients.end(), {b[i], c_um2[i]});
  const auto value = [coefficients](double nm) { return index_by_formula(2, coefficients, nm / 1000); };
  return index_only("sellmeier", {value, low_nm, high_nm, true});
}

DispersionCurve cauchy(std::span<const double> coefficients, double low_nm, double high_nm) {
  require_finite(coefficients, "cauchy");
  require_range(low_nm, high_nm, "cauchy");
  // Horner's rule in 1 / l^2.
  const auto value = [c = std::vector<double>(coefficients.begin(), coefficients.end())](double nm) {
    const double x = 1e6 / (nm * nm);
    double n = 0;
    for (auto factor = c.rbegin(); factor != c.rend(); ++factor) n = n * x + *factor;
    return n;
  };
  return index_only("cauchy", {value, low_nm, high_nm, true});
}

DispersionCurve tabulated(std::span<const std::array<double, 2>> nm_n) {
  return index_only("table", curve_of(LinearTable(sorted_rows(nm_n, Duplicates::refuse, "table"))));
}

DispersionCurve control_points(std::span<const std::array<double, 2>> nm_n) {
  std::vector<Row> rows = sorted_rows(nm_n, Duplicates::refuse, "points");
  const double low = rows.front()[0], high = rows.back()[0];
  return index_only("points", {MonotoneCubic(std::move(rows)), low, high, false});
}

} // namespace nephroid::optics
