"""A correct generator of two joints, and the base of the broken ones beside it. Each of those replaces one function."""
import json
import math
import struct
import sys

MANIFEST = {
    "contort": 1,
    "name": "good",
    "build": "1",
    "characters": [{"name": "hero", "joints": [
        {"name": "shoulder", "position": [0, 1, 0], "type": "hinge", "axis": [1, 0, 0], "low_deg": -100,
         "high_deg": 100, "max_speed_deg_s": 720},
        {"name": "elbow", "parent": "shoulder", "position": [0, 0.3, 0], "type": "hinge", "axis": [1, 0, 0],
         "low_deg": 0, "high_deg": 100, "max_speed_deg_s": 720}]}],
    "actions": [{"name": "swing", "duration_s": [0.6, 1.5], "params": {
        "angle_deg": {"type": "number", "low": -60, "high": 60, "default": 30}}}],
}


def about_x(angle_deg):
    half = math.radians(angle_deg) / 2
    return [math.sin(half), 0, 0, math.cos(half)]


def angles(uses, time_s):
    """The angles of shoulder and elbow in degrees: the largest swing to either side, so that nothing ever jumps."""
    swings = [0]
    for use in uses:
        share = (time_s - use["start_s"]) / use["duration_s"]
        if 0 < share < 1:
            swings.append(use["params"]["angle_deg"] * math.sin(math.pi * share) ** 2)
    shoulder_deg = max(swings) + min(swings)
    return shoulder_deg, (max(swings) - min(swings)) / 2


def pose(uses, time_s):
    shoulder_deg, elbow_deg = angles(uses, time_s)
    return [0, 1, 0] + about_x(shoulder_deg) + about_x(elbow_deg)


def rows(request, pose):
    times = (frame / request["rate_hz"] for frame in range(request["frames"]))
    values = [value for time_s in times for value in pose(request["timeline"], time_s)]
    return struct.pack("<%dd" % len(values), *values)


def send(reply, data=b""):
    sys.stdout.buffer.write(json.dumps(reply).encode() + b"\n" + data)
    sys.stdout.buffer.flush()


def answer(request, pose=pose):
    data = rows(request, pose)
    send({"id": request["id"], "bytes": len(data)}, data)


def serve(manifest=MANIFEST, answer=answer, pose=pose):
    for line in sys.stdin:
        message = json.loads(line)
        if message["op"] == "hello":
            send(manifest)
        else:
            answer(message, pose)


if __name__ == "__main__":
    serve()
