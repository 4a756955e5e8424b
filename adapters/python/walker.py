"""An arm of two joints that swings. Run it with: contort fuzz --generator "python3 walker.py" --cases 500"""
import math

from contort_guest import serve

ELBOW = {"name": "elbow", "parent": "shoulder", "position": [0, -0.3, 0], "type": "hinge", "axis": [1, 0, 0],
         "low_deg": -150, "high_deg": 0}
SHOULDER = {"name": "shoulder", "position": [0, 1.4, 0], "swing_deg": 130}
SWING = {"name": "swing", "help": "Raises the arm, bends the elbow, and comes back.", "duration_s": [0.5, 2],
         "params": {"angle_deg": {"type": "number", "low": -90, "high": 90, "default": 45},
                    "bend_deg": {"type": "number", "low": 0, "high": 110, "special": [90]}}}
MANIFEST = {"name": "walker", "actions": [SWING], "characters": [{"name": "hero", "joints": [SHOULDER, ELBOW]}]}


def motion(request):
    for time_s in request.times():
        pose = request.rest()
        raised_deg = bent_deg = 0
        for use in request.uses:
            share = math.sin(math.pi * use.progress(time_s)) ** 2
            raised_deg += share * use.params["angle_deg"]
            bent_deg += share * use.params["bend_deg"]
        pose.turn("shoulder", (1, 0, 0), raised_deg)
        pose.turn("elbow", (1, 0, 0), -bent_deg)
        yield pose


serve(MANIFEST, motion)
