"""Declares every effect and relation, a goal, and a part to swap, and keeps what it is asked to keep.

Each use says in `keeps` whether its promise is kept. With `--tcp` it speaks over a connection, and with `--forget` it
sends another token.
"""
import io
import os
import socket
import sys

import good

KEEPS = {"keeps": {"type": "flag", "default": True}}
ACTIONS = [
    {"name": "bend", "effect": "cut", "params": KEEPS},
    {"name": "rest", "effect": "rest", "params": KEEPS},
    {"name": "fresh", "effect": "equals", "params": KEEPS},
    {"name": "nothing", "effect": "none", "params": KEEPS},
    {"name": "reach", "effect": "cut", "goal": {"param": "to", "tip": "elbow"},
     "params": {**KEEPS, "to": {"type": "vec3", "low": -2, "high": 2, "default": [0, 1.3, 0]}}},
    {"name": "remember", "params": KEEPS},
    {"name": "depend_on_rate", "params": KEEPS},
    {"name": "pass", "effect": "cut", "duration_s": [0.1, 0.2], "returns_s": 0.05, "params": KEEPS},
    {"name": "near", "params": {**KEEPS, "by": {"type": "number", "default": 0.5}}},
    {"name": "lean", "params": {**KEEPS, "side": {"type": "number", "low": -1, "mirror": "opposite"}}},
]
JOINTS = good.MANIFEST["characters"][0]["joints"]
MANIFEST = {**good.MANIFEST, "name": "promises", "actions": ACTIONS, "relations": ["history", "rate", "gain", "mirror"],
            "characters": [{"name": "hero", "joints": JOINTS, "parts": {"body": ["plain", "bent"]}}]}
previous = []  # the uses of the last request


def is_over(use, time_s):
    return time_s > use["start_s"] + use["duration_s"]


def elbow_deg(request, time_s):
    """The angle of the elbow: that of the last use that has begun, which a broken promise changes by 20 degrees."""
    angle = 10 if request["parts"].get("body") == "bent" else 0
    begun = [use for use in request["timeline"] if use["start_s"] <= time_s + 1e-9]
    for number, use in enumerate(begun):
        broken = 0 if use["params"]["keeps"] else 20
        angle = {"bend": 30, "rest": broken, "fresh": 5 + broken * (number > 0), "nothing": angle + broken,
                 "pass": angle + (broken if is_over(use, time_s) else 10),
                 "near": broken * (use["params"].get("by", 0) > 0.5),
                 "lean": broken * (use["params"].get("side", 0) > 0), "reach": angle, "remember": broken * (len(previous) > 3),
                 "depend_on_rate": broken * (request["rate_hz"] < 60)}[use["action"]]
    return angle


def answer(request, pose):
    global previous
    missed = any(use["action"] == "reach" and not use["params"]["keeps"] for use in request["timeline"])
    height = 1.1 if missed else 1

    def placed(uses, time_s):
        return [0, height, 0] + good.about_x(0) + good.about_x(elbow_deg(request, time_s))

    good.answer(request, placed)
    previous = request["timeline"]


if "--tcp" in sys.argv:
    print("A banner, which is log here.", flush=True)
    connection = socket.create_connection(("127.0.0.1", int(os.environ["CONTORT_PORT"])))
    sys.stdin = connection.makefile("r")
    sys.stdout = io.TextIOWrapper(connection.makefile("wb"))
    MANIFEST["token"] = "another" if "--forget" in sys.argv else os.environ["CONTORT_TOKEN"]
good.serve(manifest=MANIFEST, answer=answer)
