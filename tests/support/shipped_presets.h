// SPDX-License-Identifier: Apache-2.0
// Every shipped preset as the parameter of a test.
#pragma once
#include "preset/read.h"
#include "preset/settings_type.h"
#include "tests/support/test.h"

#include <cctype>

namespace nephroid::test {

/// Of one engine's.
inline std::vector<std::string> shipped_names(const std::string& engine)
{
  std::vector<std::string> names;
  for (const preset::ShippedPreset& shipped : preset::shipped_presets())
    if (preset::read_presets(shipped.name).front().settings.type().name == engine) names.push_back(shipped.name);
  return names;
}

/// Cuts the photons of a pass down to about `count`, which progressive photon maps send for each of up to 401 clusters.
inline void send_few_photons(preset::Preset& preset, int count)
{
  const bool each = spectral::settings(preset).estimator == spectral::Settings::Estimator::sppm;
  spectral::settings(preset).photons_per_pass = each ? std::max(1, count / 128) : count;
}

/// The preset's name with what is no letter or digit as '_'.
inline std::string shipped_test_name(const testing::TestParamInfo<std::string>& parameter)
{
  std::string name = parameter.param;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}

} // namespace nephroid::test
