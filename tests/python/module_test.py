# SPDX-License-Identifier: Apache-2.0
"""The Python module: arrays without copies, the bits of the command line, an interpreter that goes on, and what must
not hang."""
import contextlib
import importlib.util
import io
import json
import os
import pickle
import re
import signal
import subprocess
import sys
import tempfile
import threading
import unittest

import numpy as np

import nephroid

SMALL = {"scene.camera.resolution": [40, 30], "spectral.photons_per_pass": 20000}


def small(passes=2):
    return nephroid.Preset("first-light", {**SMALL, "stop": {"passes": passes}})


def run_json(folder):
    with open(os.path.join(folder, "run.json"), encoding="utf-8") as file:
        return json.load(file)


def child(code):
    """Another interpreter that runs it after the imports above."""
    return subprocess.Popen([sys.executable, "-c", f"import os, time, nephroid\nSMALL = {SMALL!r}\n{code}"],
                            stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True)


class Presets(unittest.TestCase):
    def test_values_go_in_and_out(self):
        preset = small().set("scene.lights.0.power_w", 7.5)
        self.assertEqual(preset["scene.lights.0.power_w"], 7.5)
        self.assertEqual(preset.engine, "spectral")
        self.assertEqual(nephroid.Preset.from_json(preset.to_json()), preset)
        self.assertNotEqual(preset, small())
        self.assertEqual(pickle.loads(pickle.dumps(preset)), preset)
        numbers = {"seed": np.int64(4), "scene.camera.resolution": np.array([160, 120])}
        self.assertEqual(preset.with_values(numbers)["scene.camera.resolution"], [160, 120])
        self.assertIn("first-light", nephroid.presets())
        self.assertIn("properties", nephroid.schema())
        self.assertTrue(any(one["name"] == "photons" and one["runs"] for one in preset.plan()["passes"]))

    def test_what_is_wrong_is_said(self):
        for call, words in ((lambda: nephroid.Preset("no-such"), "there is no preset 'no-such'"),
                            (lambda: small().set("scene.camera.fov", 3), "did you mean 'fov_deg'?"),
                            (lambda: small().set("seed", -1), "expected"),
                            (lambda: small().set("seed", small()), "seed: expected what JSON can hold"),
                            (lambda: nephroid.Preset("first-light", ["seed=1"]), "expected a dict"),
                            (lambda: nephroid.Preset({"seed": 1}), "expected the name of a preset"),
                            (lambda: small().get("scene.nothing"), "the preset has no such field"),
                            (lambda: nephroid.start(small().set("measure.mask", "none.png")
                                                    .set("reference", "none.exr")).wait(), "none")):
            with self.assertRaises(nephroid.BadInput) as raised:
                call()
            self.assertIn(words, str(raised.exception))
            self.assertIsInstance(raised.exception, ValueError)
            self.assertEqual(len(str(raised.exception).splitlines()), 1)

    def test_a_sweep_is_several(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "seeds.json")
            with open(file, "w", encoding="utf-8") as out:
                out.write('{"parent": "first-light", "sweep": {"seed": [1, 2, 3]}}')
            self.assertEqual([one["seed"] for one in nephroid.sweep(file)], [1, 2, 3])
            with self.assertRaisesRegex(nephroid.BadInput, "is a sweep of 3 runs"):
                nephroid.Preset(file)


class Runs(unittest.TestCase):
    def test_pictures_are_those_of_the_command_line(self):
        with tempfile.TemporaryDirectory() as folder, nephroid.run(small()) as run:
            file = os.path.join(folder, "small.json")
            with open(file, "w", encoding="utf-8") as out:
                out.write(small().to_json())
            subprocess.run([os.environ["NEPHROID_PROGRAM"], "run", file, "-o", os.path.join(folder, "line")],
                           check=True, capture_output=True)
            np.testing.assert_array_equal(run.picture(),
                                          nephroid.read_picture(os.path.join(folder, "line", "image.exr")))
            run.save(os.path.join(folder, "module"))
            np.testing.assert_array_equal(run.picture(),
                                          nephroid.read_picture(os.path.join(folder, "module", "image.exr")))
            self.assertTrue(os.path.exists(os.path.join(folder, "module", "run.json")))

    def test_going_on_gives_the_same_bits(self):
        with tempfile.TemporaryDirectory() as folder, nephroid.run(small(6)) as unbroken:
            out = os.path.join(folder, "out")
            with nephroid.run(small(2), folder=out) as begun:
                self.assertEqual((begun.folder, begun.passes), (out, 2))
                with self.assertRaisesRegex(nephroid.BadInput, "expected folder"):
                    nephroid.start(small(), resume=True)
            self.assertTrue(os.path.exists(os.path.join(out, "checkpoint.bin")))
            with nephroid.run(small(6), folder=out, resume=True) as resumed:
                np.testing.assert_array_equal(resumed.picture(), unbroken.picture())
            np.testing.assert_array_equal(nephroid.read_picture(os.path.join(out, "image.exr")), unbroken.picture())
            with self.assertRaisesRegex(nephroid.BadInput, "another preset or seed.*leave out 'resume'"):
                nephroid.run(small(6).set("seed", 2), folder=out, resume=True)

    def test_a_stopped_run_leaves_what_it_has(self):
        with tempfile.TemporaryDirectory() as folder:
            out = os.path.join(folder, "out")
            with nephroid.start(small(100000), folder=out) as run:
                run.picture()
                with self.assertRaisesRegex(nephroid.BadInput, "written into by another"):
                    nephroid.run(small(), folder=out)
            with nephroid.start(small(100000), folder=out, resume=True) as resumed:
                resumed.picture()
                self.assertGreaterEqual(resumed.progress, run_json(out)["fraction"])

    def test_arrays_are_the_cores_memory(self):
        with nephroid.run(small()) as run:
            picture, again = run.picture(), run.picture()
            self.assertEqual((picture.shape, picture.dtype), ((30, 40, 3), np.float32))
            self.assertTrue(np.shares_memory(picture, again))
            self.assertFalse(picture.flags.owndata)
            with self.assertRaises(ValueError):
                picture[0, 0, 0] = 1
            np.testing.assert_allclose(sum(run.layers().values()), picture, rtol=1e-5, atol=1e-6)
            before = picture.copy()
        self.assertIn("closed", repr(run))
        del run
        np.testing.assert_array_equal(picture, before)  # a closed run leaves it

    def test_figures(self):
        with nephroid.run(small(4)) as run:
            history = run.history()
            self.assertTrue(np.all(np.diff(history["seconds"]) >= 0))
            self.assertEqual(len(history["work"]), len(history["estimated_lab_mean"]))
            self.assertEqual(run.error, history["estimated_lab_mean"][-1])
            self.assertEqual((run.state, run.progress, run.passes), ("finished", 1.0, 4))
            self.assertGreater(run.figures()["energy"]["emitted_w"], 0)
            self.assertGreater(run.phases()["photons"], 0)
            self.assertTrue(any("N-SF66" in note for note in run.notes))

    def test_a_picture_that_is_white_says_so(self):
        with nephroid.run(small().set("white", 1e-6)) as run:
            self.assertRegex(run.notes[-1], r"^100 % of the picture is above white: white=[0-9.e-]+ shows it$")

    def test_spectra(self):
        with nephroid.run(nephroid.Preset("first-light",
                                          {**SMALL, "spectral.relight": True, "stop": {"passes": 2}})) as run:
            row, column = np.unravel_index(run.layers()["direct"].sum(axis=2).argmax(), (30, 40))
            spectrum = run.spectrum(int(column), int(row))
            self.assertEqual(spectrum.layers["direct"].shape, nephroid.wavelengths_nm().shape)
            self.assertGreater(spectrum.layers["direct"].sum(), 0)
            with self.assertRaisesRegex(nephroid.BadInput, "there is none of the pixel 40, 0"):
                run.spectrum(40, 0)
        with nephroid.run(small()) as run, self.assertRaisesRegex(nephroid.BadInput, "spectral.relight"):
            run.spectrum(1, 1)

    def test_the_interpreter_goes_on(self):
        counted = 0
        with nephroid.start(small(10)) as run:
            waiter = threading.Thread(target=run.wait)
            waiter.start()
            while run.running:
                counted += 1
            waiter.join()
        self.assertGreater(counted, 1000)

    def test_several_at_once(self):
        with nephroid.start(small()) as a, nephroid.start(small()) as b:
            np.testing.assert_array_equal(a.wait().picture(), b.wait().picture())

    def test_an_object(self):
        preset = nephroid.Preset("inverse/shapes", {"inverse.facets": [32, 32], "stop": {"passes": 1}})
        with nephroid.run(preset) as run:
            self.assertIn("receiver_3", run.pictures())
            self.assertEqual(len(run.curves()["cost"]["cost"]), 2)


class Endings(unittest.TestCase):
    def ends(self, process, seconds=300):
        try:
            return process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            process.kill()
            self.fail("it hangs")

    def test_ctrl_c(self):
        process = child("""
run = nephroid.start(nephroid.Preset("first-light", {**SMALL, "stop": {"passes": 100000}}))
run.picture()
try:
    print("working", flush=True)
    run.wait()
except KeyboardInterrupt:
    print("interrupted", run.running, flush=True)
    run.close()
""")
        self.assertEqual(process.stdout.readline(), "working\n")
        process.send_signal(signal.SIGINT)
        out, err = self.ends(process)
        self.assertEqual((out, process.returncode), ("interrupted True\n", 0), err)

    def test_leaving_while_it_works(self):
        process = child("""
run = nephroid.start(nephroid.Preset("first-light", {**SMALL, "stop": {"passes": 100000}}))
run.picture()
""")
        out, err = self.ends(process)
        self.assertEqual((process.returncode, err), (0, ""))

    def test_closing_while_others_look_and_save(self):
        process = child("""
import tempfile, threading
def look():
    while True:
        try:
            run.state, run.progress, run.picture(), run.spectrum
        except nephroid.Error as error:
            return ends.append(str(error))
def save():
    with tempfile.TemporaryDirectory() as folder:
        for number in range(100000):
            saved = os.path.join(folder, str(number))
            try:
                run.save(saved)
            except nephroid.Error as error:
                return ends.append("half saved" if os.path.exists(saved) else str(error))
for _ in range(5):
    ends = []
    run = nephroid.start(nephroid.Preset("first-light", {**SMALL, "stop": {"passes": 100000}}))
    run.picture()
    others = [threading.Thread(target=one) for one in (look, save, save)]
    closers = [threading.Thread(target=run.close) for _ in range(2)]
    for one in others: one.start()
    time.sleep(0.1)
    for one in closers: one.start()
    for one in closers + others: one.join()
    print(len(ends), all("is closed" in end for end in ends))
""")
        out, err = self.ends(process)
        self.assertEqual((process.returncode, out.splitlines()), (0, ["3 True"] * 5), err)

    def test_a_fork(self):
        process = child("""
run = nephroid.start(nephroid.Preset("first-light", {**SMALL, "stop": {"passes": 100000}}))
run.picture()
pid = os.fork()
if pid == 0:
    for call in (run.picture, lambda: run.doing, run._core.notes, lambda: run.state, run.stop, lambda:
    run.save("none")):
        try:
            call()
        except nephroid.Error as error:
            print(error, flush=True)
    for call in (nephroid.devices, lambda: nephroid.start("first-light")):
        try:
            call()
        except nephroid.Error as error:
            print(error, flush=True)
    run.close()
    del call, run
    os._exit(7)
print(os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]))
run.stop()
print(run.wait().state)
""")
        out, err = self.ends(process)
        lines = out.splitlines()
        self.assertEqual(["belongs to the process that started it" in line for line in lines[:6]], [True] * 6,
                         out + err)
        self.assertEqual(["this process was forked" in line for line in lines[6:8]], [True] * 2, out + err)
        self.assertEqual(lines[8:], ["7", "stopped"], err)


class Page(unittest.TestCase):
    def test_does_what_it_says(self):
        page = os.path.join(os.path.dirname(__file__), "..", "..", "docs", "python.md")
        with open(page, encoding="utf-8") as text:
            blocks = re.findall(r"```python\n(.*?)```", text.read(), re.S)
        self.assertGreater(len(blocks), 1)
        names, before = {}, os.getcwd()
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
            os.chdir(folder)
            try:
                for block in blocks:
                    exec(block, names)  # the reader's own session
                self.assertTrue(os.path.exists("out/first-light/image.exr"))
            finally:
                os.chdir(before)


class Optics(unittest.TestCase):
    def test_dispersion(self):
        glass = nephroid.dispersion("N-BK7")
        self.assertAlmostEqual(float(glass.n(587.5618)), 1.5168, 4)  # Schott's catalogue
        self.assertEqual(glass.n(np.full((2, 3), 500.0)).shape, (2, 3))
        self.assertEqual(glass.extrapolated([200, 500]).tolist(), [True, False])
        with self.assertRaises(nephroid.BadInput):
            glass.n([-1])

    def test_clusters(self):
        made = nephroid.clusters("N-SF66", 0.1)
        self.assertEqual(sorted(np.concatenate([one.wavelengths_nm for one in made.clusters])), list(range(380, 781)))
        self.assertLessEqual(max(one.theta_deg2 for one in made.clusters), 0.1 * 89)
        self.assertEqual(len(nephroid.clusters(np.full(401, 1.5)).clusters), 1)
        for wrong in ([1.5], np.ones((2, 401))):
            with self.assertRaisesRegex(nephroid.BadInput, "expected 401 values"):
                nephroid.clusters(wrong)

    def test_an_environment(self):
        lights = nephroid.segment(np.ones((64, 128, 3)), 24)
        self.assertAlmostEqual(lights.solid_angles_sr.sum(), 4 * np.pi, 3)
        np.testing.assert_allclose(lights.flux.sum(axis=0), 4 * np.pi, rtol=1e-3)
        np.testing.assert_allclose(np.linalg.norm(lights.directions, axis=1), 1, rtol=1e-9)
        for wrong, words in ((np.ones((4, 4)), "expected an array of height x width x 3"),
                             (-np.ones((4, 8, 3)), "expected radiance")):
            with self.assertRaisesRegex(nephroid.BadInput, words):
                nephroid.segment(wrong, 24)

    def test_metrics(self):
        rng = np.random.default_rng(1)
        a, b = rng.random((2, 20, 30, 3))
        mask = np.zeros((20, 30))
        mask[3, 4] = 1
        self.assertAlmostEqual(nephroid.compare(a, b)["mse"], np.mean((a - b) ** 2), 6)
        self.assertAlmostEqual(nephroid.compare(a, b, mask)["mse"], np.mean((a - b)[3, 4] ** 2), 6)
        self.assertEqual(nephroid.compare(a[::2, ::-1], a[::2, ::-1])["mse"], 0)  # of any strides
        for call in (lambda: nephroid.compare(a, b[:5]), lambda: nephroid.compare(a[..., 0], b),
                     lambda: nephroid.compare(a, b, mask[:3]),
                     lambda: nephroid.compare(a * np.nan, b), lambda: nephroid.compare(np.empty((0, 3, 3)), b)):
            with self.assertRaises(nephroid.BadInput):
                call()

    def test_a_picture_is_displayed_as_the_preset_says(self):
        picture = np.array([[[0.21586, 1, 0], [2, 1, 0.5]]])
        plain = nephroid.Preset("first-light", {"display": {"gamut": "clip", "tone": "clip"}})
        self.assertEqual(plain.displayed(picture).tolist(), [[[128, 255, 0], [255, 255, 188]]])
        soft = nephroid.Preset("first-light").displayed(picture)
        self.assertEqual(soft.dtype, np.uint8)
        self.assertEqual(soft[0, 1, 0], 255)
        self.assertLess(soft[0, 1, 1], 200)  # half of the red, as the light has it
        self.assertRaises(nephroid.BadInput, plain.displayed, picture[0])

    def test_pictures_are_linear(self):
        a = np.ones((4, 8, 3))
        for wrong, words in ((a.astype(np.uint8),
                              "picture: is of uint8, which is not linear; .*decode it to linear floats"),
                             (a * 1j, "picture: is of complex128; expected real numbers"),
                             (a.astype(str), "picture: is of <U"),
                             (a.astype(object), "picture: is of object")):
            with self.assertRaisesRegex(nephroid.BadInput, words):
                nephroid.compare(wrong, a)
            with self.assertRaisesRegex(nephroid.BadInput, words.replace("picture", "reference")):
                nephroid.compare(a, wrong)
            with self.assertRaisesRegex(nephroid.BadInput, words.replace("picture", "environment")):
                nephroid.segment(wrong, 24)
        self.assertEqual(nephroid.compare(a.tolist(), a.astype(np.float16))["mse"], 0)


class Types(unittest.TestCase):
    @unittest.skipUnless(importlib.util.find_spec("mypy"), "mypy is not there")
    def test_hold(self):
        examples = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "python", "examples")
        files = [os.path.join(examples, name) for name in sorted(os.listdir(examples)) if name.endswith(".py")]
        self.assertGreater(len(files), 2)
        with tempfile.TemporaryDirectory() as folder:
            settings = os.path.join(folder, "mypy.ini")
            with open(settings, "w", encoding="utf-8") as out:
                out.write("[mypy]\n[mypy-matplotlib.*]\nignore_missing_imports = True\n")
            made = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--config-file", settings, "--cache-dir",
                                   os.path.join(folder, "cache"),
                                   os.path.dirname(nephroid.__file__), *files], cwd=folder, capture_output=True,
                                  text=True)
        self.assertEqual(made.returncode, 0, made.stdout + made.stderr)


if __name__ == "__main__":
    unittest.main()
