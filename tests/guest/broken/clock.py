"""Reads the clock, so that no two answers to one request are the same."""
import time

import good


def answer(request, pose):
    offset_deg = time.time_ns() % 1000 / 100
    good.answer(request, lambda uses, time_s: [0, 1, 0] + good.about_x(offset_deg) + good.about_x(0))


good.serve(answer=answer)
