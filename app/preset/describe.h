// SPDX-License-Identifier: Apache-2.0
// Every struct of the preset described once, as Fields (value.h) take it. Reading, writing, the schema and the editor
// walk over that.
//
//   v.about(name, sentence)           what the struct is called
//   v.shorthand(bare, e, name)        a bare number or text in place of the struct: its field of that name, of type e
//   v.type(name, sentence, e)         the enumeration that chooses the further fields: those of that type come next
//   v.field(name, sentence, x, more)  any other field; more: its unit, its range, ... (Field). x is a bool, a number,
//                                     a std::string, an enumeration, a described struct, a list or table of these, a
//                                     map from names to them, or a std::optional of any of these (make_type).
//   v.engine(name, sentence, s)       the word that names the preset's engine, whose settings s then are
//   v.settings(s)                     the section of settings that is called as their engine
// Fields come in the order in which files are written.
//
// Limits are chosen so that nothing later overflows: lengths and positions stay below 1e7 units, so that their squares
// and cubes fit single precision; scales between 1e-6 and 1e6.
#pragma once
#include "preset/preset.h"
#include "preset/value.h"

namespace nephroid::preset {

void describe(Fields& v, Dispersion& d);
void describe(Fields& v, LightSpectrum& s);
void describe(Fields& v, Reflectance& r);
void describe(Fields& v, Texture& t);
void describe(Fields& v, Coating& c);
void describe(Fields& v, Pane& p);
void describe(Fields& v, Material& m); // each type's fields are in its own file: app/scatter/material.cpp
void describe(Fields& v, Light& l);    // app/lights has it
void describe(Fields& v, PlaceAndTime& p);
void describe(Fields& v, Meter& m);
void describe(Fields& v, Scene& s);
void describe(Fields& v, Preset& p);

} // namespace nephroid::preset
