"""Writes z for up, while the manifest says that y is up: hinges turn about another axis than it declares."""
import good


def pose(uses, time_s):
    x, y, z, *rotations = good.pose(uses, time_s)
    shoulder, elbow = rotations[:4], rotations[4:]
    return [x, z, y] + [shoulder[i] for i in (1, 2, 0, 3)] + [elbow[i] for i in (1, 2, 0, 3)]


good.serve(pose=pose)
