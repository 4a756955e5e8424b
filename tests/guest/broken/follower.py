"""A wrist that follows the elbow, by the share that is the argument: the manifest says 0.5."""
import copy
import sys

import good

MANIFEST = copy.deepcopy(good.MANIFEST)
MANIFEST["characters"][0]["joints"].append(
    {"name": "wrist", "parent": "elbow", "position": [0, 0.3, 0], "type": "hinge", "axis": [1, 0, 0],
     "low_deg": 0, "high_deg": 100, "follows": {"joint": "elbow", "multiplier": 0.5}})


def pose(uses, time_s):
    _, elbow_deg = good.angles(uses, time_s)
    return good.pose(uses, time_s) + good.about_x(float(sys.argv[1]) * elbow_deg)


good.serve(MANIFEST, pose=pose)
