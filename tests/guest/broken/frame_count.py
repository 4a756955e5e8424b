"""Answers with one frame less than it was asked for."""
import good


def answer(request, pose):
    good.answer({**request, "frames": request["frames"] - 1}, pose)


good.serve(answer=answer)
