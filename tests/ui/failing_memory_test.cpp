// SPDX-License-Identifier: Apache-2.0
// A device whose memory runs out in the middle of an edit: one line that names a buffer, the picture from before stays,
// the next edit works. The OpenCL calls that fail are defined here, where the linker finds them before the real ones.
#include "environment/settings.h"
#include "scenes.h"
#include "tests/support/process_state.h"
#include "ui/state/device_runs.h"

#include <dlfcn.h>

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

namespace nephroid::ui::failing_memory_test {

/// Calls that go well before one fails; negative: all do.
std::atomic<int> allocations_left{-1}, launches_left{-1};

bool fails(std::atomic<int>& left) { return left >= 0 && left-- == 0; }

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

extern "C" cl_mem clCreateBuffer(cl_context context, cl_mem_flags flags, std::size_t bytes, void* host, cl_int* error) {
  static auto* const create = real<decltype(clCreateBuffer)>("clCreateBuffer");
  if (!fails(allocations_left)) return create(context, flags, bytes, host, error);
  if (error) *error = CL_MEM_OBJECT_ALLOCATION_FAILURE;
  return nullptr;
}

extern "C" cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                                         const std::size_t* offset, const std::size_t* global, const std::size_t* local,
                                         cl_uint waits, const cl_event* wait_for, cl_event* event) {
  static auto* const enqueue = real<decltype(clEnqueueNDRangeKernel)>("clEnqueueNDRangeKernel");
  if (fails(launches_left)) return CL_MEM_OBJECT_ALLOCATION_FAILURE;
  return enqueue(queue, kernel, dimensions, offset, global, local, waits, wait_for, event);
}

using Edit = std::function<void(preset::Preset&)>;

const std::string environment_text =
    test::lamps_text("[16, 12]", R"("directions": 26, "photons": 256, "spheres": 2, "resolution": 8)");

class FailingMemory : public testing::Test {
protected:
  ~FailingMemory() override { allocations_left = launches_left = -1; }

  void open(const std::string& text, const preset::Overrides& overrides = {}) {
    ASSERT_TRUE(workbench.open(folder.write("test.json", text), overrides));
    ASSERT_TRUE(until([&] { return is_done(); })) << text;
  }
  bool until(const std::function<bool()>& done) {
    workbench.update(); // what was done before counts no more
    return test::eventually([&] { workbench.update(); }, done);
  }
  job::State state() const { return workbench.run().status().state; }
  bool is_done() const {
    return state() == job::State::finished && workbench.run().snapshot_is_current() &&
           workbench.run().snapshot()->progress.fraction == 1;
  }
  const std::vector<float>& picture() const { return workbench.run().snapshot()->picture->rgb; }

  /// Edits and undoes that again and again, with another one of the calls failing each time. How many did.
  int fail_in_the_middle(std::atomic<int>& left, const Edit& edit) {
    const std::vector<float> before = picture();
    int failures = 0;
    for (const int good : {0, 5}) {
      left = good;
      preset::Preset edited = *workbench.preset();
      edit(edited);
      workbench.apply({command::Edit{"edit", edited}});
      EXPECT_TRUE(until([&] { return is_done() || (state() == job::State::failed && !workbench.messages().empty()); }))
          << good;
      const bool failed = left.exchange(-1) < 0;
      failures += failed;
      EXPECT_EQ(state() == job::State::failed, failed) << good;
      if (failed && state() == job::State::failed) {
        EXPECT_EQ(workbench.messages().size(), 1u);
        const std::string line = workbench.messages()[0].line;
        EXPECT_THAT(line, AllOf(HasSubstr("buffer "), HasSubstr("CL_MEM_OBJECT_ALLOCATION_FAILURE; the device has"),
                                Not(HasSubstr("\n"))));
        EXPECT_TRUE(workbench.run().snapshot_is_current() || picture() == before)
            << good; // current: the new one had begun
      }
      workbench.apply({command::Undo{}});
      EXPECT_TRUE(until([&] { return is_done(); })) << good;
      EXPECT_TRUE(workbench.messages().empty());
      if (!failed) break;
      EXPECT_EQ(picture(), before) << good;
    }
    return failures;
  }
  void expect_it_survives(const Edit& edit) {
    EXPECT_GT(fail_in_the_middle(allocations_left, edit) + fail_in_the_middle(launches_left, edit), 0);
  }

  test::TemporaryFolder folder;
  test::CacheHome cache{folder.path()}; // the bakes go with the test
  DeviceRuns runs{{}};
  Workbench workbench{runs};
};

void change_light(preset::Preset& preset) { preset.scene.lights[0].power_w *= 3; }
void move_camera(preset::Preset& preset) { preset.scene.camera.position[0] += 0.5; }

TEST_F(FailingMemory, SpectralRunsAreMadeAnew) {
  open(test::preset_text, {"stop.passes=2"});
  expect_it_survives(move_camera);
}

TEST_F(FailingMemory, SpectralRunsTakeOnALight) {
  open(test::preset_text, {"stop.passes=2", "spectral.relight=true"});
  expect_it_survives(change_light);
}

TEST_F(FailingMemory, EnvironmentRunsTakeOnAnEdit) {
  open(environment_text, {"stop.passes=2"});
  for (const Edit& edit :
       std::initializer_list<Edit>{move_camera, [](preset::Preset& p) { p.scene.environment->rotate_deg += 40; },
                                   [](preset::Preset& p) { p.scene.objects[1].transform.translate[1] -= 0.3; },
                                   [](preset::Preset& p) { environment::settings(p).lights = 12; },
                                   [](preset::Preset& p) { environment::settings(p).extinction = 0.1; }})
    expect_it_survives(edit);
}

TEST_F(FailingMemory, EnvironmentRunsAreMadeAnew) {
  open(environment_text, {"stop.passes=2"});
  expect_it_survives([](preset::Preset& p) { environment::settings(p).spheres = 3; });
}

TEST_F(FailingMemory, InverseRunsAreMadeAnew) {
  open(test::inverse_text(2, 8)); // through so few facets the judge sends the fewest rays
  expect_it_survives([](preset::Preset& p) { inverse::settings(p).thickness_mm += 1; });
}

} // namespace nephroid::ui::failing_memory_test
