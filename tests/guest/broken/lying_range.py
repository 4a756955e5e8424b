"""Declares angles of up to 600° for a parameter, and fails for those beyond the 60° that it can do."""
import copy

import good

manifest = copy.deepcopy(good.MANIFEST)
manifest["actions"][0]["params"]["angle_deg"].update(low=-600, high=600)


def answer(request, pose):
    if any(abs(use["params"]["angle_deg"]) > 60 for use in request["timeline"]):
        good.send({"id": request["id"], "error": "failed", "text": "angle_deg: the table ends at 60"})
    else:
        good.answer(request, pose)


good.serve(manifest=manifest, answer=answer)
