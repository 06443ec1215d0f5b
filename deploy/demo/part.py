"""Makes part.ngc, the demo's program, from the plate in plate.py. To run it: freecadcmd part.py

What a machinist would set by hand in FreeCAD's Path workbench is set here: stock, tools, feeds, depths and the order of
the operations. FreeCAD's post-processor for LinuxCNC writes the program, the same bytes each time.
"""

import ctypes
import os
import sys

import FreeCAD
import Part
from FreeCAD import Vector
from PathScripts import PathJob, PathStock, PathToolBit, PathToolController
from PathScripts.PathAdaptive import PathAdaptive
from PathScripts.PathDressupRampEntry import ObjectDressup
from PathScripts.PathEngrave import ObjectEngrave
from PathScripts.PathHelix import ObjectHelix
from PathScripts.PathProfile import ObjectProfile
from PathScripts.post import linuxcnc_post

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, FOLDER)
import picture
import plate

THROUGH = plate.THICKNESS + 0.2  # a little into the board below
SKIN = 0.2  # left below the rim, so that the part stays where it is until it is snapped out
ABOVE = 0.5  # where helices begin, counted from the surface they enter


class Workshop:
    """The plate in its stock, the tools, and the operations so far in the order in which they are cut."""

    def __init__(self):
        self.document = FreeCAD.newDocument("part")
        blank = self.document.addObject("Part::Feature", "Plate")
        blank.Shape = plate.plate()
        self.job = PathJob.Create("Job", [blank], None)
        self.job.GeometryTolerance = 0.005
        self.model = self.job.Model.Group[0]
        margin = Vector(6, 6, 0)
        self.job.Stock = PathStock.CreateFromBase(self.job, margin, margin)
        for default in self.job.Tools.Group:
            self.document.removeObject(default.Name)
        self.program = []

    def change_tool(self, number, label, shape, diameter, speed, feed, plunge):
        """Takes a tool from FreeCAD's library; spindle speed in 1/min, feed and plunge feed in mm/min."""
        library = os.path.join(os.path.dirname(os.path.dirname(PathToolBit.__file__)), "Tools", "Bit")
        bit = PathToolBit.Factory.CreateFrom(os.path.join(library, shape + ".fctb"))
        bit.Diameter = diameter
        self.tool = PathToolController.Create(label, bit, number)
        self.tool.SpindleSpeed = speed
        self.tool.HorizFeed = f"{feed} mm/min"
        self.tool.VertFeed = f"{plunge} mm/min"
        self.job.Proxy.addToolController(self.tool)
        self.program.append(self.tool)

    def cut(self, kind, label, top, bottom, base=None, sinking=False, **settings):
        """Adds an operation between two depths below Z0; sinking, it goes down along its path instead of plunging."""
        operation = self.document.addObject("Path::FeaturePython", kind.__name__)
        operation.Proxy = kind(operation, kind.__name__, self.job)
        operation.ToolController = self.tool
        if base:
            operation.Base = base
        for name, value in {"StartDepth": -top, "FinalDepth": -bottom, **settings}.items():
            operation.setExpression(name, None)
            setattr(operation, name, value)
        # Adaptive clearing tries angles drawn with C's rand(): without a seed of our own, others in each run.
        ctypes.CDLL(None).srand(1)
        self.document.recompute()
        step = self.sunk(operation) if sinking else operation
        step.Label = label
        self.program.append(step)

    def sunk(self, operation):
        # FreeCAD recognises what wraps an operation by the word Dressup in its name.
        wrapped = self.document.addObject("Path::FeaturePython", "RampEntryDressup")
        dressup = ObjectDressup(wrapped)
        wrapped.Base = operation
        self.job.Proxy.addOperation(wrapped, operation)
        dressup.setup(wrapped)
        wrapped.Method = "Helix"
        wrapped.UseStartDepth = True
        self.document.recompute()
        return wrapped

    def floor(self, centre, depth):
        """The pocket floor with this centre, as the base of an operation."""
        wanted = centre - Vector(0, 0, depth)
        faces = enumerate(self.model.Shape.Faces, start=1)
        names = [f"Face{number}" for number, face in faces
                 if isinstance(face.Surface, Part.Plane) and face.CenterOfMass.isEqual(wanted, 0.01)]
        return [(self.model, tuple(names))]

    def edges(self, *outlines):
        """The model's edges along these outlines, as the base of an operation."""
        along = Part.Compound(outlines)
        names = []
        for number, edge in enumerate(self.model.Shape.Edges, start=1):
            middle = Part.Vertex(edge.valueAt((edge.FirstParameter + edge.LastParameter) / 2))
            if along.distToShape(middle)[0] < 1e-3:
                names.append(f"Edge{number}")
        return [(self.model, tuple(names))]

    def strokes(self, wires):
        """A drawing to be engraved, as the shapes of an operation."""
        drawing = self.document.addObject("Part::Feature", "Drawing")
        drawing.Shape = Part.Compound(wires)
        return [drawing]


def make_part(shop):
    shop.change_tool(1, "V-bit 60 degrees", "60degree_Vbit", 6, speed=18000, feed=720, plunge=240)
    shop.cut(ObjectEngrave, "Letters", 0, 0.4, BaseShapes=shop.strokes(plate.lettering()))
    shop.cut(ObjectEngrave, "Speed curve", 0, 0.4, BaseShapes=shop.strokes(plate.speed_curve()))
    shop.cut(ObjectEngrave, "Rosette", 0, 0.15, BaseShapes=shop.strokes(plate.rosette()))

    shop.change_tool(2, "End mill 3 mm", "5mm_Endmill", 3, speed=18000, feed=1080, plunge=300)
    for label, centre, depth in (("Engine housing", plate.ENGINE_CENTRE, plate.ENGINE_DEPTH),
                                 ("Gear", plate.GEAR_CENTRE, plate.GEAR_DEPTH)):
        floor = shop.floor(centre, depth)
        shop.cut(PathAdaptive, f"{label}, clearing", 0, depth, base=floor, StepDown=depth, StepOver=35, Tolerance=0.3,
                 HelixAngle=3, LiftDistance=0.2, StockToLeave=0.2, FinishingProfile=False)
        shop.cut(ObjectProfile, f"{label}, walls", 0, depth, base=floor, StepDown=depth, Side="Inside",
                 Direction="CCW", processHoles=True, processCircles=True)
    shop.cut(ObjectProfile, "Slots", 0, THROUGH, sinking=True, StepDown=1.7, Side="Inside", Direction="CCW",
             base=shop.edges(*plate.slots()))
    shafts = [plate.circle(centre, plate.SHAFT_RADIUS) for centre in (plate.GEAR_CENTRE, plate.ENGINE_CENTRE)]
    shop.cut(ObjectHelix, "Shafts", -ABOVE, THROUGH, StepDown=0.8, Direction="CCW", StartSide="Inside",
             base=shop.edges(*shafts))
    holes = [plate.circle(hole - Vector(0, 0, plate.COUNTERBORE_DEPTH), plate.HOLE_RADIUS) for hole in plate.HOLES]
    shop.cut(ObjectHelix, "Bolt holes", -ABOVE, THROUGH, StepDown=0.8, Direction="CCW", StartSide="Inside",
             base=shop.edges(*holes))

    shop.change_tool(3, "End mill 6 mm", "5mm_Endmill", 6, speed=12000, feed=1500, plunge=400)
    counterbores = [plate.circle(hole, plate.COUNTERBORE_RADIUS) for hole in plate.HOLES]
    shop.cut(ObjectHelix, "Counterbores", -ABOVE, plate.COUNTERBORE_DEPTH, StepDown=0.8, Direction="CCW",
             base=shop.edges(*counterbores))
    rim = {"base": shop.edges(plate.rim()), "Side": "Outside", "Direction": "CW"}
    shop.cut(ObjectProfile, "Rim, rough", 0, plate.THICKNESS - SKIN, sinking=True, StepDown=4, OffsetExtra=0.2, **rim)
    shop.cut(ObjectProfile, "Rim, finish", 0, plate.THICKNESS - SKIN, StepDown=plate.THICKNESS, **rim)


shop = Workshop()
make_part(shop)
# No header: it would carry the date. No tool lengths: they belong to the machine that cuts the part.
linuxcnc_post.export(shop.program, os.path.join(FOLDER, "part.ngc"),
                     "--no-header --no-tlo --no-show-editor --precision=4")
picture.draw(os.path.join(FOLDER, "part.svg"))
