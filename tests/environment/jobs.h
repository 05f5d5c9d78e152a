// SPDX-License-Identifier: Apache-2.0
// Jobs of engine 2 whose bakes are kept in a folder of the test's own.
#pragma once
#include "environment/engine.h"
#include "job/job.h"
#include "scene/scene.h"
#include "tests/environment/bakes.h"
#include "tests/support/process_state.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test.h"

namespace nephroid::test {

class EnvironmentJobs : public testing::Test {
protected:
  static environment::EnvironmentPlan plan_of(const preset::Preset& p)
  {
    const scene::Scene scene = scene::load_scene(p);
    return environment::make_plan(p, scene, scene::build_bvh(scene.geometry));
  }
  static std::unique_ptr<job::Job> job_of(const preset::Preset& p, const environment::EnvironmentPlan& plan)
  {
    return environment::make_job(p, plan, bake_context());
  }
  static std::unique_ptr<job::Job> job_of(const preset::Preset& p) { return job_of(p, plan_of(p)); }
  static job::Snapshot run(job::Job& job)
  {
    while (!job.finished()) job.step();
    return job.snapshot();
  }
  static job::Snapshot run(const preset::Preset& p) { return run(*job_of(p)); }

  TemporaryFolder cache;
  CacheHome home{cache.path()};
};

} // namespace nephroid::test
