"""Line charts as SVG."""
WIDTH, HEIGHT, LEFT, BOTTOM, TOP, RIGHT = 760, 380, 56, 44, 16, 190
GREY = "#888888"


def line_chart(x_label, y_label, y_range, series, marks=(), x_names=()):
    """`series`: (name, color, dashed, points); `marks`: vertical lines as (x, text); `x_names`: of x = 0, 1, 2... in place of numbers."""
    x_end = len(x_names) - 1 if x_names else max(x for *_, points in series for x, _ in points)
    low, high = y_range

    def at(x, y):
        return (LEFT + x / x_end * (WIDTH - LEFT - RIGHT), HEIGHT - BOTTOM - (y - low) / (high - low) * (HEIGHT - BOTTOM - TOP))

    def text(x, y, words, anchor="middle", color="#222222"):
        return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{color}">{words}</text>'

    def line(points, color, width=1.0, dashes=""):
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        return f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="{width}" stroke-dasharray="{dashes}"/>'

    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="13">',
             f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>']
    for y in ticks(low, high):
        parts += [line([at(0, y), at(x_end, y)], "#dddddd"), text(LEFT - 8, at(0, y)[1] + 4, f"{y:g}", "end")]
    x_ticks = enumerate(x_names) if x_names else ((x, f"{x:g}") for x in ticks(0, x_end))
    parts += [text(at(x, low)[0], HEIGHT - BOTTOM + 18, name) for x, name in x_ticks]
    for x, words in marks:
        parts += [line([at(x, low), at(x, high)], GREY, 1, "2 3"), text(at(x, low)[0] + 6, at(x, low)[1] - 8, words, "start", GREY)]
    for i, (name, color, dashed, points) in enumerate(series):
        dashes = "6 4" if dashed else ""
        y = TOP + 14 + 20 * i
        parts += [line([at(*p) for p in points], color, 2, dashes), text(WIDTH - RIGHT + 48, y + 4, name, "start"),
                  line([(WIDTH - RIGHT + 14, y), (WIDTH - RIGHT + 42, y)], color, 2, dashes)]
    parts += [text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 8, x_label), f'<g transform="rotate(-90)">{text(-HEIGHT / 2, 16, y_label)}</g>']
    return "\n".join(parts) + "\n</svg>\n"


def ticks(low, high):
    """About six round numbers."""
    step = next(s for s in (1, 2, 5, 10, 20, 50, 100, 200) if (high - low) / s <= 7)
    return range(-(-int(low) // step) * step, int(high) + 1, step)
