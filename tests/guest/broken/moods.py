"""Its second action, `sulk`, does what the argument says: crash, crash_above (20 degrees), hang, or refuse."""
import copy
import os
import sys
import time

import good

MOOD = sys.argv[1]
MANIFEST = copy.deepcopy(good.MANIFEST)
MANIFEST["actions"].append({**MANIFEST["actions"][0], "name": "sulk"})


def answer(request, pose):
    angles = [use["params"]["angle_deg"] for use in request["timeline"] if use["action"] == "sulk"]
    if MOOD == "leave":  # at the first request, and without a word
        os._exit(5)
    if angles and (MOOD == "crash" or (MOOD == "crash_above" and max(angles) > 20)):
        sys.exit("moods: nobody sulks at %g degrees" % max(angles))
    if angles and MOOD == "hang":
        time.sleep(1000)
    if MOOD == "refuse_all" or (angles and MOOD == "refuse"):
        text = "sulking at %g degrees is refused" % max(angles) if angles else "everything is refused"
        return good.send({"id": request["id"], "error": "refused", "text": text})
    good.answer(request, pose)


good.serve(manifest=MANIFEST, answer=answer)
