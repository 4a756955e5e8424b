"""Ends with a message on standard error when two swings are asked for."""
import sys

import good


def answer(request, pose):
    if len(request["timeline"]) > 1:
        sys.exit("walker: the pool of clips is exhausted")
    good.answer(request, pose)


good.serve(answer=answer)
