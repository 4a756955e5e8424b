"""Refuses large angles, and motions with many swings, each with its reason."""
import good


def answer(request, pose):
    refusal = {"id": request["id"], "error": "refused"}
    if any(abs(use["params"]["angle_deg"]) > 55 for use in request["timeline"]):
        good.send({**refusal, "text": "the angle is too large"})
    elif len(request["timeline"]) > 3:
        good.send({**refusal, "text": "there are too many swings"})
    else:
        good.answer(request, pose)


good.serve(answer=answer)
