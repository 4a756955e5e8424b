"""Usage: plot.py CONTORT FOLDER. Reads people.json there, has CONTORT make the same gaits, and writes figure.svg."""
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

ANGLES = ("thigh", "knee", "ankle")
RATE_HZ = 120
THIGH_M, SHANK_M, ANKLE_M, HEEL_M, TOE_M = 0.4222, 0.4403, 0.07, -0.05, 0.208  # of `human`
PANEL_W, PANEL_H, LEFT, TOP, GAP = 250, 150, 130, 50, 40


def generated(contort, gait):
    """The motion of the built-in generator, as it writes it."""
    use = {"action": gait["action"], "slot": "waist", "duration_frames": 1440,
           "params": {"speed_m_s": gait["speed_m_s"]}}
    spec = {"format": "contort.spec/1", "character": {"name": "human"}, "rate_hz": RATE_HZ,
            "sequences": [{"clips": [{"actions": [use]}]}]}
    with tempfile.TemporaryDirectory() as folder:
        source, target = Path(folder, "spec.json"), Path(folder, "motion.json")
        source.write_text(json.dumps(spec))
        subprocess.run([contort, "generate", str(source), "-o", str(target)], check=True, stdout=subprocess.DEVNULL)
        return json.loads(target.read_text())


def curves(motion):
    """Degrees of the left leg for each frame, and how high its sole is at its lower end, m, but for a constant."""
    first = {joint["name"]: joint["first_coord"] for joint in motion["joints"]}
    out = {name: [] for name in ANGLES}
    low_m = []
    for frame in motion["frames"]:
        coords = frame["coords"]
        lean = 2.0 * math.atan2(frame["root"][4], frame["root"][3])  # the pelvis leans forward in runs
        thigh = coords[first["leg_left/hip_flex"]] - lean
        shank = thigh - coords[first["leg_left/knee"]]
        foot = shank + coords[first["foot_left/ankle_flex"]]
        ankle_m = frame["root"][1] - THIGH_M * math.cos(thigh) - SHANK_M * math.cos(shank)
        low_m.append(ankle_m + min(z * math.sin(foot) - ANKLE_M * math.cos(foot) for z in (HEEL_M, TOE_M)))
        for name, angle in zip(ANGLES, (thigh, thigh - shank, foot - shank)):
            out[name].append(math.degrees(angle))
    return out, low_m


def strikes(low_m):
    """Frames in which the sole comes down."""
    ground_m = min(low_m) + 0.001
    return [n for n in range(1, len(low_m)) if low_m[n] <= ground_m < low_m[n - 1]]


def path(points, style):
    return f'<polyline points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in points)}" {style}/>'


def panel(x0, y0, ours, people, strike_phase):
    low, high = -50.0, 120.0
    def at(phase, degrees):
        return x0 + phase * PANEL_W, y0 + PANEL_H * (high - degrees) / (high - low)
    lines = [f'<rect x="{x0}" y="{y0}" width="{PANEL_W}" height="{PANEL_H}" fill="#fff" stroke="#bbb"/>']
    for degrees in (-30, 0, 30, 60, 90):
        y = at(0, degrees)[1]
        lines.append(f'<line x1="{x0}" x2="{x0 + PANEL_W}" y1="{y:.1f}" y2="{y:.1f}" stroke="#eee"/>'
                     f'<text x="{x0 - 6}" y="{y + 3:.1f}" text-anchor="end">{degrees}</text>')
    lines.append(path([at(n / (len(ours) - 1), a) for n, a in enumerate(ours)],
                      'fill="none" stroke="#0a6ebd" stroke-width="2"'))
    for n, degrees in enumerate(people):
        x, y = at((n / len(people) + 1.0 - strike_phase) % 1.0, degrees)
        lines.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="#d1495b"/>')
    return "\n".join(lines)


def main(contort, folder):
    gaits = json.loads(Path(folder, "people.json").read_text())["gaits"]
    width, height = LEFT + 3 * (PANEL_W + GAP), TOP + len(gaits) * (PANEL_H + GAP)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" '
           f'font-size="11"><rect width="{width}" height="{height}" fill="#fafafa"/>']
    for column, name in enumerate(ANGLES):
        out.append(f'<text x="{LEFT + column * (PANEL_W + GAP) + PANEL_W / 2}" y="30" text-anchor="middle" '
                   f'font-size="14">{name}, degrees over a cycle</text>')
    for row, gait in enumerate(gaits):
        angles, low_m = curves(generated(contort, gait))
        found = strikes(low_m)
        first, last = found[len(found) // 2], found[len(found) // 2 + 1]
        y0 = TOP + row * (PANEL_H + GAP)
        out.append(f'<text x="10" y="{y0 + 20}" font-size="13">{gait["name"]}</text>'
                   f'<text x="10" y="{y0 + 38}">{gait["speed_m_s"]} m/s</text>')
        for column, name in enumerate(ANGLES):
            out.append(panel(LEFT + column * (PANEL_W + GAP), y0, angles[name][first:last + 1], gait[name + "_deg"],
                             gait["strike_phase"]))
    out.append("</svg>\n")
    Path(folder, "figure.svg").write_text("\n".join(out))


if __name__ == "__main__":
    main(*sys.argv[1:])
