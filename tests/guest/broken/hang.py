"""Never answers when two swings are asked for."""
import time

import good


def answer(request, pose):
    while len(request["timeline"]) > 1:
        time.sleep(1)
    good.answer(request, pose)


good.serve(answer=answer)
