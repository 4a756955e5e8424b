"""Declares a greatest speed of 10°/s for joints that turn by up to 300°/s."""
import copy

import good

manifest = copy.deepcopy(good.MANIFEST)
for joint in manifest["characters"][0]["joints"]:
    joint["max_speed_deg_s"] = 10

good.serve(manifest=manifest)
