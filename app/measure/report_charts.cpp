// SPDX-License-Identifier: Apache-2.0
// One gnuplot draws all charts: its start costs more than a chart. What it draws becomes part of a page: ids are made unique, and
// black becomes the page's own colour, which is light on a dark page.
#include "measure/report_charts.h"

#include "base/error.h"
#include "measure/program.h"
#include "measure/report_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace nephroid::measure {
namespace {

constexpr std::array colours{"#3578d4", "#e07b30", "#229a6c", "#c4509c", "#8b6fd6", "#a98c12", "#2c9fb3", "#d24d4d"};
constexpr std::chrono::seconds time_limit{30};

struct Interval {
  double low = 0, high = 0;
  void take(double value)
  {
    low = low == 0 ? value : std::min(low, value);
    high = std::max(high, value);
  }
};

/// A string of gnuplot's in single quotes, inside which nothing but the quote itself means anything.
std::string quoted(const std::string& text)
{
  std::string result = "'";
  for (const char c : text)
    if (c == '\'')
      result += "''";
    else
      result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  return result + "'";
}

/// Room around the values: a logarithmic axis that begins and ends at a point hides it.
Interval widened(Interval values, double factor) { return {values.low / factor, values.high * factor}; }

/// Multiples of a round step, between three and seven of them: for the part of a decade that holds hardly a power of ten.
std::vector<double> even_levels(const Interval& axis)
{
  const double span = axis.high - axis.low, step = round_levels(span / 7, span).back();
  std::vector<double> levels;
  for (double i = std::ceil(axis.low / step); i * step <= axis.high; ++i) levels.push_back(i * step);
  return levels;
}

/// The labelled places of a logarithmic axis: powers of ten, with 2 and 5 between where there are few.
std::vector<double> levels_of_axis(const Interval& axis)
{
  constexpr double many_decades = 1000;
  constexpr std::size_t least = 3;
  std::vector<double> levels = round_levels(axis.low, axis.high);
  if (levels.size() < least) return even_levels(axis);
  if (axis.high / axis.low >= many_decades)
    std::erase_if(levels, [](double level) { return std::abs(std::log10(level) - std::round(std::log10(level))) > 1e-6; });
  return levels;
}

std::string ticks(const Interval& axis)
{
  std::string text;
  for (const double level : levels_of_axis(axis))
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", quoted(fmt::format("{:g}", level)), level);
  return text;
}

/// The legend stands below the chart, where it hides nothing.
std::size_t legend_rows(const Chart& chart)
{
  const auto has_label = [](const ChartLine& line) { return !line.label.empty(); };
  const auto labels = static_cast<std::size_t>(std::count_if(chart.lines.begin(), chart.lines.end(), has_label));
  return labels + !chart.noise_floors.empty() + chart.guide_exponent.has_value();
}

void add_axes(std::string& script, const Chart& chart, const Interval& x, const Interval& y)
{
  append(script, "reset\nset border 3 lw 0.8\nset tics nomirror scale 0.5\nset grid xtics ytics lt 1 lc rgb 'gray' lw 0.5\n");
  append(script, "set logscale x\nset xrange [{}:{}]\nset xtics ({})\nset xlabel 'work (s)' offset 0,0.3\nset bmargin {}\n", x.low, x.high,
         ticks(x), 3.8 + 1.2 * static_cast<double>(legend_rows(chart)));
  append(script, "set ylabel {} offset -0.5\n", quoted(chart.y_axis));
  if (chart.logarithmic) append(script, "set logscale y\nset yrange [{}:{}]\nset ytics ({})\n", y.low, y.high, ticks(y));
  append(script, "set key outside below left Left reverse maxcols 1 samplen 2.5 spacing 1.2\n");
}

void add_data(std::string& script, const Chart& chart)
{
  for (std::size_t i = 0; i < chart.lines.size(); ++i) {
    const Curve& curve = chart.lines[i].curve;
    append(script, "$line{} << end_of_data\n", i);
    for (std::size_t row = 0; row < curve.seconds.size(); ++row) append(script, "{} {}\n", curve.seconds[row], curve.errors[row]);
    script += "end_of_data\n";
  }
}

/// A slope to compare with, just below everything, where it hides nothing.
std::string guide(const Chart& chart)
{
  constexpr double below = 0.75;
  double factor = std::numeric_limits<double>::infinity();
  for (const ChartLine& line : chart.lines)
    for (std::size_t i = 0; i < line.curve.seconds.size(); ++i)
      factor = std::min(factor, below * line.curve.errors[i] / std::pow(line.curve.seconds[i], *chart.guide_exponent));
  return fmt::format("{} * x**({}) with lines lw 1.2 dt 3 lc rgb 'black' title 'slope {}'", factor, *chart.guide_exponent,
                     signed_text(*chart.guide_exponent, 1));
}

std::string plot_command(const Chart& chart)
{
  std::string plots;
  const auto add = [&](const std::string& plot) { plots += (plots.empty() ? "" : ", \\\n  ") + plot; };
  for (std::size_t i = 0; i < chart.lines.size(); ++i) {
    const ChartLine& line = chart.lines[i];
    const std::string title = line.label.empty() ? "notitle" : "title " + quoted(line.label);
    add(fmt::format("$line{} using 1:2 with linespoints lw {} {} pt 7 ps {} lc rgb '{}' {}", i, line.is_estimate ? 1.4 : 2,
                    line.is_estimate ? "dt 2" : "dt 1", line.is_estimate ? 0.25 : 0.4, run_colour(line.run), title));
  }
  for (std::size_t i = 0; i < chart.noise_floors.size(); ++i)
    add(fmt::format("{} with lines lw 1.2 dt '-' lc rgb 'black' {}", chart.noise_floors[i],
                    i == 0 ? "title 'noise floor of the reference'" : "notitle"));
  if (chart.guide_exponent) add(guide(chart));
  return "plot " + plots + "\n";
}

std::string script_of(const Chart& chart)
{
  Interval x, y;
  for (const ChartLine& line : chart.lines) {
    for (const double seconds : line.curve.seconds) x.take(seconds);
    for (const double error : line.curve.errors) y.take(error);
  }
  for (const double floor : chart.noise_floors) y.take(floor);
  std::string script;
  add_axes(script, chart, widened(x, 1.15), widened(y, 1.4));
  add_data(script, chart);
  return script + plot_command(chart);
}

void replace_all(std::string& text, std::string_view from, std::string_view to)
{
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) text.replace(at, from.size(), to);
}

/// A tag as the page needs it: ids of its own, the page's colour and font, no name of a namespace (HTML knows SVG's).
std::string adapted_tag(std::string tag, const std::string& prefix)
{
  for (const char* quote : {"'", "\""}) {
    replace_all(tag, fmt::format(" id={}", quote), fmt::format(" id={}{}", quote, prefix));
    replace_all(tag, fmt::format("href={}#", quote), fmt::format("href={}#{}", quote, prefix));
    for (const char* black : {"black", "gray", "rgb(  0,   0,   0)"})
      replace_all(tag, fmt::format("{0}{1}{0}", quote, black), fmt::format("{0}currentColor{0}", quote));
  }
  replace_all(tag, " font-family=\"sans-serif\"", "");
  replace_all(tag, "xmlns=\"http://www.w3.org/2000/svg\"", "role=\"img\"");
  replace_all(tag, "xmlns:xlink=\"http://www.w3.org/1999/xlink\"", "");
  return tag;
}

/// gnuplot's own <title> and <desc> are about gnuplot; those of its plots show as tooltips.
std::string without_titles(std::string svg)
{
  for (const std::string name : {"title", "desc"})
    for (std::size_t begin = svg.find("<" + name + ">"); begin != std::string::npos; begin = svg.find("<" + name + ">", begin)) {
      const std::string end_tag = "</" + name + ">";
      const std::size_t end = svg.find(end_tag, begin);
      if (end == std::string::npos) break;
      svg.erase(begin, end + end_tag.size() - begin);
    }
  return svg;
}

std::string adapted(const std::string& drawn, const std::string& prefix)
{
  const std::string svg = without_titles(drawn);
  std::string result;
  for (std::size_t at = 0; at < svg.size();) {
    const std::size_t begin = std::min(svg.find('<', at), svg.size());
    const std::size_t end = std::min(svg.find('>', begin), svg.size());
    result += svg.substr(at, begin - at);
    result += adapted_tag(svg.substr(begin, end - begin), prefix);
    at = end;
    if (at < svg.size()) result += svg[at++];
  }
  return result;
}

} // namespace

std::string run_colour(std::size_t run) { return colours[run % colours.size()]; }

std::vector<std::string> draw_charts(std::span<const Chart> charts)
{
  if (charts.empty()) return {};
  std::string script = "set encoding utf8\n";
  for (const Chart& chart : charts) {
    append(script, "set terminal svg size 960,{} dynamic noenhanced font 'sans-serif,14'\n", 400 + 26 * legend_rows(chart));
    script += script_of(chart);
  }
  const std::string drawn = run_program({"gnuplot", "--default-settings"}, script, time_limit);
  std::vector<std::string> svgs;
  for (std::size_t begin = drawn.find("<svg"); begin != std::string::npos; begin = drawn.find("<svg", begin + 1)) {
    const std::size_t end = drawn.find("</svg>", begin);
    if (end == std::string::npos) break;
    if (svgs.size() == charts.size()) break;
    std::string svg = adapted(drawn.substr(begin, end + 6 - begin), fmt::format("chart{}-", svgs.size()));
    svg.insert(4, fmt::format(" aria-label=\"{}\"", escaped(charts[svgs.size()].title))); // behind "<svg"
    svgs.push_back(std::move(svg));
  }
  if (svgs.size() != charts.size())
    throw failed("gnuplot", fmt::format("drew {} of {} charts", svgs.size(), charts.size()), {},
                 "see whether `gnuplot --version` is 5.4 or newer");
  return svgs;
}

} // namespace nephroid::measure
