"""Mixes quaternions without normalising them: half way between two that are 60° apart, the length is 0.97."""
import good


def pose(uses, time_s):
    share = good.angles(uses, time_s)[1] / 60
    mixed = [(1 - share) * a + share * b for a, b in zip(good.about_x(0), good.about_x(60))]
    return [0, 1, 0] + good.about_x(0) + mixed


good.serve(pose=pose)
