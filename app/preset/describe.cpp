// SPDX-License-Identifier: Apache-2.0
// The preset and its sections but "scene" described.
#include "preset/describe.h"

#include "preset/choices.h"

namespace nephroid::preset {

void describe(Fields& v, Stop& s) {
  static_assert(default_passes == 64, "the sentence says so");
  v.about("Stop", "When a run is done: at the first of these; without any, after 64 passes.");
  v.field("seconds", "Time of work.", s.seconds, {.unit = "s", .bounds = within(0.001, 1e7)});
  v.field("passes", "Number of passes.", s.passes, {.bounds = within(1, max_passes)});
  v.field("error",
          "The error at which the picture is good enough: against the reference where there is one, else as the run "
          "estimates it.",
          s.error, {.bounds = within(1e-9, 1e9)});
  v.field("metric", "What `error` is measured in.", s.metric);
}

void describe(Fields& v, Reference& r) {
  v.about("Reference", "What a picture is measured against.");
  v.shorthand(BareValue::text, Reference::Type::file, "file");
  using Type = Reference::Type;
  v.type("type", "Where the reference comes from.", r.type);
  if (r.type == Type::file)
    return v.field("file", "A picture of the run's size.", r.file, {.text = Text::file, .required = true});
  v.settings(r.settings);
  v.field("passes", "Passes of each of the two seeds.", r.passes, {.bounds = within(1, max_passes)});
  v.field("seed", "The first of its two seeds, the other is the next; neither may be the run's.", r.seed,
          {.bounds = within(0, 18446744073709551614.0)});
  v.field("seconds", "Refuse to begin where making it would take longer.", r.seconds,
          {.unit = "s", .bounds = within(0.001, 1e7)});
}

void describe(Fields& v, Measure& m) {
  v.about("Measure", "What a run notes about its error.");
  v.field("estimate", "Estimate the error of the run without a reference, from two independent halves of it.",
          m.estimate);
  v.field("perceptual", "Also log iw_ssim, flip and hdr_flip against the reference, which cost more.", m.perceptual);
  v.field("mask", "A picture of the run's size: its pixels that are not 0 are measured on their own too.", m.mask,
          {.text = Text::file});
}

void describe(Fields& v, Display& d) {
  v.about("Display", "How light becomes the 8 bits of image.png and of the window; image.exr stays linear.");
  v.field("gamut", "What becomes of colours that sRGB does not have, such as most single wavelengths.", d.gamut);
  v.field("tone", "What becomes of light above white.", d.tone);
  v.field("white_balance", "Which light is white.", d.white_balance);
}

void describe(Fields& v, Key& k) {
  v.about("Key", "The value of a field at a frame.");
  v.field("frame", "Which frame, from 0; it may lie beyond the last one that is rendered.", k.frame,
          {.bounds = within(0, 1000000), .required = true});
  v.field("value", "The field's value: a number, or as many numbers as the field has.", k.value,
          {.count = {1, 100}, .bare_number = true, .required = true});
}

void describe(Fields& v, Track& t) {
  v.about("Track", "How one field changes; it is held before the first key and after the last.");
  v.field("path",
          "The field, as --set names it: scene.objects.0.transform.rotate_deg. It holds a number or a list of numbers.",
          t.path, {.text = Text::line, .required = true});
  v.field("interpolation", "What the value is between two keys; whole numbers are rounded.", t.interpolation);
  v.field("keys", "Values at frames, by rising frame.", t.keys, {.count = {1, max_frames}, .required = true});
}

void describe(Fields& v, Animation& a) {
  v.about("Animation", "Frames in which fields of the preset change.");
  v.field("frames", "How many, counted from frame 0.", a.frames, {.bounds = within(1, max_frames)});
  v.field("fps", "Frames a second of the video.", a.fps, {.unit = "1/s", .bounds = within(0.1, 1000)});
  v.field("tracks", "The fields that change.", a.tracks, {.count = {0, 1000}});
}

void describe(Fields& v, Preset& p) {
  v.about("Preset", "A Nephroid preset: everything a run depends on.");
  v.field("name", "A short name; without one, the file's name without .json.", p.name, {.text = Text::line});
  v.field("description", "One line for `nephroid presets`.", p.description, {.text = Text::line});
  v.field("not_imported",
          "What the file that this was imported from has and this has not, a sentence each. The plan shows it.",
          p.not_imported, {.count = {0, max_rows}, .text = Text::line});
  v.engine("engine", "Which engine renders it.", p.settings);
  v.field("unit", "What one unit of length is.", p.unit);
  v.field("seed", "Seed of the random numbers: the same seed gives the same bits.", p.seed,
          {.bounds = within(0, 18446744073709551615.0)});
  v.field(
      "white",
      "The luminance Y (without the factor 683) that becomes 1 in the picture; \"auto\": fitted to the first picture.",
      p.white, {.unit = "W/(m^2 sr)", .bounds = within(1e-12, 1e12), .none_word = "auto"});
  v.field("display", "How the picture is shown.", p.display);
  v.field("scene", "What there is to see.", p.scene);
  v.settings(p.settings);
  v.field("stop", "When the run is done.", p.stop);
  v.field("reference", "What the picture is measured against while it is rendered.", p.reference);
  v.field("measure", "What a run notes about its error.", p.measure);
  v.field("animation", "Frames in which fields of the preset change.", p.animation);
  v.field("leave_out", "Leave out what the scene does not need: it takes time and changes no picture.", p.leave_out);
}

} // namespace nephroid::preset
