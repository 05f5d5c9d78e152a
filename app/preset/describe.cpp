// SPDX-License-Identifier: Apache-2.0
// The preset and its sections but "scene" described.
#include "preset/describe.h"

#include "preset/choices.h"

namespace nephroid::preset {

void describe(Fields& v, Stop& s)
{
  static_assert(default_passes == 64, "the sentence says so");
  v.about("Stop", "When a run is done: at the first of these; without any, after 64 passes.");
  v.field({.name = "seconds", .sentence = "Time of work.", .unit = "s", .bounds = within(0.001, 1e7)}, s.seconds);
  v.field({.name = "passes", .sentence = "Number of passes.", .bounds = within(1, max_passes)}, s.passes);
  v.field(
      {.name = "error",
       .sentence = "The error at which the picture is good enough: against the reference where there is one, else as the run estimates it.",
       .bounds = within(1e-9, 1e9)},
      s.error);
  v.field({.name = "metric", .sentence = "What `error` is measured in."}, s.metric);
}

void describe(Fields& v, Reference& r)
{
  v.about("Reference", "What a picture is measured against.");
  v.shorthand(Bare::text, Reference::Type::file, "file");
  using Type = Reference::Type;
  v.type({.name = "type", .sentence = "Where the reference comes from."}, r.type);
  switch (r.type) {
  case Type::file:
    v.field({.name = "file", .sentence = "A picture of the run's size.", .text = Text::file, .required = true}, r.file);
    break;
  case Type::recipe:
    v.settings(r.settings);
    v.field({.name = "passes", .sentence = "Passes of each of the two seeds.", .bounds = within(1, max_passes)}, r.passes);
    v.field({.name = "seed",
             .sentence = "The first of its two seeds, the other is the next; neither may be the run's.",
             .bounds = within(0, 18446744073709551614.0)},
            r.seed);
    v.field(
        {.name = "seconds", .sentence = "Refuse to begin where making it would take longer.", .unit = "s", .bounds = within(0.001, 1e7)},
        r.seconds);
    break;
  }
}

void describe(Fields& v, Measure& m)
{
  v.about("Measure", "What a run notes about its error.");
  v.field({.name = "estimate", .sentence = "Estimate the error of the run without a reference, from two independent halves of it."},
          m.estimate);
  v.field({.name = "perceptual", .sentence = "Also log iw_ssim, flip and hdr_flip against the reference, which cost more."}, m.perceptual);
  v.field({.name = "mask",
           .sentence = "A picture of the run's size: its pixels that are not 0 are measured on their own too.",
           .text = Text::file},
          m.mask);
}

void describe(Fields& v, Key& k)
{
  v.about("Key", "The value of a field at a frame.");
  v.field({.name = "frame",
           .sentence = "Which frame, from 0; it may lie beyond the last one that is rendered.",
           .bounds = within(0, 1000000),
           .required = true},
          k.frame);
  v.field({.name = "value",
           .sentence = "The field's value: a number, or as many numbers as the field has.",
           .count = {1, 100},
           .bare_number = true,
           .required = true},
          k.value);
}

void describe(Fields& v, Track& t)
{
  v.about("Track", "How one field changes; it is held before the first key and after the last.");
  v.field({.name = "path",
           .sentence = "The field, as --set names it: scene.objects.0.transform.rotate_deg. It holds a number or a list of numbers.",
           .text = Text::line,
           .required = true},
          t.path);
  v.field({.name = "interpolation", .sentence = "What the value is between two keys; whole numbers are rounded."}, t.interpolation);
  v.field({.name = "keys", .sentence = "Values at frames, by rising frame.", .count = {1, max_frames}, .required = true}, t.keys);
}

void describe(Fields& v, Animation& a)
{
  v.about("Animation", "Frames in which fields of the preset change.");
  v.field({.name = "frames", .sentence = "How many, counted from frame 0.", .bounds = within(1, max_frames)}, a.frames);
  v.field({.name = "fps", .sentence = "Frames a second of the video.", .unit = "1/s", .bounds = within(0.1, 1000)}, a.fps);
  v.field({.name = "tracks", .sentence = "The fields that change.", .count = {0, 1000}}, a.tracks);
}

void describe(Fields& v, Preset& p)
{
  v.about("Preset", "A Nephroid preset: everything a run depends on.");
  v.field({.name = "name", .sentence = "A short name; without one, the file's name without .json.", .text = Text::line}, p.name);
  v.field({.name = "description", .sentence = "One line for `nephroid presets`.", .text = Text::line}, p.description);
  v.engine({.name = "engine", .sentence = "Which engine renders it."}, p.settings);
  v.field({.name = "unit", .sentence = "What one unit of length is."}, p.unit);
  v.field({.name = "seed",
           .sentence = "Seed of the random numbers: the same seed gives the same bits.",
           .bounds = within(0, 18446744073709551615.0)},
          p.seed);
  v.field({.name = "white",
           .sentence = "The luminance Y (without the factor 683) that becomes 1 in the picture.",
           .unit = "W/(m^2 sr)",
           .bounds = within(1e-12, 1e12)},
          p.white);
  v.field({.name = "scene", .sentence = "What there is to see."}, p.scene);
  v.settings(p.settings);
  v.field({.name = "stop", .sentence = "When the run is done."}, p.stop);
  v.field({.name = "reference", .sentence = "What the picture is measured against while it is rendered."}, p.reference);
  v.field({.name = "measure", .sentence = "What a run notes about its error."}, p.measure);
  v.field({.name = "animation", .sentence = "Frames in which fields of the preset change."}, p.animation);
  v.field({.name = "leave_out", .sentence = "Leave out what the scene does not need: it takes time and changes no picture."}, p.leave_out);
}

} // namespace nephroid::preset
