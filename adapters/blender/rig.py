"""Reads the joints, their ranges and their rotations from an armature object of Blender."""
import re
from math import degrees

from mathutils import Quaternion

PRECISION_DEG = 0.01  # Blender counts in single precision, so a joint at its end may lie this far beyond it.


def word(text):
    """The name in the letters that slots and choices may have."""
    return re.sub("[^a-z0-9_]", "_", text.lower())


class Chain:
    """An IK constraint, the bones that it turns, and its tip: the end of the bone that has it."""

    def __init__(self, bone, constraint):
        self.constraint = constraint
        self.slot = word(bone.name)
        self.tip = bone.name + " tip"
        self.owner = bone
        length = constraint.chain_count or len(bone.parent_recursive) + 1
        bones = [bone, *bone.parent_recursive] if constraint.use_tail else bone.parent_recursive
        self.bones = bones[:length]
        self.length = sum(each.bone.length for each in self.bones) * bone.id_data.matrix_world.median_scale


class Rig:
    """An armature object whose joints are the object itself, its bones, and the tips of its IK chains."""

    def __init__(self, armature):
        self.armature = armature
        self.bones = list(armature.pose.bones)  # parents first
        self.root = armature.name if armature.name not in armature.pose.bones else armature.name + " object"
        self.chains = {}
        for bone in self.bones:
            for constraint in bone.constraints:
                if constraint.type == "IK" and not constraint.mute and word(bone.name) not in self.chains:
                    self.chains[word(bone.name)] = Chain(bone, constraint)

    def slot(self, bone):
        """That of the chain to which the bone or the nearest of its parents belongs."""
        for each in [bone, *bone.parent_recursive]:
            for chain in self.chains.values():
                if each in chain.bones:
                    return chain.slot
        return "body"

    def free_bones(self):
        """Those that no chain turns."""
        turned = {bone.name for chain in self.chains.values() for bone in chain.bones}
        return [bone for bone in self.bones if bone.name not in turned]

    def rest(self, bone):
        """Position and rotation of a bone in the world in the armature's rest position."""
        place, turned, _ = (self.armature.matrix_world @ bone.bone.matrix_local).decompose()
        return place, turned

    def joints(self):
        """The joints as the manifest lists them."""
        place, turned, _ = self.armature.matrix_world.decompose()
        root = {"name": self.root, "position": list(place), "rotation": _xyzw(turned)}
        tips = [{"name": chain.tip, "parent": chain.owner.name, "type": "fixed", "slot": chain.slot,
                 "position": [0, chain.owner.bone.length * self.armature.matrix_world.median_scale, 0]}
                for chain in self.chains.values()]
        return [root] + [self._joint(bone) for bone in self.bones] + tips

    def _joint(self, bone):
        in_chain = any(bone in chain.bones for chain in self.chains.values())
        place, turned = self.rest(bone)
        origin, against = self.rest(bone.parent) if bone.parent else self.armature.matrix_world.decompose()[:2]
        back = against.inverted()
        return {"name": bone.name, "parent": bone.parent.name if bone.parent else self.root, "slot": self.slot(bone),
                "position": list(back @ (place - origin)), "rotation": _xyzw(back @ turned),
                **_range(limits_deg(bone, in_chain), in_chain)}

    def pose(self, depsgraph):
        """The position of the root and the rotation of each joint against its parent, as Blender evaluates them."""
        armature = self.armature.evaluated_get(depsgraph)
        place, turned, _ = armature.matrix_world.decompose()
        in_armature = {bone.name: bone.matrix.to_quaternion() for bone in armature.pose.bones}
        rotations = [_xyzw(turned)]
        for bone in self.bones:
            back = in_armature[bone.parent.name].inverted() if bone.parent else Quaternion()
            rotations.append(_xyzw(back @ in_armature[bone.name]))
        return tuple(place), rotations + [(0, 0, 0, 1)] * len(self.chains)


def _xyzw(quaternion):
    return [quaternion.x, quaternion.y, quaternion.z, quaternion.w]


def limits_deg(bone, in_chain):
    """For each of the axes x, y and z the ends of the range that the artist gave the bone, in degrees."""
    ends = [[-180.0, 180.0] for _ in "xyz"]
    for index, axis in enumerate("xyz"):
        if in_chain and getattr(bone, "lock_ik_" + axis):
            ends[index] = [0.0, 0.0]
        elif in_chain and getattr(bone, "use_ik_limit_" + axis):
            ends[index] = [degrees(getattr(bone, "ik_min_" + axis)), degrees(getattr(bone, "ik_max_" + axis))]
        for constraint in _limit_rotations(bone):
            if getattr(constraint, "use_limit_" + axis):
                ends[index][0] = max(ends[index][0], degrees(getattr(constraint, "min_" + axis)))
                ends[index][1] = min(ends[index][1], degrees(getattr(constraint, "max_" + axis)))
    return ends


def _limit_rotations(bone):
    return [constraint for constraint in bone.constraints if constraint.type == "LIMIT_ROTATION"
            and constraint.owner_space == "LOCAL" and constraint.influence == 1 and not constraint.mute]


def _range(ends, in_chain):
    """Type and range of a joint."""
    free = [index for index in range(3) if ends[index][1] - ends[index][0] > PRECISION_DEG]
    if not free:
        return {"type": "fixed"}
    if len(free) == 1:
        low, high = _with_rest(ends[free[0]])
        axis = [float(index == free[0]) for index in range(3)]
        return {"type": "hinge", "axis": axis, "low_deg": low, "high_deg": high}
    x, y, z = (_with_rest(pair) for pair in ends)
    widest = [min(180.0, max(-low, high)) for low, high in (x, z)]
    if not in_chain:  # Limit Rotation limits Euler angles, which say nothing about the twist.
        return {"axis": [0, 1, 0], "swing_deg": min(180, sum(widest))}
    return {"axis": [0, 1, 0], "low_deg": y[0], "high_deg": y[1], "swing_axis": [1, 0, 0], "swing_deg": widest}


def _with_rest(pair):
    low, high = min(0, pair[0]) - PRECISION_DEG, max(0, pair[1]) + PRECISION_DEG
    return (low, high) if high - low < 360 else (-180, 180)
