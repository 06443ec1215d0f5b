"""The demo part: an aluminium plate, 120 x 80 x 8 mm, drawn with FreeCAD.

From left to right: a pocket in the shape of a gear wheel around a hub, an engraved rosette between two arc slots, and a
pocket in the shape of a rotary engine's housing around its rotor. The rim is a wave of tangent arcs; four counterbored
holes and two straight slots fasten the plate. Together they hold what a motion planner has to cope with: long straight
lines, arcs small and large, sharp corners, involutes and other free curves that CAM breaks into short chords.

The origin is the lower left corner of the plate's bounding box, Z0 its upper face; all lengths are in mm.
"""

from math import acos, asin, cos, pi, radians, sin, tan

import Part
from FreeCAD import Vector

LENGTH, WIDTH, THICKNESS = 120.0, 80.0, 8.0

CORNER_RADIUS = 12.0
HOLES = [Vector(x, y, 0) for x in (12, 108) for y in (12, 68)]
HOLE_RADIUS, COUNTERBORE_RADIUS, COUNTERBORE_DEPTH = 3.3, 5.5, 3.0

GEAR_CENTRE, GEAR_DEPTH, HUB_RADIUS = Vector(21, 40, 0), 3.0, 5.0
ENGINE_CENTRE, ENGINE_DEPTH = Vector(99, 40, 0), 4.0
ROSETTE_CENTRE = Vector(60, 40, 0)
SHAFT_RADIUS = 3.5  # the through hole in the hub and the one in the rotor


def polar(centre, radius, angle):
    return centre + Vector(radius * cos(angle), radius * sin(angle), 0)


def arc(centre, radius, start, end):
    """An arc from angle start to angle end, in radians; clockwise where end is the smaller one."""
    through = (polar(centre, radius, angle) for angle in (start, (start + end) / 2, end))
    return Part.Arc(*through).toShape()


def circle(centre, radius):
    return Part.Wire(Part.makeCircle(radius, centre))


def smooth_curve(points, closed=False):
    """A spline through the points: a free curve, which CAM has to break into chords."""
    curve = Part.BSplineCurve()
    curve.interpolate(points, PeriodicFlag=closed)
    return curve.toShape()


def wavy_edge(start, direction, length, waves):
    """Tangent arcs along a straight edge, turned outwards at both ends: they leave and arrive along the edge."""
    outward_radius, inward_radius = 5.0, 5.0
    pitch = length / waves
    between_centres = outward_radius + inward_radius
    half_angle = asin(pitch / 2 / between_centres)
    inward = direction + pi / 2

    def centre(along, depth):
        return polar(polar(start, along, direction), depth, inward)

    edges = []
    for wave in range(waves + 1):
        outermost = direction - pi / 2
        first = outermost - (half_angle if wave > 0 else 0)
        last = outermost + (half_angle if wave < waves else 0)
        edges.append(arc(centre(wave * pitch, outward_radius), outward_radius, first, last))
        if wave < waves:
            depth = outward_radius - between_centres * cos(half_angle)
            valley = centre((wave + 0.5) * pitch, depth)
            edges.append(arc(valley, inward_radius, inward + half_angle, inward - half_angle))
    return edges


def rim():
    """The outer contour, counterclockwise: a wave along each side, a quarter circle around each hole."""
    corner = CORNER_RADIUS
    sides = [(Vector(corner, 0, 0), 0, LENGTH - 2 * corner, 8, Vector(LENGTH - corner, corner, 0)),
             (Vector(LENGTH, corner, 0), pi / 2, WIDTH - 2 * corner, 5, Vector(LENGTH - corner, WIDTH - corner, 0)),
             (Vector(LENGTH - corner, WIDTH, 0), pi, LENGTH - 2 * corner, 8, Vector(corner, WIDTH - corner, 0)),
             (Vector(0, WIDTH - corner, 0), 3 * pi / 2, WIDTH - 2 * corner, 5, Vector(corner, corner, 0))]
    edges = []
    for start, direction, length, waves, corner_centre in sides:
        edges += wavy_edge(start, direction, length, waves)
        edges.append(arc(corner_centre, corner, direction - pi / 2, direction))
    return Part.Wire(edges)


def gear():
    """A gear wheel with nine involute teeth, wide enough at their tips for the 3 mm cutter."""
    teeth, pitch_radius, root_radius, tip_radius, pressure_angle = 9, 13.6, 10.5, 16.0, radians(20)
    base_radius = pitch_radius * cos(pressure_angle)

    def involute_angle(radius):
        unrolled = acos(base_radius / radius)
        return tan(unrolled) - unrolled

    half_tooth = pi / (2 * teeth) + 0.04 + involute_angle(pitch_radius)  # at the base circle; 0.04 rad widens the tooth
    radii = [base_radius + (tip_radius - base_radius) * (step / 8) ** 2 for step in range(9)]
    edges = []
    for tooth in range(teeth):
        middle = 2 * pi * tooth / teeth
        flank = [(radius, half_tooth - involute_angle(radius)) for radius in radii]
        rising = [polar(GEAR_CENTRE, radius, middle - angle) for radius, angle in flank]
        falling = [polar(GEAR_CENTRE, radius, middle + angle) for radius, angle in reversed(flank)]
        half_tip = flank[-1][1]
        root_end = 2 * pi * (tooth + 1) / teeth - half_tooth
        edges += [Part.makeLine(polar(GEAR_CENTRE, root_radius, middle - half_tooth), rising[0]),
                  smooth_curve(rising),
                  arc(GEAR_CENTRE, tip_radius, middle - half_tip, middle + half_tip),
                  smooth_curve(falling),
                  Part.makeLine(falling[-1], polar(GEAR_CENTRE, root_radius, middle + half_tooth)),
                  arc(GEAR_CENTRE, root_radius, middle + half_tooth, root_end)]
    return Part.Wire(edges)


def engine_housing():
    """The epitrochoid that a rotary engine's rotor runs in, upright."""
    radius, eccentricity, steps = 18.0, 2.3, 96
    points = []
    for step in range(steps):
        angle = 2 * pi * step / steps
        across = radius * sin(angle) + eccentricity * sin(3 * angle)
        points.append(ENGINE_CENTRE + Vector(-across, radius * cos(angle) + eccentricity * cos(3 * angle), 0))
    return Part.Wire(smooth_curve(points, closed=True))


def rotor():
    """Three bulging flanks that meet in rounded tips, all arcs tangent to each other."""
    tip_reach, tip_radius, flank_radius = 10.6, 1.6, 22.0
    tip_angles = [radians(20) + 2 * pi * tip / 3 for tip in range(3)]
    tip_centres = [polar(ENGINE_CENTRE, tip_reach - tip_radius, angle) for angle in tip_angles]
    half_distance = (tip_centres[1] - tip_centres[0]).Length / 2
    # Each flank touches two tip circles from outside around them, so its own centre lies far behind the rotor's.
    half_flank = asin(half_distance / (flank_radius - tip_radius))
    half_tip = pi / 3 - half_flank
    edges = []
    for tip, angle in enumerate(tip_angles):
        outward = angle + pi / 3
        middle = (tip_centres[tip] + tip_centres[(tip + 1) % 3]) / 2
        flank_centre = polar(middle, (tip_radius - flank_radius) * cos(half_flank), outward)
        edges += [arc(tip_centres[tip], tip_radius, angle - half_tip, angle + half_tip),
                  arc(flank_centre, flank_radius, outward - half_flank, outward + half_flank)]
    return Part.Wire(edges)


def straight_slot(first, last, half_width):
    """A slot along X with round ends."""
    up, down = Vector(0, half_width, 0), Vector(0, -half_width, 0)
    return Part.Wire([Part.makeLine(first + down, last + down), arc(last, half_width, -pi / 2, pi / 2),
                      Part.makeLine(last + up, first + up), arc(first, half_width, pi / 2, 3 * pi / 2)])


def arc_slot(direction):
    """A slot with round ends along a circle around the rosette."""
    radius, half_width, half_angle = 26.5, 2.5, radians(34)
    start, end = direction - half_angle, direction + half_angle
    return Part.Wire([arc(ROSETTE_CENTRE, radius + half_width, start, end),
                      arc(polar(ROSETTE_CENTRE, radius, end), half_width, end, end + pi),
                      arc(ROSETTE_CENTRE, radius - half_width, end, start),
                      arc(polar(ROSETTE_CENTRE, radius, start), half_width, start + pi, start + 2 * pi)])


def slots():
    return [arc_slot(pi / 2), arc_slot(-pi / 2), straight_slot(Vector(26, 10.5, 0), Vector(40, 10.5, 0), 2.5),
            straight_slot(Vector(80, 10.5, 0), Vector(94, 10.5, 0), 2.5)]


def prism(outline, depth, island=None):
    """The material under an outline (less an island) from Z0 down to a depth."""
    outlines = [outline, island] if island else [outline]
    return Part.makeFace(outlines, "Part::FaceMakerBullseye").extrude(Vector(0, 0, -depth))


def plate():
    """The finished part as a solid, without its engravings."""
    through = [prism(circle(hole, HOLE_RADIUS), THICKNESS) for hole in HOLES]
    through += [prism(circle(centre, SHAFT_RADIUS), THICKNESS) for centre in (GEAR_CENTRE, ENGINE_CENTRE)]
    through += [prism(slot, THICKNESS) for slot in slots()]
    blind = [prism(circle(hole, COUNTERBORE_RADIUS), COUNTERBORE_DEPTH) for hole in HOLES]
    blind += [prism(gear(), GEAR_DEPTH, circle(GEAR_CENTRE, HUB_RADIUS)),
              prism(engine_housing(), ENGINE_DEPTH, rotor())]
    return prism(rim(), THICKNESS).cut(through + blind).Solids[0]


def rosette():
    """Rings and two waves around the centre, each of which closes only after several turns."""

    def wave(inner, outer, lobes, turns):
        steps = 24 * lobes
        middle, swing = (inner + outer) / 2, (outer - inner) / 2
        angles = [2 * pi * turns * step / steps for step in range(steps)]
        points = [polar(ROSETTE_CENTRE, middle + swing * cos(angle * lobes / turns), angle) for angle in angles]
        return Part.Wire(smooth_curve(points, closed=True))

    return [circle(ROSETTE_CENTRE, 19.5), wave(8.0, 19.0, 37, 5), circle(ROSETTE_CENTRE, 7.5), wave(1.5, 7.0, 16, 3)]


def lettering():
    """The letters KCS in single strokes, left of the upper arc slot."""
    base, height, radius = Vector(20.5, 62.5, 0), 9.0, 2.25

    def at(x, y):
        return base + Vector(x, y, 0)

    k = [[Part.makeLine(at(0, 0), at(0, height))],
         [Part.makeLine(at(5, height), at(0, 3.6))],
         [Part.makeLine(at(1.6, 5.3), at(5, 0))]]
    c_top, c_bottom = at(10.2, height - 2.9), at(10.2, 2.9)
    c = [[arc(c_top, 2.9, radians(20), pi), Part.makeLine(at(7.3, height - 2.9), at(7.3, 2.9)),
          arc(c_bottom, 2.9, pi, radians(340))]]
    s_top, s_bottom = at(17.8, height - radius), at(17.8, radius)
    s = [[arc(s_top, radius, radians(20), 3 * pi / 2), arc(s_bottom, radius, pi / 2, -radians(160))]]
    return [Part.Wire(stroke) for stroke in k + c + s]


def speed_curve():
    """A stop-to-stop move at limited jerk, drawn as speed over time, right of the upper arc slot."""
    base, length, height, points = Vector(79.5, 64.5, 0), 19.0, 7.5, 33

    def speed(share):
        """Rises in the first 0.4 of the time and falls in the last: two parabolas each way."""
        rise = min(share, 1 - share, 0.4) / 0.4
        return 2 * rise**2 if rise < 0.5 else 1 - 2 * (1 - rise) ** 2

    shares = [step / (points - 1) for step in range(points)]
    curve = smooth_curve([base + Vector(length * share, height * speed(share), 0) for share in shares])
    axis = Part.makeLine(base + Vector(0, -1.5, 0), base + Vector(length, -1.5, 0))
    return [Part.Wire(curve), Part.Wire(axis)]
