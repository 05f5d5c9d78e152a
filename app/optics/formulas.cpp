// SPDX-License-Identifier: Apache-2.0
#include "optics/formulas.h"

#include <cmath>
#include <limits>

namespace nephroid::optics {
namespace {

/// Coefficients as the database counts them, from 1; those that a file leaves out are 0.
class Coefficients {
public:
  explicit Coefficients(std::span<const double> values) : values_(values) {}
  double operator[](std::size_t number) const { return number <= values_.size() ? values_[number - 1] : 0; }

  /// The sum of term(factor, parameter) over the pairs from (first, first + 1) to the end.
  template <class Term>
  double sum(std::size_t first, Term term) const
  {
    double result = 0;
    for (std::size_t i = first; i <= values_.size(); i += 2)
      if ((*this)[i] != 0) result += term((*this)[i], (*this)[i + 1]);
    return result;
  }

private:
  std::span<const double> values_;
};

/// Formula 4's resonance c l^p / (l^2 - a^b); 0 where c is 0, even on the pole (a = b = 0 gives a^b = 1).
double resonance(double c, double p, double a, double b, double um)
{
  return c == 0 ? 0 : c * std::pow(um, p) / (um * um - std::pow(a, b));
}

double gas(const Coefficients& c, double um)
{
  return 1 + c[1] + c.sum(2, [&](double b, double pole) { return b / (pole - 1 / (um * um)); });
}

double herzberger(const Coefficients& c, double um)
{
  const double l2 = um * um, pole = 1 / (l2 - 0.028);
  return c[1] + c[2] * pole + c[3] * pole * pole + c[4] * l2 + c[5] * l2 * l2 + c[6] * l2 * l2 * l2;
}

/// Formula 8, a Lorentz-Lorenz form: (n^2 - 1) / (n^2 + 2) = r, so n^2 = (1 + 2 r) / (1 - r).
double retro(const Coefficients& c, double um)
{
  const double l2 = um * um;
  const double r = c[1] + (c[2] == 0 ? 0 : c[2] * l2 / (l2 - c[3])) + c[4] * l2;
  return std::sqrt((1 + 2 * r) / (1 - r));
}

double exotic(const Coefficients& c, double um)
{
  const double l2 = um * um, d = um - c[5];
  return std::sqrt(c[1] + (c[2] == 0 ? 0 : c[2] / (l2 - c[3])) + (c[4] == 0 ? 0 : c[4] * d / (d * d + c[6])));
}

} // namespace

int most_coefficients(int formula)
{
  switch (formula) {
  case 4:
    return 17;
  case 7:
    return 6;
  case 8:
    return 4;
  case 9:
    return 6;
  default:
    return 0;
  }
}

double index_by_formula(int formula, std::span<const double> coefficients, double um)
{
  const Coefficients c(coefficients);
  const double l2 = um * um;
  const auto power = [&](double factor, double exponent) { return factor * std::pow(um, exponent); };
  switch (formula) {
  case 1:
    return std::sqrt(1 + c[1] + c.sum(2, [&](double b, double pole) { return b * l2 / (l2 - pole * pole); }));
  case 2:
    return std::sqrt(1 + c[1] + c.sum(2, [&](double b, double pole) { return b * l2 / (l2 - pole); }));
  case 3:
    return std::sqrt(c[1] + c.sum(2, power));
  case 4:
    return std::sqrt(c[1] + resonance(c[2], c[3], c[4], c[5], um) + resonance(c[6], c[7], c[8], c[9], um) + c.sum(10, power));
  case 5:
    return c[1] + c.sum(2, power);
  case 6:
    return gas(c, um);
  case 7:
    return herzberger(c, um);
  case 8:
    return retro(c, um);
  case 9:
    return exotic(c, um);
  default:
    return std::numeric_limits<double>::quiet_NaN();
  }
}

} // namespace nephroid::optics
