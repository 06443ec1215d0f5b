"""Draws the plate of plate.py as an SVG."""

import plate

MARGIN, CHORD_ERROR = 3, 0.02  # mm

SHAPES = [("#d5dae0", [plate.rim()]),
          ("#aab4c0", [plate.gear(), plate.engine_housing()]),
          ("#aab4c0", [plate.circle(hole, plate.COUNTERBORE_RADIUS) for hole in plate.HOLES]),
          ("#d5dae0", [plate.circle(plate.GEAR_CENTRE, plate.HUB_RADIUS), plate.rotor()]),
          ("white", [plate.circle(hole, plate.HOLE_RADIUS) for hole in plate.HOLES]),
          ("white", [plate.circle(centre, plate.SHAFT_RADIUS) for centre in (plate.GEAR_CENTRE, plate.ENGINE_CENTRE)]),
          ("white", plate.slots()),
          ("none", plate.rosette() + plate.lettering() + plate.speed_curve())]


def outline(wire):
    """An SVG path; SVG's Y axis points down."""
    points = wire.discretize(Deflection=CHORD_ERROR)
    return "M" + " ".join(f"{point.x:.2f},{plate.WIDTH - point.y:.2f}" for point in points)


def draw(filename):
    width, height = plate.LENGTH + 2 * MARGIN, plate.WIDTH + 2 * MARGIN
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{6 * width:g}" height="{6 * height:g}" '
             f'viewBox="{-MARGIN} {-MARGIN} {width:g} {height:g}" stroke="#26323f" stroke-width="0.2">']
    lines += [f'<path fill="{fill}" d="{outline(wire)}"/>' for fill, wires in SHAPES for wire in wires]
    with open(filename, "w", encoding="utf-8") as file:
        file.write("\n".join(lines + ["</svg>", ""]))
