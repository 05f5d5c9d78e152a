// SPDX-License-Identifier: Apache-2.0
// The settings of engine 3 as preset/describe.h says.
#pragma once
#include "inverse/settings.h"
#include "preset/describe.h"

namespace nephroid::preset {

template <>
inline constexpr Choice<inverse::Picture::Type> choices<inverse::Picture::Type>[] = {
    {inverse::Picture::Type::file, "file", "A picture file, in the receiver's middle."},
    {inverse::Picture::Type::disc, "disc", "A disc."},
    {inverse::Picture::Type::ring, "ring", "A ring."},
    {inverse::Picture::Type::cross, "cross", "Two bars across each other."},
    {inverse::Picture::Type::bars, "bars", "Bars side by side."},
    {inverse::Picture::Type::star, "star", "A star."},
    {inverse::Picture::Type::gradient, "gradient", "From the background's brightness at the left to 1 at the right."},
    {inverse::Picture::Type::face, "face", "A shaded ball with eyes and a mouth, in grey levels."},
    {inverse::Picture::Type::text, "text", "Words."},
    {inverse::Picture::Type::qr, "qr", "A QR code, in whole cells, as large as fits."}};

template <>
inline constexpr Choice<inverse::Picture::Fit> choices<inverse::Picture::Fit>[] = {
    {inverse::Picture::Fit::contain, "contain", "As large as the receiver holds all of it."},
    {inverse::Picture::Fit::cover, "cover", "As small as it fills the receiver; what is beyond is cropped."}};

template <>
inline constexpr Choice<inverse::Light::Type> choices<inverse::Light::Type>[] = {
    {inverse::Light::Type::parallel, "parallel", "From one direction; with a 'sun_deg' of 0.533 as the sun's."},
    {inverse::Light::Type::point, "point", "A lamp: from one place."},
    {inverse::Light::Type::area, "area", "A lamp of some size, parallel to the front; each place of it is a point."},
    {inverse::Light::Type::mesh, "mesh", "A lamp with the shape of a mesh, such as a tube or a letter."},
    {inverse::Light::Type::sun, "sun",
     "The sun as it stands at a place and an hour, with its disc; the front looks to front_azimuth_deg and "
     "front_elevation_deg."}};

template <>
inline constexpr Choice<inverse::Light::Shape> choices<inverse::Light::Shape>[] = {
    {inverse::Light::Shape::disc, "disc", "A disc, or ellipse."},
    {inverse::Light::Shape::rectangle, "rectangle", "A rectangle."}};

template <>
inline constexpr Choice<inverse::Intensity::Type> choices<inverse::Intensity::Type>[] = {
    {inverse::Intensity::Type::rectangle, "rectangle", "The same within a rectangle of angles."},
    {inverse::Intensity::Type::ellipse, "ellipse", "The same within an ellipse of angles."},
    {inverse::Intensity::Type::batwing, "batwing",
     "Within an ellipse, stronger to the sides: a plane across the axis is lit evenly."},
    {inverse::Intensity::Type::cutoff, "cutoff",
     "As a low beam: a rectangle below a sharp cut through the axis, which rises on the right."},
    {inverse::Intensity::Type::picture, "picture", "A picture over angles."},
    {inverse::Intensity::Type::luminaire, "luminaire",
     "As an IES or EULUMDAT file says; the axis is its gamma 0, C 0 is to the right, C 90 up."}};

template <>
inline constexpr Choice<inverse::Settings::Kind> choices<inverse::Settings::Kind>[] = {
    {inverse::Settings::Kind::glass, "glass", "It refracts light, which enters through its flat front."},
    {inverse::Settings::Kind::mirror, "mirror",
     "Its relief reflects light, which comes from the side of the receivers; its flat back is away from both."}};

template <>
inline constexpr Choice<inverse::Settings::Method> choices<inverse::Settings::Method>[] = {
    {inverse::Settings::Method::assign, "assign",
     "Facet after facet goes where the pictures lack most light, until a sweep gains little; then all move together."},
    {inverse::Settings::Method::thesis, "thesis",
     "Draws from the pictures' joint probability, which two annealings and a correction adjust."},
    {inverse::Settings::Method::lens, "lens",
     "One picture by a smooth surface, whose light takes the shortest ways there."}};

template <>
inline constexpr Choice<inverse::Settings::Heights> choices<inverse::Settings::Heights>[] = {
    {inverse::Settings::Heights::flat, "flat", "All in one plane: the relief is as shallow as it can be."},
    {inverse::Settings::Heights::free, "free",
     "Where the walls between facets are lowest; the relief becomes deeper, as far as the constraints let it."}};

template <>
inline constexpr Choice<inverse::Settings::Outline> choices<inverse::Settings::Outline>[] = {
    {inverse::Settings::Outline::rectangle, "rectangle", "As wide and high as 'size_mm'."},
    {inverse::Settings::Outline::round, "round", "The disc, or ellipse, within it; with the method 'lens'."}};

template <>
inline constexpr Choice<inverse::Thesis::Sampling> choices<inverse::Thesis::Sampling>[] = {
    {inverse::Thesis::Sampling::exact, "exact", "From the cumulative sum."},
    {inverse::Thesis::Sampling::rejection, "rejection",
     "By acceptance and rejection, as printed: the same distribution, with more tries."}};

template <>
inline constexpr Choice<inverse::Thesis::Adjust> choices<inverse::Thesis::Adjust>[] = {
    {inverse::Thesis::Adjust::convergence, "convergence",
     "One number: how wide the light is at the last receiver, over the object."},
    {inverse::Thesis::Adjust::each, "each",
     "Four numbers a picture: its size, its place across and down, its distance."}};

} // namespace nephroid::preset

namespace nephroid::inverse {

inline constexpr std::string_view receiver_part = "parts of the receiver's shorter side";

inline void describe(preset::Fields& v, Picture& p) {
  v.about("InversePicture", "A grey picture that the object casts.");
  v.shorthand(preset::BareValue::text, Picture::Type::file, "file");
  using Type = Picture::Type;
  const auto part = [&](std::string_view name, std::string_view sentence, auto& value) {
    v.field(name, sentence, value, {.unit = receiver_part, .bounds = preset::within(0.001, 2)});
  };
  v.type("type", "What it shows.", p.type);
  const bool round = p.type == Type::disc || p.type == Type::ring || p.type == Type::star || p.type == Type::face;
  const bool words = p.type == Type::text || p.type == Type::qr;
  const bool straight = p.type == Type::cross || p.type == Type::bars;
  if (p.type == Type::file) {
    v.field("file", "A picture file.", p.file, {.text = preset::Text::file, .required = true});
    v.field("fit", "How large the file is.", p.fit);
    v.field("mirror", "Whether left and right are exchanged, before it is turned.", p.mirror);
    v.field("invert", "Whether dark becomes bright, as in a negative; what is transparent stays so.", p.invert);
    v.field("ground", "Luminance behind what is transparent.", p.ground,
            {.unit = "parts of white", .bounds = preset::within(0, 1)});
    v.field("tone",
            "Exponent on the file's luminance, of which the brightest pixel has 1: more than 1 darkens its greys.",
            p.tone, {.bounds = preset::within(0.1, 10)});
    v.field("levels", "Contrast: brightness, after the tone, that becomes dark, and that which becomes the brightest.",
            p.levels, {.unit = "parts of the file's brightest", .bounds = preset::within(0, 1)});
    v.field("vignette", "Width of the edge over which the file fades to the background.", p.vignette,
            {.unit = "parts of half the file's shorter side", .bounds = preset::within(0, 1)});
  }
  if (words) v.field("text", "What it says.", p.text, {.required = true});
  if (round) part("radius", "The outer radius.", p.radius);
  if (p.type == Type::ring || p.type == Type::star) part("inner", "The inner radius.", p.inner);
  if (straight) part("length", "Length of a bar.", p.length);
  if (p.type == Type::text) part("length", "Width of the words.", p.length);
  if (straight) part("width", "Width of a bar, and of the gap to the next one.", p.width);
  if (p.type == Type::bars || p.type == Type::star)
    v.field("count", "How many bars, or points of the star.", p.count, {.bounds = preset::within(1, 100)});
  if (p.type != Type::qr && p.type != Type::disc && p.type != Type::ring)
    v.field("turn_deg", "How far it is turned, counterclockwise; a file by multiples of 90.", p.turn_deg,
            {.unit = "degrees", .bounds = preset::within(-3600, 3600)});
  v.field("background", "Brightness where nothing is drawn; the drawing has 1.", p.background,
          {.bounds = preset::within(0, 0.99)});
}

inline void describe(preset::Fields& v, Light& l) {
  v.about("InverseLight", "What falls on the front of the object.");
  v.type("type", "Where the light comes from.", l.type);
  if (l.type == Light::Type::parallel) {
    v.field("tilt_deg", "Between the light and the front's normal; receivers stay where they are.", l.tilt_deg,
            {.unit = "degrees", .bounds = preset::within(-360, 360)});
    v.field("turn_deg", "The side to which tilted light goes: 0 is to the right, 90 up.", l.turn_deg,
            {.unit = "degrees", .bounds = preset::within(-360, 360)});
  } else if (l.type == Light::Type::sun) {
    v.field("place", "Where and when the sun is seen.", l.place, {.required = true});
  } else {
    v.field("distance_mm", "From the front.", l.distance_mm, {.unit = "mm", .bounds = preset::within(-1e6, 1e6)});
    v.field("offset_mm", "Beside the middle of the object: to the right and up.", l.offset_mm,
            {.unit = "mm", .bounds = preset::within(-1e5, 1e5)});
    if (l.type == Light::Type::mesh)
      v.field(
          "file",
          "The lamp's mesh in millimetres, its origin at the distance and offset: x to the right, y up, z away from "
          "the object. It is equally bright everywhere.",
          l.file, {.text = preset::Text::file, .required = true});
    if (l.type == Light::Type::area) {
      v.field("shape", "What the lamp looks like from the object.", l.shape);
      v.field("size_mm", "Width and height of the lamp, which blur the pictures.", l.size_mm,
              {.unit = "mm", .bounds = preset::within(0.001, 1e5)});
    }
  }
  v.field("spectrum",
          "Its colours: a CIE illuminant by name, or an object. Luminance counts then, and pictures are judged in "
          "colours. Without it the light is of wavelength_nm and band_nm, energy counts, and pictures are grey.",
          l.spectrum);
}

inline void describe(preset::Fields& v, Intensity& i) {
  v.about("InverseFar", "A luminous intensity that the object makes of the light, over angles, in place of pictures.");
  using Type = Intensity::Type;
  v.type("type", "How the intensity is spread.", i.type);
  if (i.type == Type::luminaire)
    v.field("file", "An IES or EULUMDAT file.", i.file, {.text = preset::Text::file, .required = true});
  else
    v.field("size_deg", "Width and height in angles, about the axis; of a cutoff the height below its cut.", i.size_deg,
            {.unit = "degrees", .bounds = preset::within(0.1, 160)});
  if (i.type == Type::picture)
    v.field("picture", "What fills it: a file, or an object.", i.picture, {.required = true});
  if (i.type != Type::luminaire && i.type != Type::picture)
    v.field("edge_deg", "Width of the edge over which it falls to nothing, but for a cut.", i.edge_deg,
            {.unit = "degrees", .bounds = preset::within(0, 80)});
  if (i.type == Type::cutoff)
    v.field("rise_deg", "How steeply the cut rises right of the axis.", i.rise_deg,
            {.unit = "degrees", .bounds = preset::within(0, 60)});
  v.field("candela",
          "The largest intensity that is wanted; a run is refused where 'lumens' do not suffice for it. Without, as "
          "much as the lamp gives; of a luminaire with 'lumens', what its file says.",
          i.candela, {.unit = "cd", .bounds = preset::within(1e-6, 1e12)});
  v.field("lumens",
          "Of the lamp, into all directions; of parallel light, on the front. Without, figures are for 1000 lm.",
          i.lumens, {.unit = "lm", .bounds = preset::within(1e-6, 1e12)});
}

inline void describe(preset::Fields& v, Receiver& r) {
  v.about("InverseReceiver", "A screen across the light, and its picture.");
  v.field("distance_mm", "From the object's facets, against which it is parallel.", r.distance_mm,
          {.unit = "mm", .bounds = preset::within(0.01, 1e6), .required = true});
  v.field("offset_mm",
          "Of its middle beside that of the object: to the right and up. Pictures that are beside each other fight "
          "less. Not with the method 'thesis'.",
          r.offset_mm, {.unit = "mm", .bounds = preset::within(-1e6, 1e6)});
  v.field("picture", "What the object casts there: a file, or an object.", r.picture, {.required = true});
  v.field("weight",
          "How much its picture counts beside the others'; the costs that are reported are of all pictures alike.",
          r.weight, {.bounds = preset::within(0.01, 100)});
  v.field(
      "light",
      "What falls on the front while this picture is seen: another light for another picture. Without, the light of "
      "all. Only with the method 'assign'.",
      r.light);
}

inline void describe(preset::Fields& v, Thesis& t) {
  v.about("InverseThesis", "Constants of the method \"thesis\".");
  using preset::within;
  const auto share = [&](std::string_view name, std::string_view sentence, auto& value, std::string_view unit = {}) {
    v.field(name, sentence, value, {.unit = unit, .bounds = within(0, 1)});
  };
  v.field("sampling", "How directions are drawn from the joint probability (5.1).", t.sampling);
  v.field(
      "directions",
      "Directions across and down that a facet's light is tried in; they cover the receivers as the facet sees them.",
      t.directions, {.bounds = within(1, 1024)});
  v.field("draws", "Draws of every facet that a cost is the mean of.", t.draws, {.bounds = within(1, 1024)});
  v.field("adjust", "What the first annealing changes.", t.adjust);
  v.field("cycles", "Cycles of each annealing; 0 leaves both out.", t.cycles, {.bounds = within(0, 1000)});
  v.field("moves", "Moves of a cycle, at one temperature.", t.moves, {.bounds = within(1, 1000)});
  v.field("temperature",
          "Temperature of the first cycle: a move that raises the cost by so much is taken with probability 1 / e.",
          t.temperature, {.unit = "of cost", .bounds = within(0, 1)});
  share("cooling", "The temperature of a cycle over that of the cycle before.", t.cooling);
  share("size_step", "Largest change in a move of the convergence, or of a picture's size.", t.size_step);
  v.field("size_limit", "Largest change of that in all.", t.size_limit, {.bounds = within(0, 0.9)});
  share("shift_step", "Largest change in a move of a picture's place.", t.shift_step, "parts of the receiver");
  share("shift_limit", "Largest change of that in all.", t.shift_limit, "parts of the receiver");
  share("distance_step", "Largest change in a move of a picture's distance.", t.distance_step, "parts of the distance");
  v.field("distance_limit", "Largest change of that in all.", t.distance_limit,
          {.unit = "parts of the distance", .bounds = within(0, 0.9)});
  share("extension_step", "Largest change in a move of k, the part of a picture's largest extension.",
        t.extension_step);
  share("overshoot_step", "Largest change in a move of o, the part of a picture's largest overshoot.",
        t.overshoot_step);
  v.field("corrections", "Rounds of the intensity correction at most; 0 leaves it out.", t.corrections,
          {.bounds = within(0, 1000)});
  v.field("patience", "Rounds without a gain after which no more follow.", t.patience, {.bounds = within(1, 1000)});
  v.field("worth", "A gain below this is none.", t.worth, {.unit = "of cost", .bounds = within(0, 1)});
  v.field("ratio_limit",
          "A round makes a cell brighter, or darker, by this factor at most, also where no light reached it.",
          t.ratio_limit, {.bounds = within(1, 1000)});
}

inline void describe(preset::Fields& v, Settings& s) {
  v.about("Inverse", "Settings of the engine \"inverse\".");
  using preset::within;
  v.field("kind", "Whether glass or a mirror turns the light.", s.kind);
  v.field("method", "How the facets' slopes are found.", s.method);
  v.field("size_mm", "Width and height of the object.", s.size_mm, {.unit = "mm", .bounds = within(0.1, 1e5)});
  v.field("outline", "What the object looks like from the front; light beside it is not there.", s.outline);
  v.field(
      "thickness_mm",
      "From the middle of the relief to the flat front; a sheet that holds the object is thicker by half the relief.",
      s.thickness_mm, {.unit = "mm", .bounds = within(0.01, 1e5)});
  v.field(
      "stock_mm",
      "In place of thickness_mm: the sheet that the object is cut from. The highest points of the relief are on one "
      "of its faces, the front is the other.",
      s.stock_mm, {.unit = "mm", .bounds = within(0.01, 1e5)});
  v.field("heights", "Where the middles of the facets are.", s.heights);
  v.field("min_thickness_mm", "No part of the object may be thinner.", s.min_thickness_mm,
          {.unit = "mm", .bounds = within(0.001, 1e5)});
  v.field("max_relief_mm", "From the lowest corner of a facet to the highest, at most.", s.max_relief_mm,
          {.unit = "mm", .bounds = within(0.001, 1e5)});
  v.field("max_slope_deg", "How far a facet may be tilted against the front.", s.max_slope_deg,
          {.unit = "degrees", .bounds = within(0.01, 90)});
  v.field("tool_radius_mm",
          "Of the cutter that mills the facets, each of which must be as wide as the cutter at least.",
          s.tool_radius_mm, {.unit = "mm", .bounds = within(0.001, 1e4)});
  v.field("layer_mm", "Thickness of the layers of a printer, which lie along the front: says how many the relief has.",
          s.layer_mm, {.unit = "mm", .bounds = within(0.001, 10)});
  v.field("draft_deg", "How far walls between facets lean at least, so that they can be milled or leave a mould.",
          s.draft_deg, {.unit = "degrees", .bounds = within(0, 30)});
  v.field("smoothing_normals",
          "Weight of facets that are unlike their neighbours, over 'smoothing_pictures': alpha_N of the thesis' (6.1).",
          s.smoothing_normals, {.bounds = within(0, 1000)});
  v.field("smoothing_pictures",
          "Weight of the pictures' error, where 'smoothing_normals' is above 0: alpha_P of (6.1).",
          s.smoothing_pictures, {.bounds = within(0.001, 1000)});
  v.field("facets", "Facets across and down.", s.facets, {.bounds = within(1, 1024)});
  v.field("mesh_error",
          "Of the method \"lens\": how far the mesh's flat triangles may send light from where the smooth surface "
          "sends it, in the mean of squares, where bright places count more. Half of it takes up to four times as many "
          "triangles. Without, 0.025, which leaves even grey even, or the picture's own rel_l2 where that is more.",
          s.mesh_error, {.unit = "cells", .bounds = within(0.001, 10)});
  v.field("index", "Index of refraction: a number, a file or an object.", s.index);
  v.field("wavelength_nm", "The wavelength that the index is taken at, where light.spectrum does not say it.",
          s.wavelength_nm, {.unit = "nm", .bounds = within(380, 780)});
  v.field(
      "band_nm",
      "Width of the light's band about wavelength_nm: its colours leave the object apart, which blurs the pictures.",
      s.band_nm, {.unit = "nm", .bounds = within(0, 400)});
  v.field("diffraction",
          "Whether facets spread light as slits do, by wavelength times distance over their width; without, light goes "
          "as rays do. A lens has no edges that would.",
          s.diffraction);
  v.field("light", "What falls on the front.", s.light);
  v.field(
      "front_azimuth_deg",
      "Where the front looks, for a light of type sun: 0 is north, 90 east, 180 south. To the right is then west to "
      "east for a front that looks south, as seen along the light.",
      s.front_azimuth_deg, {.unit = "degrees", .bounds = within(-360, 360)});
  v.field(
      "front_elevation_deg",
      "How far the front looks above the horizon: 0 is an upright pane, 90 a plate that lies with its front up; up on "
      "the plate is then away from front_azimuth_deg.",
      s.front_elevation_deg, {.unit = "degrees", .bounds = within(0, 90)});
  v.field(
      "sun_deg",
      "Diameter of the light's disc, which blurs the pictures. Without, 0.533 where the light is of type sun, else 0.",
      s.sun_deg, {.unit = "degrees", .bounds = within(0, 20)});
  v.field("scatter_deg", "How far a rough surface turns light, as a standard deviation; it blurs the pictures.",
          s.scatter_deg, {.unit = "degrees", .bounds = within(0, 10)});
  v.field("receiver_mm", "Width and height of every receiver; without, the object's.", s.receiver_mm,
          {.unit = "mm", .bounds = within(0.1, 1e6)});
  v.field("cells", "Cells of every picture, across and down.", s.cells, {.bounds = within(2, 1024)});
  v.field("frames",
          "How many pictures the judge takes between each receiver and the next one, as a screen that moves would show "
          "them.",
          s.frames, {.bounds = within(0, 64)});
  v.field("tolerances",
          "Judges the object with errors of making and of putting it up, too; takes five times as long again as to "
          "judge it.",
          s.tolerances);
  v.field("step",
          "Whether the object is written as object.step, too: planar faces or a B-spline surface. It takes the package "
          "nephroid-workshop, and minutes where there are many facets.",
          s.step);
  v.field("receivers", "The screens that light reaches, the nearest first.", s.receivers, {.count = {1, 16}});
  v.field("far",
          "An intensity over directions in place of 'receivers', which there are none of then. 'cells' are of its "
          "angles, even in their tangents.",
          s.far);
  v.field("thesis", "Constants of the method \"thesis\".", s.thesis);
}

} // namespace nephroid::inverse
