"""Lets Contort test an animation generator that is written in Python, or that Python can call.

Copy this file next to your code. Give `serve` a manifest (docs/reference/guests.md has all its fields) and a
function that yields one pose for each frame. The file needs Python 3.8 and nothing else.
"""
import json
import math
import os
import socket
import struct
import sys
import traceback


class Refused(Exception):
    """Raise this when a request is outside what your generator can do. Contort does not count it as a fault."""


class Use:
    """One use of an action: when it starts, how long it lasts, and its parameters."""

    def __init__(self, fields):
        self.action = fields["action"]
        self.slot = fields.get("slot", "")
        self.start_frame = fields["start_frame"]
        self.start_s = fields["start_s"]
        self.duration_s = fields["duration_s"]
        self.end_s = self.start_s + self.duration_s
        self.blend_in_s = fields.get("blend_in_s", 0)
        self.blend_out_s = fields.get("blend_out_s", 0)
        self.params = fields.get("params", {})

    def progress(self, time_s):
        """The share of the action that is over: 0 before and at its start, 1 at its end and after it."""
        if time_s >= self.end_s:
            return 1.0
        return max(0.0, (time_s - self.start_s) / self.duration_s)


class Pose:
    """Where the root is, and how each joint is turned against its parent. It begins as the rest pose."""

    def __init__(self, joints):
        self._index = {joint["name"]: i for i, joint in enumerate(joints)}
        self._rest = [tuple(joint.get("rotation", (0, 0, 0, 1))) for joint in joints]
        self.root = tuple(joints[0].get("position", (0, 0, 0)))
        self.rotations = list(self._rest)

    def __setitem__(self, joint, rotation):
        """Sets the quaternion (x, y, z, w) of a joint against its parent."""
        self.rotations[self._index[joint]] = rotation

    def __getitem__(self, joint):
        return self.rotations[self._index[joint]]

    def turn(self, joint, axis, angle_deg):
        """Turns a joint by an angle about an axis of its own frame, starting from its rest rotation."""
        self[joint] = multiply(self._rest[self._index[joint]], quaternion(axis, angle_deg))


class Request:
    """One motion that Contort asks for."""

    def __init__(self, fields, manifest):
        self.id = fields["id"]
        self.character = fields["character"]
        self.parts = fields.get("parts", {})
        self.seed = fields.get("seed", 0)
        self.rate_hz = fields["rate_hz"]
        self.frames = fields["frames"]
        self.uses = [Use(use) for use in fields["timeline"]]
        self._joints = next(c["joints"] for c in manifest["characters"] if c["name"] == self.character)

    def times(self):
        """The time of each frame in seconds."""
        return (frame / self.rate_hz for frame in range(self.frames))

    def rest(self):
        """A new rest pose of the character."""
        return Pose(self._joints)


def quaternion(axis, angle_deg):
    """The quaternion (x, y, z, w) that turns by an angle about an axis, which need not have length 1."""
    length = math.sqrt(sum(a * a for a in axis))
    half = math.radians(angle_deg) / 2
    return tuple(a / length * math.sin(half) for a in axis) + (math.cos(half),)


def multiply(a, b):
    """The product of two quaternions (x, y, z, w): first b, then a."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz)


def serve(manifest, motion, tcp=False):
    """Answers requests until Contort closes the connection. `motion(request)` yields a Pose for each frame.

    With `tcp` it connects to the port in CONTORT_PORT, for programs that cannot use their standard streams.
    """
    manifest = {"contort": 1, **manifest}
    if tcp:
        manifest["token"] = os.environ["CONTORT_TOKEN"]
    source, sink = _connect() if tcp else _standard_streams()
    letter = "f" if manifest.get("frames") == "f32" else "d"
    for line in source:
        message = json.loads(line)
        if message["op"] == "hello":
            sink.write(json.dumps(manifest).encode() + b"\n")
        elif message["op"] == "generate":
            sink.write(_answer(message, manifest, motion, letter))
        sink.flush()


def _answer(message, manifest, motion, letter):
    reply = {"id": message["id"]}
    rows = b""
    try:
        values = []
        for pose in motion(Request(message, manifest)):
            values.extend(pose.root)
            for rotation in pose.rotations:
                values.extend(rotation)
        rows = struct.pack("<%d%s" % (len(values), letter), *values)
        reply["bytes"] = len(rows)
    except Refused as reason:
        reply.update(error="refused", text=str(reason))
    except Exception:  # Whatever the generator raises is a finding for the report.
        reply.update(error="failed", text=traceback.format_exc(limit=-4))
    return json.dumps(reply).encode() + b"\n" + rows


def _connect():
    connection = socket.create_connection(("127.0.0.1", int(os.environ["CONTORT_PORT"])))
    connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return connection.makefile("rb"), connection.makefile("wb")


def _standard_streams():
    """The two ends of the connection. All that the generator prints from now on goes to standard error."""
    sink = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    return sys.stdin.buffer, sink
