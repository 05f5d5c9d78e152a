// SPDX-License-Identifier: Apache-2.0
// The section "animation" described, as describe.h does it for all else.
#pragma once
#include "preset/field.h"
#include "preset/preset.h"

namespace nephroid::preset {

template <>
struct Choices<Track::Interpolation> {
  using Interpolation = Track::Interpolation;
  static constexpr Choice<Interpolation> all[] = {
      {Interpolation::linear, "linear", "Straight lines between keys."},
      {Interpolation::smooth, "smooth", "A smooth curve through the keys that never goes beyond them (monotone cubic)."}};
};

template <>
struct About<Key> {
  static constexpr std::string_view name = "Key", sentence = "The value of a field at a frame.";
};
template <>
struct About<Track> {
  static constexpr std::string_view name = "Track", sentence = "How one field changes; it is held before the first key and after the last.";
};
template <>
struct About<Animation> {
  static constexpr std::string_view name = "Animation", sentence = "Frames in which fields of the preset change.";
};

template <class V, Is<Key> S>
void describe(V& v, S& k)
{
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

template <class V, Is<Track> S>
void describe(V& v, S& t)
{
  v.field({.name = "path",
           .sentence = "The field, as --set names it: scene.objects.0.transform.rotate_deg. It holds a number or a list of numbers.",
           .text = Text::line,
           .required = true},
          t.path);
  v.field({.name = "interpolation", .sentence = "What the value is between two keys; whole numbers are rounded."}, t.interpolation);
  v.field({.name = "keys", .sentence = "Values at frames, by rising frame.", .count = {1, max_frames}, .required = true}, t.keys);
}

template <class V, Is<Animation> S>
void describe(V& v, S& a)
{
  v.field({.name = "frames", .sentence = "How many, counted from frame 0.", .bounds = within(1, max_frames)}, a.frames);
  v.field({.name = "fps", .sentence = "Frames a second of the video.", .unit = "1/s", .bounds = within(0.1, 1000)}, a.fps);
  v.field({.name = "tracks", .sentence = "The fields that change.", .count = {0, 1000}}, a.tracks);
}

} // namespace nephroid::preset
