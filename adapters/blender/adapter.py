"""Lets Contort test the constraints of Blender: inverse kinematics with its limits, and Limit Rotation.

contort fuzz --generator "blender -b --factory-startup [FILE.blend] --python adapter.py"
"""
import pathlib
import sys
from math import radians

import bpy
from mathutils import Matrix, Quaternion, Vector

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "python")]

import figure  # noqa: E402
from contort_guest import serve  # noqa: E402
from rig import Rig, word  # noqa: E402

SHARE = {"type": "number", "low": 0, "high": 1, "default": 1}
ANGLE = {"type": "number", "low": -180, "high": 180, "default": 30, "special": [90, -90]}
AXES = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}


class Glide:
    """A value that moves smoothly from what it is to a goal."""

    def __init__(self, value):
        self.begin = self.goal = value
        self.start_s, self.duration_s = 0.0, 1.0

    def to(self, goal, use):
        self.begin, self.goal = self.at(use.start_s), goal
        self.start_s, self.duration_s = use.start_s, use.duration_s

    def at(self, time_s):
        share = min(1.0, max(0.0, (time_s - self.start_s) / self.duration_s))
        eased = share * share * (3 - 2 * share)
        return self.begin + (self.goal - self.begin) * eased


def open_armature():
    """The first armature of the file that is open, or the figure."""
    armatures = [each for each in bpy.context.scene.objects if each.type == "ARMATURE"]
    return armatures[0] if armatures else figure.build()


def rotation_vector(quaternion):
    """Axis times angle: between two of them there is one straight way, also for half a turn."""
    axis, angle = quaternion.to_axis_angle()
    return axis * angle


def new_empty(name, place):
    empty = bpy.data.objects.new(name, None)
    empty.location = place
    bpy.context.scene.collection.objects.link(empty)
    return empty


class Scene:
    """The rig with an empty for each target, and the way back to how the file was opened."""

    def __init__(self, rig):
        self.rig = rig
        world = rig.armature.matrix_world
        bpy.context.view_layer.update()
        tips = {slot: world @ chain.owner.tail for slot, chain in rig.chains.items()}
        still = {bone.name for chain in rig.chains.values() if "contort_low" in chain.owner
                 for bone in chain.owner.parent_recursive}  # If they turned, targets would be out of reach.
        self.free = {word(bone.name): bone for bone in rig.free_bones() if bone.name not in still}
        self.opened = {name: bone.matrix_basis.copy() for name, bone in self.free.items()}
        self.influences = {slot: chain.constraint.influence for slot, chain in rig.chains.items()}
        self.targets, self.poles = {}, {}
        for slot, chain in rig.chains.items():
            self.targets[slot] = new_empty(slot + " target", tips[slot])
            if chain.constraint.pole_target:
                self.poles[slot] = new_empty(slot + " pole", self._pole(chain.constraint))
                chain.constraint.pole_target, chain.constraint.pole_subtarget = self.poles[slot], ""
            chain.constraint.target, chain.constraint.subtarget = self.targets[slot], ""
        self.places = {empty: empty.location.copy() for empty in [*self.targets.values(), *self.poles.values()]}

    @staticmethod
    def _pole(constraint):
        pole = constraint.pole_target
        bone = pole.pose.bones.get(constraint.pole_subtarget) if pole.type == "ARMATURE" else None
        return pole.matrix_world @ bone.head if bone else pole.matrix_world.translation

    def glides(self):
        """What the actions move, as it was when the file was opened."""
        return {"target": {slot: Glide(self.places[empty]) for slot, empty in self.targets.items()},
                "pole": {slot: Glide(self.places[empty]) for slot, empty in self.poles.items()},
                "influence": {slot: Glide(value) for slot, value in self.influences.items()},
                "turn": {name: Glide(rotation_vector(basis.to_quaternion())) for name, basis in self.opened.items()}}

    def show(self, glides, time_s):
        """The position of the root and the rotations of the joints at a time."""
        for slot, chain in self.rig.chains.items():
            self.targets[slot].location = glides["target"][slot].at(time_s)
            chain.constraint.influence = glides["influence"][slot].at(time_s)
        for slot, empty in self.poles.items():
            empty.location = glides["pole"][slot].at(time_s)
        for name, bone in self.free.items():
            place, _, scale = self.opened[name].decompose()
            vector = glides["turn"][name].at(time_s)
            turned = Quaternion(vector, vector.length)
            bone.matrix_basis = Matrix.LocRotScale(place, turned, scale)
        bpy.context.view_layer.update()
        return self.rig.pose(bpy.context.evaluated_depsgraph_get())

    def box(self, chain):
        """The targets: those that the artist gives in two properties of the bone, or those around the tip."""
        if "contort_low" in chain.owner:
            return [[round(each, 6) for each in chain.owner["contort_" + end]] for end in ("low", "high")]
        return self.around(self.targets[chain.slot], 0.3 * chain.length)

    def around(self, empty, half):
        return [[round(each + side * half, 3) for each in self.places[empty]] for side in (-1, 1)]


def actions(scene):
    """What can be asked for. Only a chain with a box of its own promises to arrive at its target."""
    offered = []
    for slot, chain in scene.rig.chains.items():
        low, high = scene.box(chain)
        reach = {"name": "reach", "help": "Moves the target of the IK constraint, with full influence.",
                 "params": {"target": {"type": "vec3", "low": low, "high": high}}}
        if "contort_low" in chain.owner:
            reach["goal"] = {"param": "target", "tip": chain.tip, "within": 0.01}
        kinds = [reach, {"name": "influence", "help": "Fades the IK constraint.", "params": {"share": SHARE}}]
        if slot in scene.poles:
            low, high = scene.around(scene.poles[slot], 0.5 * chain.length)
            kinds.append({"name": "pole", "help": "Moves the pole target of the IK constraint.",
                          "params": {"target": {"type": "vec3", "low": low, "high": high}}})
        offered += [{"slots": [slot], "layer": "ik", "duration_s": [0.6, 2], **kind} for kind in kinds]
    for slot in sorted({scene.rig.slot(bone) for bone in scene.free.values()}):
        bones = [name for name, bone in scene.free.items() if scene.rig.slot(bone) == slot]
        offered.append({"name": "turn", "help": "Turns a bone to an angle about an axis of its rest position.",
                        "slots": [slot], "duration_s": [1, 3],
                        "params": {"bone": {"type": "choice", "choices": bones}, "angle_deg": ANGLE,
                                   "axis": {"type": "choice", "choices": list(AXES)}}})
    return offered


def begin(use, glides):
    """Carries out an action."""
    if use.action == "reach":
        glides["target"][use.slot].to(Vector(use.params["target"]), use)
        glides["influence"][use.slot].to(1.0, use)
    elif use.action == "influence":
        glides["influence"][use.slot].to(use.params["share"], use)
    elif use.action == "pole":
        glides["pole"][use.slot].to(Vector(use.params["target"]), use)
    elif use.action == "turn":
        goal = Vector(AXES[use.params["axis"]]) * radians(use.params["angle_deg"])
        glides["turn"][use.params["bone"]].to(goal, use)


def main():
    rig = Rig(open_armature())
    scene = Scene(rig)

    def motion(request):
        glides = scene.glides()
        waiting = list(request.uses)
        for time_s in request.times():
            while waiting and waiting[0].start_s <= time_s:
                begin(waiting.pop(0), glides)
            pose = request.rest()
            pose.root, pose.rotations = scene.show(glides, time_s)
            yield pose

    serve({"name": "blender", "build": bpy.app.version_string, "frames": "f32",
           "convention": {"up": "+z", "forward": "-y", "unit_m": bpy.context.scene.unit_settings.scale_length},
           "characters": [{"name": word(rig.armature.name), "joints": rig.joints()}], "actions": actions(scene),
           "relations": ["history", "gain", "rate"]}, motion)


main()
