# Lets Contort test AnimationPlayer and SkeletonIK of Godot 3 on a figure with one arm and one leg.
extends "contort_guest.gd"

const X = Vector3(1, 0, 0)
const Y = Vector3(0, 1, 0)
const BONES = [  # name, parent, position at rest
	["root", "", Vector3(0, 1, 0)],
	["spine", "root", Vector3(0, 0.2, 0)],
	["arm", "spine", Vector3(0.2, 0.3, 0)],
	["forearm", "arm", Vector3(0.3, 0, 0)],
	["thigh", "root", Vector3(0.1, 0, 0)],
	["shin", "thigh", Vector3(0, -0.45, 0.02)],
	["foot", "shin", Vector3(0, -0.45, -0.02)],
]
# Clips begin and end in the rest pose. A track is a bone, an axis, times, and angles in degrees.
const CLIPS = {
	"bow": [1.6, [["spine", X, [0.0, 0.7, 1.0, 1.6], [0, 40, 35, 0]], ["arm", Y, [0.0, 0.5, 1.6], [0, -30, 0]]]],
	"wave": [1.2, [["arm", Y, [0.0, 0.4, 0.8, 1.2], [0, -35, -20, 0]], ["forearm", Y, [0.0, 0.5, 1.2], [0, -40, 0]]]],
}
# The targets of the foot lie in front of the figure and below its hip, within reach.
const TARGET = {"type": "vec3", "low": [0.0, 0.25, 0.0], "high": [0.2, 0.5, 0.4], "default": [0.1, 0.4, 0.2]}
const CLIP = {"type": "choice", "choices": ["bow", "wave"]}
const SPEED = {"type": "number", "low": -1.5, "high": 1.5, "default": 1, "special": [-1, 0.5]}
const ACTIONS = {
	"play": {"effect": "cut", "duration_s": [0.2, 2.5], "params": {"clip": CLIP, "speed": SPEED}},
	"blend_to": {"effect": "continuous", "duration_s": [0.2, 2.5], "params": {"clip": CLIP,
			"over_s": {"type": "number", "low": 0.4, "high": 1}}},
	"speed": {"effect": "continuous", "params": {"speed": SPEED}},
	"seek": {"effect": "cut", "params": {"share": {"type": "number", "low": 0, "high": 1}}},
	"stop": {"effect": "rest", "params": {}, "help": "Stops the clip and the leg, and returns to rest."},
	"step": {"effect": "cut", "layer": "ik", "params": {"target": TARGET},
			"goal": {"param": "target", "tip": "foot", "within": 0.02}},
}

var figure
var skeleton
var player
var leg


func manifest():
	var joints = []
	for bone in BONES:
		var joint = {"name": bone[0], "parent": bone[1], "position": [bone[2].x, bone[2].y, bone[2].z],
				"max_speed_deg_s": 600}
		if bone[0] == "shin":  # A human knee.
			joint["type"] = "hinge"
			joint["axis"] = [1, 0, 0]
			joint["low_deg"] = -2
			joint["high_deg"] = 150
		joints.append(joint)
	var actions = []
	for name in ACTIONS:
		var action = ACTIONS[name].duplicate()
		action["name"] = name
		actions.append(action)
	return {"name": "godot", "build": Engine.get_version_info().string, "actions": actions,
			"characters": [{"name": "figure", "joints": joints}]}


func build():
	figure = Spatial.new()
	skeleton = Skeleton.new()
	skeleton.name = "Skeleton"
	figure.add_child(skeleton)
	for bone in BONES:
		skeleton.add_bone(bone[0])
		var index = skeleton.find_bone(bone[0])
		if bone[1] != "":
			skeleton.set_bone_parent(index, skeleton.find_bone(bone[1]))
		skeleton.set_bone_rest(index, Transform(Basis(), bone[2]))
	player = AnimationPlayer.new()
	player.playback_process_mode = AnimationPlayer.ANIMATION_PROCESS_MANUAL
	figure.add_child(player)
	for name in CLIPS:
		player.add_animation(name, make_clip(CLIPS[name]))
	leg = SkeletonIK.new()
	leg.root_bone = "thigh"
	leg.tip_bone = "foot"
	skeleton.add_child(leg)
	get_root().add_child(figure)


func make_clip(clip):
	var animation = Animation.new()
	animation.length = clip[0]
	animation.loop = true
	for track in clip[1]:
		var index = animation.add_track(Animation.TYPE_TRANSFORM)
		animation.track_set_path(index, NodePath("Skeleton:" + track[0]))
		for key in range(track[2].size()):
			var turned = Quat(track[1], deg2rad(track[3][key]))
			animation.transform_track_insert_key(index, track[2][key], Vector3(), turned, Vector3(1, 1, 1))
	return animation


func generate(request):
	build()
	var rows = []
	var next = 0
	var stepping = false
	for frame in range(int(request.frames)):
		while next < request.timeline.size() and request.timeline[next].start_frame <= frame:
			var use = request.timeline[next]
			stepping = begin(use.action, use.params, stepping)
			next += 1
		player.advance(0.0 if frame == 0 else 1.0 / request.rate_hz)
		if stepping:
			leg.start(true)
		rows.append(row())
	figure.free()
	return rows


# Carries out an operation. Returns whether the leg follows a target afterwards.
func begin(action, params, stepping):
	if action == "play":
		player.play(params.clip, 0, params.speed, params.speed < 0)
	elif action == "blend_to":
		player.play(params.clip, params.over_s)
	elif action == "speed":
		player.playback_speed = params.speed
	elif action == "seek" and player.is_playing():
		player.seek(params.share * player.current_animation_length)
	elif action == "step":
		leg.target = Transform(Basis(), Vector3(params.target[0], params.target[1], params.target[2]))
		return true
	elif action == "stop":
		player.stop()
		skeleton.clear_bones_global_pose_override()
		for bone in range(skeleton.get_bone_count()):
			skeleton.set_bone_pose(bone, Transform())
		return false
	return stepping


func row():
	var out = []
	for bone in range(skeleton.get_bone_count()):
		var local = skeleton.get_bone_global_pose(bone)
		var parent = skeleton.get_bone_parent(bone)
		if parent >= 0:
			local = skeleton.get_bone_global_pose(parent).affine_inverse() * local
		else:
			out += [local.origin.x, local.origin.y, local.origin.z]
		var turned = local.basis.get_rotation_quat()
		out += [turned.x, turned.y, turned.z, turned.w]
	return out
