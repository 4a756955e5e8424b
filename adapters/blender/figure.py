"""The figure that is tested if Blender has no armature open: a trunk with a head, an arm, a leg and a tail."""
from math import radians

import bpy

BONES = (  # name, parent, head, tail, where the bone's Z axis points
    ("spine", "", (0, 0, 1), (0, 0, 1.45), (0, -1, 0)),
    ("head", "spine", (0, 0, 1.45), (0, 0, 1.7), (0, -1, 0)),
    ("upper_arm", "spine", (0.2, 0, 1.4), (0.28, 0.05, 1.12), (0, -1, 0)),
    ("forearm", "upper_arm", (0.28, 0.05, 1.12), (0.3, -0.15, 0.92), (-0.08, -0.05, 0.28)),
    ("hand", "forearm", (0.3, -0.15, 0.92), (0.3, -0.22, 0.85), (0, -1, 1)),
    ("thigh", "spine", (0.1, 0, 0.95), (0.1, -0.12, 0.53), (0, -1, 0)),
    ("shin", "thigh", (0.1, -0.12, 0.53), (0.1, 0.03, 0.13), (0, -1, 0)),
    ("foot", "shin", (0.1, 0.03, 0.13), (0.1, -0.12, 0.05), (0, 0, 1)),
    ("tail_1", "spine", (0, 0.1, 1), (0, 0.28, 0.98), (0, 0, 1)),
    ("tail_2", "tail_1", (0, 0.28, 0.98), (0, 0.46, 1), (0, 0, 1)),
    ("tail_3", "tail_2", (0, 0.46, 1), (0, 0.64, 1.04), (0, 0, 1)),
    ("tail_4", "tail_3", (0, 0.64, 1.04), (0, 0.8, 1.1), (0, 0, 1)),
)
# The bone that has the constraint, the length of its chain, and the box of targets, all of which it can reach.
CHAINS = (
    ("forearm", 2, (0.1, -0.42, 1.15), (0.35, -0.22, 1.35)),
    ("shin", 2, (0.0, -0.3, 0.25), (0.2, 0.1, 0.45)),
    ("tail_4", 4, (-0.25, 0.4, 0.8), (0.25, 0.65, 1.2)),
)
# Ranges of the IK panel, in degrees about the bone's X, Y and Z. The elbow is a hinge.
IK_LIMITS = {"upper_arm": ((-80, 80), (-20, 20), (-80, 80)), "forearm": ((-50, 95), None, None),
             **{"tail_%d" % i: ((-75, 75), (-20, 20), (-75, 75)) for i in range(1, 5)}}
# Where the pole target of a chain is, and the pole angle for which the rest position stays as it is.
POLES = {"forearm": ((0.42, 0.6, 0.95), -99.9)}
# Ranges of Limit Rotation constraints.
LIMIT_ROTATIONS = {"head": ((-40, 40), (-70, 70), (-30, 30)), "shin": ((-120, 10), (0, 0), (0, 0))}


def build():
    """Makes the figure and returns its armature object."""
    armature = bpy.data.armatures.new("figure")
    figure = bpy.data.objects.new("figure", armature)
    bpy.context.scene.collection.objects.link(figure)
    bpy.context.view_layer.objects.active = figure
    bpy.ops.object.mode_set(mode="EDIT")
    for name, parent, head, tail, z_axis in BONES:
        bone = armature.edit_bones.new(name)
        bone.head, bone.tail = head, tail
        bone.parent = armature.edit_bones.get(parent)
        bone.align_roll(z_axis)
    bpy.ops.object.mode_set(mode="OBJECT")
    for name, length, low, high in CHAINS:
        bone = figure.pose.bones[name]
        constraint = bone.constraints.new("IK")
        constraint.chain_count = length
        if name in POLES:
            constraint.pole_target = bpy.data.objects.new(name + " pole of the figure", None)
            bpy.context.scene.collection.objects.link(constraint.pole_target)
            constraint.pole_target.location = POLES[name][0]
            constraint.pole_angle = radians(POLES[name][1])
        bone["contort_low"], bone["contort_high"] = low, high
    for name, ranges in IK_LIMITS.items():
        _limit_ik(figure.pose.bones[name], ranges)
    for name, ranges in LIMIT_ROTATIONS.items():
        _limit_rotation(figure.pose.bones[name], ranges)
    return figure


def _limit_ik(bone, ranges):
    for axis, ends_deg in zip("xyz", ranges):
        setattr(bone, "lock_ik_" + axis, ends_deg is None)
        if ends_deg:
            setattr(bone, "use_ik_limit_" + axis, True)
            setattr(bone, "ik_min_" + axis, radians(ends_deg[0]))
            setattr(bone, "ik_max_" + axis, radians(ends_deg[1]))


def _limit_rotation(bone, ranges):
    constraint = bone.constraints.new("LIMIT_ROTATION")
    constraint.owner_space = "LOCAL"
    for axis, ends_deg in zip("xyz", ranges):
        setattr(constraint, "use_limit_" + axis, True)
        setattr(constraint, "min_" + axis, radians(ends_deg[0]))
        setattr(constraint, "max_" + axis, radians(ends_deg[1]))
