#!/usr/bin/python3
"""Draws the diagrams of docs/how-it-works.md and docs/paper.md into docs/images. Colours are legible on light and on dark."""
import math
from pathlib import Path

INK, FAINT, BLUE, RED, GREEN = "#7a7a7a", "#a0a0a0", "#3b82c4", "#d9534f", "#3a9a5c"
HERE = Path(__file__).resolve().parents[1] / "images"


class Drawing:
    def __init__(self, width, height):
        self.width, self.height, self.parts = width, height, []

    def line(self, x1, y1, x2, y2, color=INK, width=1.5, dash="", arrow=False):
        more = f' stroke-dasharray="{dash}"' if dash else ""
        more += f' marker-end="url(#{color[1:]})"' if arrow else ""
        self.parts.append(f'<path d="M{x1:g} {y1:g}L{x2:g} {y2:g}" stroke="{color}" stroke-width="{width}"{more}/>')

    def dot(self, x, y, color=INK, r=4, hollow=False):
        fill = f'fill="none" stroke="{color}" stroke-width="1.5"' if hollow else f'fill="{color}"'
        self.parts.append(f'<circle cx="{x:g}" cy="{y:g}" r="{r}" {fill}/>')

    def box(self, x, y, w, h, color=INK, fill="none", opacity=1):
        self.parts.append(f'<rect x="{x:g}" y="{y:g}" width="{w:g}" height="{h:g}" rx="4" stroke="{color}" fill="{fill}" fill-opacity="{opacity}"/>')

    def text(self, x, y, words, color=INK, anchor="middle", size=13, weight="normal"):
        self.parts.append(f'<text x="{x:g}" y="{y:g}" fill="{color}" text-anchor="{anchor}" font-size="{size}" font-weight="{weight}">{words}</text>')

    def sensor(self, x, y):
        self.box(x - 7, y - 7, 14, 14, INK, INK)

    def write(self, name, title):
        heads = "".join(f'<marker id="{c[1:]}" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="6" markerHeight="6" orient="auto"><path d="M0 0L8 4L0 8z" fill="{c}"/></marker>'
                        for c in (INK, FAINT, BLUE, RED, GREEN))
        body = "\n".join(self.parts)
        (HERE / name).write_text(
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {self.width} {self.height}" width="{self.width}" height="{self.height}" '
            f'font-family="sans-serif" fill="none" role="img">\n<title>{title}</title>\n<defs>{heads}</defs>\n{body}\n</svg>\n')


def problem():
    d = Drawing(680, 190)
    for panel, label in enumerate(["scan 1", "scan 2", "scan 3", "all scans in one map"]):
        x = 85 + 170 * panel
        d.line(x - 70, 30, x + 70, 30, BLUE, 4)
        d.sensor(x, 140)
        for step in (range(3) if panel == 3 else [panel]):
            px = x - 42 + 42 * step
            d.dot(px, 82, RED, 9)
            if panel < 3:
                d.line(x, 132, px + (x - px) * 0.18, 93, FAINT, 1)
        if panel < 3:
            for end in (-60, -20, 20, 60):
                if abs(end * 0.54 - (-42 + 42 * panel)) > 14:
                    d.line(x, 132, x + end, 34, FAINT, 1)
        d.text(x, 178, label)
        if panel < 3:
            d.line(x + 85, 20, x + 85, 150, FAINT, 1, "3 4")
    d.write("how-problem.svg", "Three scans of one person who walks, and the map with three persons")


def sight():
    d = Drawing(680, 210)
    d.sensor(40, 110)
    d.line(560, 20, 560, 190, BLUE, 4)
    d.text(600, 115, "wall", BLUE, "start")
    for y in (45, 110, 175):
        d.line(50, 110, 552, y, FAINT, 1.2, arrow=True)
    d.line(50, 110, 300, 205, FAINT, 1.2, "4 4")
    d.text(318, 203, "nothing came back: unknown", INK, "start", 12)
    d.dot(300, 77.5, GREEN, 6)
    d.text(300, 62, "free: a beam went through", GREEN)
    d.dot(556, 110, BLUE, 6)
    d.text(545, 98, "occupied: it ended here", BLUE, "end")
    d.dot(620, 45, INK, 6, hollow=True)
    d.text(620, 32, "behind: unknown", INK)
    d.text(40, 140, "sensor")
    d.write("how-sight.svg", "What one scan says about three places: free, occupied, unknown")


def lines():
    d = Drawing(680, 200)
    d.sensor(50, 50)
    ground = 160
    d.line(20, ground + 3, 660, ground + 3, FAINT, 1)
    hits = [210, 330, 570]
    for x in hits:
        d.line(58, 52, x, ground, FAINT, 1.2)
        d.dot(x, ground, BLUE, 5)
    d.line(hits[1], ground, hits[2], ground, BLUE, 2.5)
    d.dot(450, ground, BLUE, 7, hollow=True)
    d.text(450, 186, "on the line: the surface goes through it", BLUE)
    d.dot(450, 122, GREEN, 6)
    d.text(462, 118, "before the line: free", GREEN, "start")
    d.text(210, 186, "returns of three rings", INK)
    d.text(300, 30, "by its pixel alone the place would be free:", INK, "start", 12)
    d.text(300, 46, "the upper beam went farther", INK, "start", 12)
    d.line(400, 54, 446, 150, INK, 1, "3 3", True)
    d.write("how-lines.svg", "Ground between two rings lies on the line between their returns")


def dynamic_score(passed, seen, switches, owned):
    """As evidence.cpp has it."""
    f, e = passed + 2, 0.45 * (1 + switches) ** 0.9 * (max(seen, 1) * max(owned, 1) ** 2) ** 0.2 + 2
    return (f * f - e * e) / (f * f + e * e)


def evidence():
    d = Drawing(680, 180)
    rows = [("leaf", "oopoopopooopoopo", 10), ("person walks by", "ppppppppooopppppp"[:16], 3)]
    for row, (name, looks, owned) in enumerate(rows):
        y = 30 + 70 * row
        d.text(130, y + 17, name, INK, "end", weight="bold")
        for i, look in enumerate(looks):
            color = BLUE if look == "o" else GREEN
            d.box(145 + 21 * i, y, 17, 24, color, color, 0.85 if look == "o" else 0.15)
        seen, passed = looks.count("o"), looks.count("p")
        switches = sum(a != b for a, b in zip(looks, looks[1:]))
        value = dynamic_score(passed, seen, switches, owned)
        d.text(492, y + 9, f"n_occ {seen}, n_free {passed}, switches {switches}", INK, "start", 11)
        d.text(492, y + 26, f"score {value:+.2f}: {'dynamic' if value > 0 else 'static'}", RED if value > 0 else BLUE, "start", 12, "bold")
    d.line(145, 160, 478, 160, INK, 1, arrow=True)
    d.text(320, 176, "keyframes, in time", INK, size=12)
    d.box(20, 150, 12, 12, BLUE, BLUE, 0.85)
    d.text(38, 161, "occupied", INK, "start", 12)
    d.box(20, 166, 12, 12, GREEN, GREEN, 0.15)
    d.text(38, 177, "free", INK, "start", 12)
    d.write("how-evidence.svg", "A leaf is seen through in many short runs, the place where somebody walked by in few long ones")


def presets():
    d = Drawing(680, 330)
    columns = [(20, "default: scans observe", BLUE, [
        "each scan is an image of its own beams", "a keyframe checks all known voxels,", "counts per voxel: occupied, free, switches",
        "neighbours vote; instant verdict", "feet on the ground; final verdict"], "new voxels ask earlier keyframes"),
               (350, "paper: submaps observe", RED, [
        "windows of keyframes, range images", "remove what was seen through; revert by PCA", "static submaps, thinned",
        "visibility boundaries around a pose", "n_occ / n_check; the nearest pose decides"], None)]
    for x, title, color, steps, second in columns:
        d.text(x + 155, 22, title, color, size=15, weight="bold")
        for i, step in enumerate(steps):
            y = 38 + 58 * i
            d.box(x, y, 310, 40, color)
            if second and i == 1:
                d.text(x + 155, y + 17, step)
                d.text(x + 155, y + 33, second)
            else:
                d.text(x + 155, y + 25, step)
            if i < 4:
                d.line(x + 155, y + 41, x + 155, y + 57, color, 1.5, arrow=True)
    d.write("how-presets.svg", "The steps of the two presets")


def removal():
    d = Drawing(680, 140)
    d.sensor(40, 70)
    d.line(50, 70, 596, 70, FAINT, 1.5, arrow=True)
    d.line(604, 30, 604, 110, BLUE, 4)
    d.text(604, 128, "I: range of the keyframe's pixel", BLUE, "end")
    d.dot(300, 70, RED, 6)
    d.text(300, 56, "point of another scan, at range r", RED)
    d.box(300, 84, 90, 8, INK, FAINT, 0.5)
    d.text(345, 110, "margin τ + τ' r", INK)
    d.write("how-removal.svg", "A point is dynamic if a keyframe saw farther by more than the margin")


def reverting():
    d = Drawing(680, 190)
    for left, height, color, label in ((90, 8, BLUE, "the normal stays: reverted to static"), (430, 70, RED, "the normal turns: stays dynamic")):
        points = [(left + 40 * i, 140 + (3, -3, 2, -2)[i]) for i in range(4)]
        for x, y in points:
            d.dot(x, y, INK, 5)
        new = (left + 145, 140 - height)
        d.dot(*new, color, 6)
        for group, c in ((points, INK), (points + [new], color)):
            mx, my = (sum(p[k] for p in group) / len(group) for k in (0, 1))
            xx, xy, yy = (sum((p[a] - (mx, my)[a]) * (p[b] - (mx, my)[b]) for p in group) for a, b in ((0, 0), (0, 1), (1, 1)))
            angle = 0.5 * math.atan2(2 * xy, xx - yy)
            d.line(left + 60, 140, left + 60 + 80 * math.sin(angle), 140 - 80 * math.cos(angle), c, 2, "" if c != INK else "4 3", True)
        d.text(left + 70, 178, label, color)
    d.write("how-reverting.svg", "Principal axes of the neighbours, without (dashed) and with the point")


def occupancy():
    d = Drawing(680, 240)
    rows = [("A", [6], 6), ("B", [3, 6], 6), ("C", [6], 6), ("D", [3, 4], 4)]
    x0, w = 150, 62
    for c in range(1, 7):
        d.text(x0 + w * (c - 0.5), 20, f"cell {c}")
    for i, (name, cells, bound) in enumerate(rows):
        y = 30 + 36 * i
        d.text(x0 - 15, y + 19, f"submap {name}", INK, "end")
        for c in range(1, 7):
            d.box(x0 + w * (c - 1), y, w - 4, 28, FAINT, GREEN if c < bound and c not in cells else "none", 0.15)
            if c in cells:
                d.dot(x0 + w * (c - 0.5) - 2, y + 14, BLUE, 6)
        d.line(x0 + w * bound - 3, y - 3, x0 + w * bound - 3, y + 31, RED, 3)
    d.text(540, 50, "red: visibility boundary", RED, "start", 11)
    for c in range(1, 7):
        occ = sum(c in cells for _, cells, _ in rows)
        check = sum(bound >= c for _, _, bound in rows)
        if occ:
            good = occ / check >= 0.35
            d.text(x0 + w * (c - 0.5) - 2, 200, f"{occ}/{check}", BLUE if good else RED, size=15, weight="bold")
            d.text(x0 + w * (c - 0.5) - 2, 218, "static" if good else "dynamic", BLUE if good else RED, size=12)
        else:
            d.text(x0 + w * (c - 0.5) - 2, 200, "-")
    d.text(x0 - 15, 200, "n_occ / n_check", INK, "end")
    d.write("how-occupancy.svg", "One pixel seen by four submaps: cells, points, boundaries, and occupancy")


if __name__ == "__main__":
    for draw in (problem, sight, lines, evidence, presets, removal, reverting, occupancy):
        draw()
