#!/usr/bin/env python3
"""rigged_model.py FILE.glb: writes a rigged figure of boxes, 1.8 m high, with two clips, for readers without a model.

The clip `wave` raises the left arm and lowers it. The clip `salute` has a fault: the right arm jumps within one frame.
"""
import json
import math
import struct
import sys

# Name, parent, joint in the world (m), and the lowest and highest corner of the box of skin, from the joint (m).
BONES = [("Hips", None, (0, 1.0, 0), (-.15, -.1, -.1), (.15, .1, .1)),
         ("Spine", "Hips", (0, 1.1, 0), (-.15, 0, -.1), (.15, .4, .1)),
         ("Head", "Spine", (0, 1.55, 0), (-.09, 0, -.1), (.09, .25, .1))]
for side, s in (("Left", 1), ("Right", -1)):
    def box(length, half, s=s):
        return (min(0, s * length), -half, -half), (max(0, s * length), half, half)
    BONES += [(side + "Arm", "Spine", (.2 * s, 1.45, 0), *box(.28, .05)),
              (side + "ForeArm", side + "Arm", (.48 * s, 1.45, 0), *box(.25, .04)),
              (side + "Hand", side + "ForeArm", (.73 * s, 1.45, 0), *box(.18, .03)),
              (side + "UpLeg", "Hips", (.1 * s, .95, 0), (-.07, -.45, -.07), (.07, 0, .07)),
              (side + "Leg", side + "UpLeg", (.1 * s, .5, 0), (-.05, -.42, -.05), (.05, 0, .05)),
              (side + "Foot", side + "Leg", (.1 * s, .08, 0), (-.05, -.08, -.06), (.05, 0, .18))]
NAMES = [bone[0] for bone in BONES]
# Per clip: the joint, and its angle about the forward axis (degrees) at each time (s).
CLIPS = {"wave": ("LeftArm", [(0, 0), (0.6, 50), (1.4, 0)]),
         "salute": ("RightArm", [(0, 0), (0.5, 0), (0.5 + 1 / 60, -60), (1, -60)])}
FACES = [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5]
FLOAT, BYTE, SHORT = (5126, "f"), (5121, "B"), (5123, "H")

data, views, accessors = bytearray(), [], []


def add(kind, letter, rows):
    """Adds rows of numbers to the binary part of the file and returns the index of their accessor."""
    packed = b"".join(struct.pack("<%d%s" % (len(row), letter[1]), *row) for row in rows)
    views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(packed)})
    data.extend(packed + bytes(-len(packed) % 4))
    accessors.append({"bufferView": len(views) - 1, "componentType": letter[0], "count": len(rows), "type": kind,
                      "min": [min(c) for c in zip(*rows)], "max": [max(c) for c in zip(*rows)]})
    return len(accessors) - 1


def nodes():
    places = {bone[0]: bone[2] for bone in BONES}
    result = []
    for name, parent, place, _, _ in BONES:
        above = places.get(parent, (0, 0, 0))
        node = {"name": name, "translation": [p - a for p, a in zip(place, above)]}
        children = [i for i, bone in enumerate(BONES) if bone[1] == name]
        result.append({**node, "children": children} if children else node)
    return result + [{"name": "Skin", "mesh": 0, "skin": 0}]


def mesh():
    corners = [[place[a] + (low, high)[i >> a & 1][a] for a in range(3)]
               for _, _, place, low, high in BONES for i in range(8)]
    owners = [[bone, 0, 0, 0] for bone in range(len(BONES)) for _ in range(8)]
    indices = [[8 * bone + i] for bone in range(len(BONES)) for i in FACES]
    attributes = {"POSITION": add("VEC3", FLOAT, corners), "JOINTS_0": add("VEC4", BYTE, owners),
                  "WEIGHTS_0": add("VEC4", FLOAT, [[1, 0, 0, 0]] * len(owners))}
    return {"primitives": [{"attributes": attributes, "indices": add("SCALAR", SHORT, indices)}]}


def animation(name, joint, keys):
    halves = [(time, math.radians(angle_deg) / 2) for time, angle_deg in keys]
    sampler = {"input": add("SCALAR", FLOAT, [[time] for time, _ in halves]),
               "output": add("VEC4", FLOAT, [[0, 0, math.sin(h), math.cos(h)] for _, h in halves])}
    target = {"node": NAMES.index(joint), "path": "rotation"}
    return {"name": name, "samplers": [sampler], "channels": [{"sampler": 0, "target": target}]}


def main():
    inverse = [[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, *(-p for p in bone[2]), 1] for bone in BONES]
    root = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, len(BONES)]}], "nodes": nodes(),
            "meshes": [mesh()], "animations": [animation(name, *clip) for name, clip in CLIPS.items()],
            "skins": [{"joints": list(range(len(BONES))), "inverseBindMatrices": add("MAT4", FLOAT, inverse)}],
            "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": len(data)}]}
    text = json.dumps(root).encode()
    text += b" " * (-len(text) % 4)
    with open(sys.argv[1], "wb") as file:
        file.write(struct.pack("<4sIII4s", b"glTF", 2, 28 + len(text) + len(data), len(text), b"JSON"))
        file.write(text + struct.pack("<I4s", len(data), b"BIN\0") + data)


main()
