#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Clear-sky irradiance of five places and days, as `nephroid measure` has it, beside published models.

    tests/experiments/clear_skies.py PROGRAM

Prints W/m^2 on a level plane and on one that faces the sun: ours (Bird and Riordan 1986 with the preset's turbidity),
the ESRA-like model of Ineichen and Perez (2002) with the Linke turbidity of its monthly maps, and the simplified Solis
model (Ineichen 2008). Needs pvlib.
"""

import argparse
import json
import subprocess
import tempfile
from pathlib import Path

import pandas
import pvlib

# Name, latitude, longitude, metres above the sea, day, hour by the clock, what that is ahead of UTC. All are low.
PLACES = [
    ("London", 51.5, -0.1, 20, "2026-06-21", 13, 1),
    ("Singapore", 1.35, 103.8, 15, "2026-03-20", 13, 8),
    ("Los Angeles", 34.0, -118.2, 90, "2026-08-30", 15, -7),
    ("Oslo", 59.9, 10.75, 20, "2026-04-15", 12, 2),
    ("Sydney", -33.9, 151.2, 20, "2026-12-21", 9, 11),
]


def ours(program, latitude, longitude, date, hour, offset, turbidity):
    place = {"latitude_deg": latitude, "longitude_deg": longitude, "date": date, "hour": hour, "utc_offset_h": offset}
    preset = {
        "engine": "spectral",
        "scene": {
            "environment": {"type": "sky", "lights": True, "place": place, "turbidity": turbidity},
            "meters": [{"type": "point", "name": "level", "normal": [0, 1, 0]}],
        },
    }
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "place.json"
        file.write_text(json.dumps(preset))
        run = subprocess.run(
            [program, "measure", file, "--json", "--seconds", "0.3"], check=True, capture_output=True, text=True
        )
    light = json.loads(run.stdout)["meters"][0]["layers"]
    return [light[layer]["W/m^2"]["mean"]["value"] for layer in ("direct", "sky")]


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program")
    program = arguments.parse_args().program
    print("| place, W/m^2 level (direct normal) | sun, deg | turbidity 2.5 | 3 | 4 | Ineichen, Perez | Solis |")
    print("|---|---|---|---|---|---|---|")
    for name, latitude, longitude, height, date, hour, offset in PLACES:
        time = pandas.DatetimeIndex([pandas.Timestamp(date) + pandas.Timedelta(hours=hour - offset)], tz="UTC")
        sun = pvlib.solarposition.get_solarposition(time, latitude, longitude, height)
        elevation = float(sun["elevation"].iloc[0])
        sine = float(pvlib.tools.sind(elevation))
        mass = pvlib.atmosphere.get_absolute_airmass(pvlib.atmosphere.get_relative_airmass(sun["apparent_zenith"]))
        linke = pvlib.clearsky.lookup_linke_turbidity(time, latitude, longitude)
        extra = pvlib.irradiance.get_extra_radiation(time)
        ineichen = pvlib.clearsky.ineichen(sun["apparent_zenith"], mass, linke, height, dni_extra=extra)
        solis = pvlib.clearsky.simplified_solis(
            sun["apparent_elevation"], aod700=0.1, precipitable_water=2.0, pressure=101325.0, dni_extra=extra
        )
        cells = [f"{name}, {date} {hour}:00", f"{elevation:.1f}"]
        for turbidity in (2.5, 3, 4):
            direct, sky = ours(program, latitude, longitude, date, hour, offset, turbidity)
            cells.append(f"{direct + sky:.0f} ({direct / sine:.0f})")
        for model in (ineichen, solis):
            cells.append(f"{float(model['ghi'].iloc[0]):.0f} ({float(model['dni'].iloc[0]):.0f})")
        print("| " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
