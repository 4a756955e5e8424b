"""Prints a line after the manifest, where only replies may stand."""
import good


def answer(request, pose):
    print("loading textures", flush=True)
    good.answer(request, pose)


good.serve(answer=answer)
