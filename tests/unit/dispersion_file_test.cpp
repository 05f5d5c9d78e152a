// SPDX-License-Identifier: Apache-2.0
// Malformed dispersion files: each answers with one line that names the file, the line where it can, and what is expected.
#include "optics/dispersion.h"
#include "tests/support/errors.h"

namespace nephroid::dispersion_file_test {

using nephroid::Error;
using nephroid::optics::parse_dispersion;

struct Malformed {
  const char* name;
  const char* yaml;
  const char* line;
};
/// Names the case where GoogleTest prints one that failed.
void PrintTo(const Malformed& file, std::ostream* out) { *out << file.name; }

class MalformedFile : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedFile, IsRefusedWithOneLine)
{
  EXPECT_EQ(refusal_of([] { parse_dispersion(GetParam().yaml, "f.yml"); }), GetParam().line);
}

constexpr const char* no_map = "f.yml: this is no refractiveindex.info file; expected a YAML map with a DATA list";
constexpr const char* no_list = "f.yml:1: DATA is not a list with entries; expected a list of \"- type: ...\" entries";

const Malformed cases[] = {
    {"Empty", "", no_map},
    {"Blank", " \n\n", no_map},
    {"Text", "just words", no_map},
    {"List", "- 1\n- 2\n", no_map},
    {"NoData", "COMMENTS: none\n", "f.yml: there is no DATA; expected a DATA list with formulas or tables"},
    {"LowerCaseData", "data:\n  - type: constant\n", "f.yml: there is no DATA; expected a DATA list with formulas or tables"},
    {"DataIsText", "DATA: 1.5\n", no_list},
    {"DataIsEmpty", "DATA: []\n", no_list},
    {"DataIsNull", "DATA:\n", "f.yml:2: DATA is not a list with entries; expected a list of \"- type: ...\" entries"},
    {"EntryIsText", "DATA:\n  - 1.5\n", "f.yml:2: the entry is not a map; expected \"- type: ...\" and its data"},
    {"NoType", "DATA:\n  - data: 1\n", "f.yml:2: the entry has no \"type\""},
    {"TypeIsList", "DATA:\n  - type: [1]\n", "f.yml:2: \"type\" is not text; expected numbers separated by blanks"},
    {"UnknownType", "DATA:\n  - type: tabulated\n",
     "f.yml:2: the type is \"tabulated\"; expected formula 1 to 9, tabulated n, nk or k, or constant; did you mean \"tabulated n\"?"},
    {"FormulaZero", "DATA:\n  - type: formula 0\n",
     "f.yml:2: the type is \"formula 0\"; expected formula 1 to 9, tabulated n, nk or k, or constant; did you mean \"formula 1\"?"},
    {"FormulaTen", "DATA:\n  - type: formula 10\n",
     "f.yml:2: the type is \"formula 10\"; expected formula 1 to 9, tabulated n, nk or k, or constant; did you mean \"formula 1\"?"},
    {"Nonlinear", "DATA:\n  - type: tabulated n2\n",
     "f.yml:2: the type is \"tabulated n2\"; expected formula 1 to 9, tabulated n, nk or k, or constant; did you mean \"tabulated nk\"?"},
    {"FormulaWithoutRange", "DATA:\n  - type: formula 1\n    coefficients: 0 1 1\n", "f.yml:2: the entry has no \"wavelength_range\""},
    {"FormulaWithoutCoefficients", "DATA:\n  - type: formula 1\n    wavelength_range: 0.3 2.5\n",
     "f.yml:2: the entry has no \"coefficients\""},
    {"RangeOfOne", "DATA:\n  - type: formula 1\n    wavelength_range: 0.3\n    coefficients: 0\n",
     "f.yml:3: the wavelength range is \"0.3\"; expected two numbers in micrometres, the lower first, above 0"},
    {"RangeTurned", "DATA:\n  - type: formula 1\n    wavelength_range: 2.5 0.3\n    coefficients: 0\n",
     "f.yml:3: the wavelength range is \"2.5 0.3\"; expected two numbers in micrometres, the lower first, above 0"},
    {"RangeOfWords", "DATA:\n  - type: formula 1\n    wavelength_range: 0.3 to 2.5\n    coefficients: 0\n",
     "f.yml:3: \"to\" is no number; expected a finite number such as 1.5168 or 2.86E-06"},
    {"RangeFromZero", "DATA:\n  - type: formula 1\n    wavelength_range: 0 2.5\n    coefficients: 0\n",
     "f.yml:3: the wavelength range is \"0 2.5\"; expected two numbers in micrometres, the lower first, above 0"},
    {"NoCoefficients", "DATA:\n  - type: formula 1\n    wavelength_range: 0.3 2.5\n    coefficients: \"\"\n",
     "f.yml:4: there are no coefficients; expected at least one"},
    {"CoefficientIsNoNumber", "DATA:\n  - type: formula 1\n    wavelength_range: 0.3 2.5\n    coefficients: 0 1,5 0.1\n",
     "f.yml:4: \"1,5\" is no number; expected a finite number such as 1.5168 or 2.86E-06"},
    {"CoefficientIsNan", "DATA:\n  - type: formula 1\n    wavelength_range: 0.3 2.5\n    coefficients: 0 nan\n",
     "f.yml:4: \"nan\" is no number; expected a finite number such as 1.5168 or 2.86E-06"},
    {"CoefficientOverflows", "DATA:\n  - type: formula 1\n    wavelength_range: 0.3 2.5\n    coefficients: 0 1e999\n",
     "f.yml:4: \"1e999\" is no number; expected a finite number such as 1.5168 or 2.86E-06"},
    {"TooManyCoefficients", "DATA:\n  - type: formula 8\n    wavelength_range: 0.3 2.5\n    coefficients: 1 2 3 4 5\n",
     "f.yml:4: formula 8 has 5 coefficients; expected at most 4"},
    {"TableWithoutData", "DATA:\n  - type: tabulated n\n", "f.yml:2: the entry has no \"data\""},
    {"TypeOfManyLetters", "DATA:\n  - type: fffffffffffffffffffffffffffffffffffffffffffffffffffffffffffff\n",
     "f.yml:2: the type is \"ffffffffffffffffffffffffffffffffffffffff\"; expected formula 1 to 9, tabulated n, nk or k, or constant"},
    {"RangeOfManyNumbers",
     "DATA:\n  - type: formula 1\n    wavelength_range: 1 2 3 4 5 6 7 8 9 1 2 3 4 5 6 7 8 9 1 2 3 4 5 6 7 8 9\n    coefficients: 1\n",
     "f.yml:3: the wavelength range is \"1 2 3 4 5 6 7 8 9 1 2 3 4 5 6 7 8 9 1 2 \"; expected two numbers in micrometres, the lower first, "
     "above 0"},
    {"TableIsEmpty", "DATA:\n  - type: tabulated n\n    data: \"\"\n", "f.yml:3: the table is empty; expected at least one row of numbers"},
    {"TableOfBlanks", "DATA:\n  - type: tabulated n\n    data: |\n\n\n",
     "f.yml:3: the table is empty; expected at least one row of numbers"},
    {"TableIsList", "DATA:\n  - type: tabulated n\n    data: [0.5, 1.5]\n",
     "f.yml:3: \"data\" is not text; expected numbers separated by blanks"},
    {"RowTooShort", "DATA:\n  - type: tabulated nk\n    data: |\n        0.5 1.5 0.1\n        0.6 1.5\n",
     "f.yml:5: the row has 2 numbers; expected 3: the wavelength in micrometres, n and k"},
    {"RowTooLong", "DATA:\n  - type: tabulated n\n    data: |\n        0.5 1.5 0.1\n",
     "f.yml:4: the row has 3 numbers; expected 2: the wavelength in micrometres and the value"},
    {"RowAfterABlankOne", "DATA:\n  - type: tabulated k\n    data: |\n        0.5 1.5\n\n        0.6 x\n",
     "f.yml:6: \"x\" is no number; expected a finite number such as 1.5168 or 2.86E-06"},
    {"RowWithUnit", "DATA:\n  - type: tabulated n\n    data: |\n        500nm 1.5\n",
     "f.yml:4: \"500nm\" is no number; expected a finite number such as 1.5168 or 2.86E-06"},
    {"RowIsInfinite", "DATA:\n  - type: tabulated n\n    data: |\n        0.5 inf\n",
     "f.yml:4: \"inf\" is no number; expected a finite number such as 1.5168 or 2.86E-06"},
    {"NegativeWavelength", "DATA:\n  - type: tabulated n\n    data: |\n        -0.5 1.5\n",
     "f.yml:4: the wavelength is -0.5 um; expected a wavelength above 0"},
    {"ConstantWithoutValue", "DATA:\n  - type: constant\n", "f.yml:2: the entry has no \"value\""},
    {"SecondEntryBroken", "DATA:\n  - type: constant\n    value: 1.5\n  - type: tabulated k\n    data: |\n        0.5\n",
     "f.yml:6: the row has 1 numbers; expected 2: the wavelength in micrometres and the value"},
    {"BrokenYaml", "DATA:\n  - type: [\n",
     "f.yml:3: broken YAML: end of sequence flow not found; expected a file of the refractiveindex.info database"},
    {"Tabs", "DATA:\n\t- type: constant\n",
     "f.yml:2: broken YAML: illegal block entry; expected a file of the refractiveindex.info database"},
};

INSTANTIATE_TEST_SUITE_P(Dispersion, MalformedFile, testing::ValuesIn(cases),
                         [](const auto& test) { return std::string(test.param.name); });

} // namespace nephroid::dispersion_file_test
