// SPDX-License-Identifier: Apache-2.0
// "Pictures": a viewer for each size of picture; page/report.js flips between the pictures of one.
#include "measure/difference.h"
#include "measure/report_page.h"
#include "measure/report_text.h"

#include <algorithm>

namespace nephroid::measure {
namespace {

using Kind = ReportPicture::Kind;

/// Smaller pictures are shown several times as large, by a whole number, up to this width.
constexpr int comfortable_width = 640;

const char* word(Kind kind)
{
  switch (kind) {
  case Kind::run:
    return "run";
  case Kind::reference:
    return "reference";
  case Kind::difference:
    return "difference";
  }
  return "";
}

std::string joined(const std::vector<std::size_t>& numbers, const char* between, std::size_t counted_from)
{
  std::string text;
  for (const std::size_t number : numbers) append(text, "{}{}", text.empty() ? "" : between, number + counted_from);
  return text;
}

/// A reference says whose it is where there are several.
std::string caption(const Report& report, const PictureGroup& group, const ReportPicture& picture)
{
  if (picture.kind == Kind::reference) {
    const auto references =
        std::count_if(group.pictures.begin(), group.pictures.end(), [](const auto& other) { return other.kind == Kind::reference; });
    return references > 1 ? "reference of " + joined(picture.of, ", ", 1) : "reference";
  }
  if (picture.kind == Kind::run) return report.labels[*picture.run];
  return picture.from ? fmt::format("{} − {}", *picture.run + 1, *picture.from + 1) : fmt::format("{} − reference", *picture.run + 1);
}

/// The key that shows it, where it has one of its own.
std::string key(const ReportPicture& picture)
{
  if (picture.kind == Kind::reference) return "<kbd>r</kbd>";
  if (picture.kind == Kind::difference) return "<kbd>d</kbd>";
  return *picture.run < 9 ? fmt::format("<kbd>{}</kbd>", *picture.run + 1) : std::to_string(*picture.run + 1);
}

std::string colour_bar(const PictureGroup& group)
{
  constexpr int stops = 32;
  std::string colours;
  for (int i = 0; i <= stops; ++i) {
    const auto colour = map_colour(i / double{stops});
    append(colours, ", rgb({} {} {})", colour[0], colour[1], colour[2]);
  }
  return fmt::format(
      "<div class=\"scale\"><span>difference: 0</span><i style=\"background: linear-gradient(to right{})\"></i><span>{:g} CIELAB "
      "units and more</span></div>\n",
      colours, group.difference_scale);
}

/// Which runs the picture belongs to, counted from 0, for the script.
std::string runs_attribute(const ReportPicture& picture)
{
  if (picture.run) return fmt::format(" data-run=\"{}\"", *picture.run);
  return fmt::format(" data-runs=\"{}\"", joined(picture.of, " ", 0));
}

std::string viewer(const Report& report, const PictureGroup& group)
{
  std::string html =
      fmt::format("<figure class=\"viewer\" tabindex=\"0\">\n<div class=\"stage\" style=\"--aspect:{}; --width:{}px\">\n",
                  static_cast<double>(group.width) / group.height, group.width * std::max(1, comfortable_width / group.width));
  std::string buttons;
  for (const ReportPicture& picture : group.pictures) {
    const std::string name = escaped(caption(report, group, picture));
    append(html, "<img width=\"{}\" height=\"{}\" alt=\"{}\" data-kind=\"{}\"{} src=\"data:image/png;base64,{}\">\n", group.width,
           group.height, name, word(picture.kind), runs_attribute(picture), base64(picture.png));
    append(buttons, "<button type=\"button\">{} {}</button>\n", key(picture), name);
  }
  append(html, "</div>\n<div class=\"buttons\">\n{}</div>\n", buttons);
  if (group.difference_scale > 0) html += colour_bar(group);
  return html +
         fmt::format("<figcaption>{} × {} pixels, at full size; runs and references as image.png shows them. Wheel: zoom; drag: pan; "
                     "<kbd>←</kbd> <kbd>→</kbd>: flip; <kbd>d</kbd>: the shown run's difference; <kbd>0</kbd>: the whole "
                     "picture.</figcaption></figure>\n",
                     group.width, group.height);
}

} // namespace

std::string pictures_section(const Report& report)
{
  std::string html = "<section id=\"pictures\"><h2>Pictures</h2>\n";
  if (report.pictures.groups.empty()) html += "<p>No run has its picture any more.</p>\n";
  if (report.pictures.groups.size() > 1) html += "<p>The runs are of different sizes: those of one size can be compared.</p>\n";
  for (const PictureGroup& group : report.pictures.groups) html += viewer(report, group);
  for (const std::string& note : report.pictures.notes) append(html, "<p class=\"note\">{}</p>\n", escaped(note));
  return html + "</section>\n";
}

} // namespace nephroid::measure
