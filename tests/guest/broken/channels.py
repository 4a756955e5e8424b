"""Says in channels what it does. A parameter tells it what to break."""
import good

BREAKS = {"breaks": {"type": "choice", "choices": ["nothing", "contact", "presence", "count", "type"]}}
MANIFEST = {**good.MANIFEST, "name": "channels",
            "actions": [{"name": "stand", "duration_s": [0.1, 1.5], "params": BREAKS}],
            "channels": [{"name": "state", "type": "text"}, {"name": "speed", "type": "number"},
                         {"name": "stands", "type": "flag", "contact": "shoulder"}]}


def answer(request, pose):
    broken = {use["params"]["breaks"] for use in request["timeline"]}
    frames = request["frames"]
    stands = [3 <= frame < 9 for frame in range(frames)]
    channels = {"state": ["wait"] * 3 + ["stand"] * (frames - 3), "speed": [0.5] * frames, "stands": stands}
    if "presence" in broken:
        del channels["speed"]
    if "count" in broken:
        channels["state"].pop()
    if "type" in broken:
        channels["stands"][2] = 1
    glides = 0.01 if "contact" in broken else 0.001
    data = good.rows(request, lambda uses, time_s: [0, 1, glides * time_s * request["rate_hz"]] + good.about_x(0) * 2)
    good.send({"id": request["id"], "bytes": len(data), "channels": channels}, data)


good.serve(manifest=MANIFEST, answer=answer)
