"""Gives an angle in degrees to a function that takes radians."""
import math

import good


def pose(uses, time_s):
    angle = good.angles(uses, time_s)[0]
    return [0, 1, 0, math.sin(angle / 2), 0, 0, math.cos(angle / 2)] + good.about_x(0)


good.serve(pose=pose)
