// SPDX-License-Identifier: Apache-2.0
// Every shipped preset of engine 3, with few facets: it plans, runs and is judged, and its light is accounted for.
#include "inverse/engine.h"
#include "preset/read.h"
#include "tests/support/test.h"

namespace nephroid::presets_test {

TEST(InversePresets, AreDesignedAndJudged)
{
  int count = 0;
  for (const preset::ShippedPreset& shipped : preset::shipped_presets()) {
    preset::Preset p = preset::read_presets(shipped.name).front();
    if (&p.settings.type() != &inverse::settings_type()) continue;
    SCOPED_TRACE(shipped.name);
    ++count;
    inverse::settings(p).facets = {24, 24};
    p.stop.passes = 2;
    const inverse::InversePlan plan = inverse::make_plan(p);
    const auto job = inverse::make_job(p, plan);
    const double before = job::scalar(job->snapshot(), "believed", "rel_l2");
    while (!job->finished()) job->step();
    const job::Snapshot made = job->snapshot();
    EXPECT_LT(job::scalar(made, "judged", "rel_l2"), before);
    EXPECT_NEAR(job::scalar(made, "light", "sent") + job::scalar(made, "light", "reflected") + job::scalar(made, "light", "lost"), 1, 1e-4);
    for (const job::NamedPicture& one : made.pictures)
      for (const float value : one.picture->rgb) ASSERT_TRUE(std::isfinite(value)) << one.name;
  }
  EXPECT_GE(count, 13);
}

} // namespace nephroid::presets_test
