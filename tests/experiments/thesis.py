#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the thesis' experiments at a size that two cores manage in minutes and prints the tables of docs/notebook.

    tests/experiments/thesis.py PROGRAM OUT [EXPERIMENT...]

Every run of a table is made in one go, one after the other; references are made once and kept
(docs/error-against-time.md).
"""
import csv
import json
import shutil
import subprocess
import sys
from functools import partial
from itertools import combinations
from math import sqrt
from pathlib import Path
from statistics import mean, stdev

SIZE = 128
SPEED_SIZE = 176  # IW-SSIM needs 161 pixels
PHOTONS = 4096  # of one iteration of one cluster
PLAIN = {"estimator": "automatic", "jitter": True, "low_discrepancy": True, "effort": "variance", "smoothing": "off"}
OURS = PLAIN | {"effort": "automatic", "smoothing": "automatic"}  # as shipped
THESIS = {"method": "thesis", "estimator": "sppm", "jitter": False, "low_discrepancy": False, "effort": "importance",
          "photons_per_pass": PHOTONS}
BRUTE = THESIS | {"method": "brute_force", "effort": "equal"}


class Experiments:
    def __init__(self, program, out):
        self.program, self.out, self.size = program, Path(out), SIZE  # None: the preset's own size

    def run(self, name, preset, spectral, passes=None, seconds=None, seed=1, reference=None, extra=(), after=None):
        """One run; returns its run.json, its history and its folder. `after`: the folder of a run that had fewer
        passes, which it goes on from."""
        folder = self.out / name
        sets = ["sweep=null", "spectral.direct=false", f"stop.passes={passes or 'null'}",
                f"stop.seconds={seconds or 'null'}", *extra]
        if self.size:
            sets.append(f"scene.camera.resolution=[{self.size},{self.size}]")
        sets += [f"spectral.{key}={json.dumps(value)}" for key, value in spectral.items()]
        if reference:
            sets.append("reference=" + json.dumps({"type": "recipe", "passes": reference,
                                                   "spectral": PLAIN | {"direct": False}}))
            sets.append("measure.perceptual=true")
        command = [self.program, "run", preset, "--seed", str(seed), "-o", str(folder)]
        for item in sets:
            command += ["--set", item]
        if after:
            shutil.copytree(after, folder)
            command.append("--resume")
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            sys.exit(done.stderr.splitlines()[-1])
        rows = list(csv.DictReader(open(folder / "history.csv"))) if (folder / "history.csv").exists() else []
        return json.load(open(folder / "run.json")), rows, folder

    def compare(self, a, b):
        result = subprocess.run([self.program, "compare", "--json", str(a / "image.exr"), str(b / "image.exr")],
                                check=True,
                                capture_output=True, text=True)
        return json.loads(result.stdout)

    def iterations(self, preset, passes, *options):
        result = subprocess.run([self.program, "importance", preset, "--set", f"stop.passes={passes}", "--set",
                                 "sweep=null", *options,
                                 "--json"], check=True, capture_output=True, text=True)
        return sum(max(i["iterations"], 1) for i in json.loads(result.stdout)["iterations"])


def reaches(rows, error, metric):
    """Seconds until the error of a history is first at most `error`, straight lines between logarithms; None where it
    never is. Where its first row is below already, that row's seconds: too many."""
    from math import exp, log
    before = None
    for row in rows:
        now = (float(row["seconds"]), float(row[metric]))
        if now[1] <= error:
            if before is None:
                return now[0]
            part = (log(before[1]) - log(error)) / (log(before[1]) - log(now[1]))
            return exp(log(before[0]) + part * (log(now[0]) - log(before[0])))
        before = now
    return None


def speed(e, scene="bunny", brute_passes=20, seconds=120):
    """Figures 4.13 and 4.14, rows 1 to 3: brute force, the thesis' clusters with (4.15), with Radziszewski et al., and
    ours."""
    e.size = SPEED_SIZE
    preset = f"spectral/thesis/{scene}"
    settings = {"brute force": (BRUTE, brute_passes, None), "thesis, (4.15)": (THESIS, None, seconds),
                "thesis, Radziszewski et al.": (THESIS | {"effort": "radziszewski"}, None, seconds),
                "ours, not smoothed": (PLAIN, None, seconds / 4), "ours": (OURS, None, seconds / 4)}
    runs = {name: e.run(f"speed-{scene}/{index}", preset, spectral, passes, limit, reference=250)
            for index, (name, (spectral, passes, limit)) in enumerate(settings.items())}
    slowest = runs["brute force"][1][-1]
    slow = float(slowest["seconds"])
    floor = runs["ours"][0]["reference"]["noise_floor"]["lab_mean"]
    metrics = ("lab_mean", "lab_rms", "rel_l2", "iw_ssim")
    print(f"\n{scene}: brute force, {brute_passes} iterations a wavelength, {slow:.0f} s; noise floor of lab_mean "
          f"{floor:.2f}\n")
    print("| method | seconds | passes | lab_mean | lab_rms | rel_l2 | IW-SSIM | seconds to brute force's lab_mean, "
          "lab_rms, rel_l2, IW-SSIM | "
          "times faster |\n|---|---|---|---|---|---|---|---|---|")
    for name, (run, rows, _) in runs.items():
        last = {metric: float(rows[-1][metric]) for metric in metrics}
        for row in [*rows, slowest]:
            row["error iw_ssim"] = 1 - float(row["iw_ssim"])  # falls as the others do
        when = [reaches(rows, float(slowest[m]), m) for m in (*metrics[:3], "error iw_ssim")]
        print(f"| {name} | {float(rows[-1]['seconds']):.1f} | {run['passes']} | {last['lab_mean']:.2f} | "
              f"{last['lab_rms']:.2f} | {last['rel_l2']:.3f} | "
              f"{last['iw_ssim']:.4f} | {', '.join(f'{w:.2f}' if w else 'never' for w in when)} | "
              f"{', '.join(f'{slow / w:.1f}' if w else '-' for w in when)} |")


SEEDS = (1, 2, 3)  # of every picture of a difference


def without_noise(e, a, b, metric):
    """How far two variants are apart without their noise: root of the mean square, and of one standard error less and
    more. a and b are pictures by seed. The noise of a1 - b1 knows nothing of that of a2 - b2, so the mean of their
    product is the distance squared; the four squared distances between pictures of different seeds give it, once for
    each pair of seeds. Below 0 is as good as none."""
    def squared(x, y):
        return e.compare(x, y)[metric] ** 2
    products = [(squared(a[i], b[j]) + squared(b[i], a[j]) - squared(a[i], a[j]) - squared(b[i], b[j])) / 2
                for i, j in combinations(range(len(SEEDS)), 2)]
    error = stdev(products) / sqrt(len(products))
    return [sqrt(max(mean(products) + times * error, 0)) for times in (0, -1, 1)]


def differences(e, title, preset, variants, passes):
    """Neighbouring variants against each other, the noise, which is the same variant with another seed, and what is
    left without it."""
    def pictures(index, name, spectral):
        count = passes[name] if isinstance(passes, dict) else passes
        return [e.run(f"{title}/{index}-seed-{seed}", preset, spectral, count, seed=seed)[2] for seed in SEEDS]
    e.size = SPEED_SIZE
    runs = {name: pictures(index, name, spectral) for index, (name, spectral) in enumerate(variants.items())}
    print(f"\n{title}\n\n| pair | lab_mean | IW-SSIM | lab_rms | noise: lab_rms of two seeds, first, second | lab_rms "
          f"without noise |\n"
          "|---|---|---|---|---|---|")
    names = list(runs)
    for a, b in zip(names, names[1:]):
        m = e.compare(runs[a][0], runs[b][0])
        noise = [e.compare(*runs[n][:2])["lab_rms"] for n in (a, b)]
        left, least, most = without_noise(e, runs[a], runs[b], "lab_rms")
        print(f"| {a} to {b} | {m['lab_mean']:.2f} | {m['iw_ssim']:.4f} | {m['lab_rms']:.2f} | {noise[0]:.2f}, "
              f"{noise[1]:.2f} | "
              f"{left:.2f} ({least:.2f} to {most:.2f}) |", flush=True)


SPLAT = {"estimator": "splat", "jitter": False, "low_discrepancy": True, "photons_per_pass": 1 << 18}


def figure_4_6(e):
    for scene, method in (("bunny", "thesis"), ("bunny-arbitrary-2", "thesis"), ("diamond-arbitrary-1", "thesis")):
        differences(e, f"figure-4-6-{scene}", f"spectral/thesis/{scene}",
                    {f"{t} degrees": SPLAT | {"method": method, "threshold_deg": t} for t in (0.5, 0.1, 0.05, 0.01)},
                    128)


def figure_4_9(e):
    differences(e, "figure-4-9", "spectral/thesis/bunny", {f"{n} iterations": BRUTE for n in (3, 6, 12)},
                {f"{n} iterations": n for n in (3, 6, 12)})


def figure_4_10(e):
    for scene in ("bunny", "bunny-arbitrary-2"):
        differences(e, f"figure-4-10-{scene}", f"spectral/thesis/{scene}",
                    {f"{s} nm": SPLAT | {"method": "brute_force", "step_nm": s} for s in (4, 2, 1)}, 128)


def figure_4_11(e):
    print("\nfigure-4-11\n\n| ghat | iterations | seconds | lab_mean | noise floor |\n|---|---|---|---|---|")
    for geometry in (True, False):
        run, rows, _ = e.run(f"figure-4-11/{geometry}", "spectral/thesis/enclosed-bunny",
                             THESIS | {"importance.geometry": geometry}, 200,
                             reference=100)
        count = e.iterations("spectral/thesis/enclosed-bunny", 200, "--set", "spectral.method=thesis", "--set",
                             f"spectral.importance.geometry={json.dumps(geometry)}")
        print(f"| {'with' if geometry else 'without'} | {count} | {run['work_seconds']:.1f} | "
              f"{float(rows[-1]['lab_mean']):.2f} | "
              f"{run['reference']['noise_floor']['lab_mean']:.2f} |")


def figure_4_12(e):
    differences(e, "figure-4-12", "spectral/thesis/cylinders",
                {"brute force": SPLAT | {"method": "brute_force"}, "clusters": SPLAT | {"method": "thesis"}}, 128)


DIFFERENCE_SCENES = ("bunny", "bunny-arbitrary-2", "diamond-arbitrary-1")
ITERATIONS = 4  # in place of the thesis' 2000
SCALE = 40.0  # distance in CIELAB at which the colours of a difference picture end


def figure_differences(e):
    """Figures 4.6, 4.9, 4.13 and 4.14 with photon maps as in the thesis, all of the light, 1/500 of its iterations.
    Each pair's difference picture is OUT/differences/SCENE/PAIR.png. Noise is that of brute force, between two
    seeds."""
    e.size = SPEED_SIZE
    print("\nfigures 4.6, 4.9 and 4.14\n\n| scene | figure | pair | lab_mean | lab_rms | rel_l2 | IW-SSIM |\n"
          "|---|---|---|---|---|---|---|")
    for scene in DIFFERENCE_SCENES:
        def picture(name, spectral, passes=ITERATIONS, **more):
            folder = e.out / "differences" / scene / name
            if not (folder / "run.json").exists():
                e.run(f"differences/{scene}/{name}", f"spectral/thesis/{scene}", spectral, passes,
                      extra=["spectral.direct=true"], **more)
            return folder
        brute, last = {}, None
        for part in (1, 2, 4, 6):  # of 500 in the thesis
            last = brute[part] = picture(f"brute-force-{part}", BRUTE, part * ITERATIONS // 4, after=last)
        clusters = {t: picture(f"threshold-{t}", THESIS | {"effort": "equal", "threshold_deg": t})
                    for t in (0.5, 0.1, 0.05, 0.01)}
        pairs = [("4.6", f"{a} to {b} degrees", clusters[a], clusters[b])
                 for a, b in ((0.5, 0.1), (0.1, 0.05), (0.05, 0.01))]
        pairs += [("4.9", f"{a * ITERATIONS // 4} to {b * ITERATIONS // 4} iterations", brute[a], brute[b])
                  for a, b in ((1, 2), (2, 4), (4, 6))]
        pairs += [("4.14", f"{name} to brute force", picture(effort, THESIS | {"effort": effort}), brute[4])
                  for name, effort in (("(4.15)", "importance"), ("Radziszewski et al.", "radziszewski"))]
        pairs.append(("noise", "brute force, another seed", picture("brute-force-seed-2", BRUTE, seed=2), brute[4]))
        for figure, name, a, b in pairs:
            subprocess.run([e.program, "compare", str(a / "image.exr"), str(b / "image.exr"), "--scale", str(SCALE),
                            "-o", str(e.out / "differences" / scene / f"{a.name}-{b.name}.png")], check=True,
                           stdout=subprocess.DEVNULL)
            m = e.compare(a, b)
            print(f"| {scene} | {figure} | {name} | {m['lab_mean']:.2f} | {m['lab_rms']:.2f} | {m['rel_l2']:.3f} | "
                  f"{m['iw_ssim']:.3f} |", flush=True)


def figure_1_5(e):
    print("\nfigure-1-5\n\n| wavelengths | iterations | seconds | lab_mean | rel_l2 | noise floor "
          "|\n|---|---|---|---|---|---|")
    for name, spectral, passes in (("all alike", BRUTE, 10), ("one at random", BRUTE | {"effort": "random"}, 4010)):
        run, rows, _ = e.run(f"figure-1-5/{name.split()[0]}", "spectral/thesis/prism-f10", spectral, passes,
                             reference=100)
        print(f"| {name} | {4010} | {run['work_seconds']:.1f} | {float(rows[-1]['lab_mean']):.2f} | "
              f"{float(rows[-1]['rel_l2']):.3f} | "
              f"{run['reference']['noise_floor']['lab_mean']:.2f} |")


# seconds
BEYOND_SCENES = {"spectral/thesis/bunny": 12, "spectral/prism": 8, "spectral/ball-lens": 8, "spectral/brilliant": 8}


def beyond(e):
    """Each of what goes beyond the thesis, with and without, at equal time."""
    base = {"estimator": "automatic", "jitter": False, "low_discrepancy": False, "effort": "power",
            "smoothing": "off"}
    steps = {"clusters alone": base, "jitter, stretched": base | {"jitter": True},
             "low discrepancy": base | {"low_discrepancy": True},
             "variance": base | {"effort": "variance"}, "smoothing": base | {"smoothing": "on"},
             "jitter, low discrepancy, variance": base | PLAIN,
             "jitter, low discrepancy, variance, smoothing": base | OURS}
    for preset, seconds in BEYOND_SCENES.items():
        print(f"\n{preset}, {seconds} s each\n\n| with | photons, million | lab_mean | lab_rms | rel_l2 "
              f"|\n|---|---|---|---|---|")
        for index, (name, spectral) in enumerate(steps.items()):
            run, rows, _ = e.run(f"beyond-{Path(preset).name}/{index}", preset, spectral, seconds=seconds,
                                 reference=150)
            print(f"| {name} | {run['photons'] / 1e6:.1f} | "
                  + " | ".join(f"{float(rows[-1][m]):.3f}" for m in ("lab_mean", "lab_rms", "rel_l2")) + " |")
        floor = run["reference"]["noise_floor"]
        print("| noise floor | | " + " | ".join(f"{floor[m]:.3f}" for m in ("lab_mean", "lab_rms", "rel_l2")) + " |")


def smoothing(e):
    """What smoothing does to pictures of few and of many photons, at equal passes."""
    print("\nsmoothing\n\n| scene | passes | lab_mean | smoothed | rel_l2 | smoothed | lab_mean's noise floor "
          "|\n|---|---|---|---|---|---|---|")
    for preset in BEYOND_SCENES:
        for passes in (4, 16, 64):
            last = []
            for index, spectral in enumerate((PLAIN, OURS)):
                run, rows, _ = e.run(f"smoothing-{Path(preset).name}/{passes}-{index}", preset, spectral, passes,
                                     reference=150)
                last.append(rows[-1])
            print(f"| {preset} | {passes} | " + " | ".join(f"{float(row[m]):.3f}" for m in ("lab_mean", "rel_l2")
                                                           for row in last) +
                  f" | {run['reference']['noise_floor']['lab_mean']:.3f} |")


EXPERIMENTS = {"speed": speed, "speed-bunny-arbitrary-2": partial(speed, scene="bunny-arbitrary-2"),
               "speed-diamond-arbitrary-1": partial(speed, scene="diamond-arbitrary-1"),
               "figure-4-6": figure_4_6, "figure-4-9": figure_4_9, "figure-4-10": figure_4_10,
               "figure-4-11": figure_4_11,
               "figure-4-12": figure_4_12, "figure-1-5": figure_1_5, "differences": figure_differences,
               "beyond": beyond,
               "smoothing": smoothing}

if __name__ == "__main__":
    if len(sys.argv) > 1 and not Path(sys.argv[1]).is_file():
        sys.exit(f"{sys.argv[1]}: is no file; expected the program, as build/release/bin/nephroid")
    if len(sys.argv) < 3 or not set(sys.argv[3:]) <= set(EXPERIMENTS):
        sys.exit(f"usage: thesis.py PROGRAM OUT [{' | '.join(EXPERIMENTS)}]...")
    for chosen in sys.argv[3:] or EXPERIMENTS:
        EXPERIMENTS[chosen](Experiments(sys.argv[1], sys.argv[2]))
        sys.stdout.flush()
