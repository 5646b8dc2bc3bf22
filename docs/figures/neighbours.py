#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws docs/images/neighbours.svg from the measurement of tests/engine/footprint_size_test.cpp:

    build/release/bin/test_engine "[.neighbours]" | docs/figures/neighbours.py > docs/images/neighbours.svg
"""
import math
import sys

WIDTH, HEIGHT, LEFT, BOTTOM, TOP, RIGHT = 640, 360, 60, 60, 40, 20
COLOURS = ["#1f6f8b", "#c1440e"]


def main():
    series = {}
    for line in sys.stdin:
        if line.startswith("neighbours;"):
            _, name, count, ratio = line.strip().split(";")
            series.setdefault(name, []).append((int(count), float(ratio)))
    counts = sorted({c for points in series.values() for c, _ in points})
    low, high = math.log2(counts[0]) - 0.5, math.log2(counts[-1]) + 0.5

    def x(count):
        return LEFT + (math.log2(count) - low) / (high - low) * (WIDTH - LEFT - RIGHT)

    def y(ratio):
        return HEIGHT - BOTTOM - ratio * (HEIGHT - BOTTOM - TOP)

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
           f'font-family="sans-serif" font-size="13">',
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
           f'<text x="{LEFT}" y="22">Way to the neighbouring sample / size of the footprint '
           f'(median)</text>']
    for tick in (0, 0.25, 0.5, 0.75, 1):
        out.append(f'<line x1="{LEFT}" x2="{WIDTH - RIGHT}" y1="{y(tick)}" y2="{y(tick)}" '
                   f'stroke="#ccc"/><text x="{LEFT - 8}" y="{y(tick) + 4}" '
                   f'text-anchor="end">{tick}</text>')
    for count in counts:
        out.append(f'<text x="{x(count)}" y="{HEIGHT - BOTTOM + 20}" '
                   f'text-anchor="middle">{count}</text>')
    out.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 16}" text-anchor="middle">'
               f'samples of the lobe (four times as many paths for two bounces)</text>')
    for colour, (name, points) in zip(COLOURS, series.items()):
        line = " ".join(f"{x(c):.1f},{y(r):.1f}" for c, r in sorted(points))
        out.append(f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="2"/>')
        out += [f'<circle cx="{x(c):.1f}" cy="{y(r):.1f}" r="4" fill="{colour}"/>'
                for c, r in points]
        out.append(f'<text x="{x(counts[0]):.1f}" y="{y(sorted(points)[0][1]) - 10:.1f}" '
                   f'fill="{colour}">{name}</text>')
    out.append("</svg>")
    print("\n".join(out))


if __name__ == "__main__":
    main()
