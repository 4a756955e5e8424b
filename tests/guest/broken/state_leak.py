"""Forgets to begin afresh: the angle of a request depends on the number of the requests before it."""
import good

requests = 0


def answer(request, pose):
    global requests
    requests += 1
    offset = min(requests, 20)
    good.answer(request, lambda uses, time_s: [0, 1, 0] + good.about_x(offset) + good.about_x(0))


good.serve(answer=answer)
