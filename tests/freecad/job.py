"""Run by freecadcmd: builds a Path job, a pocket and the profile of a plate, and posts it as the Path workbench does.

KCS_TEST_OUTPUT: the program's file. KCS_TEST_POST: the post-processor. KCS_TEST_ARGUMENTS: its arguments.
KCS_TEST_MACRO: run this macro instead of posting.
"""

import os

import FreeCAD
import Part
from FreeCAD import Vector
from PathScripts import PathJob, PathToolBit, PathToolController
from PathScripts.PathPocket import ObjectPocket
from PathScripts.PathPost import CommandPathPost
from PathScripts.PathProfile import ObjectProfile


def plate():
    block = Part.makeBox(40, 30, 8)
    hollow = Part.makeBox(20, 12, 3, Vector(10, 9, 5))
    return block.cut(hollow)


def make_job(document):
    model = document.addObject("Part::Feature", "Plate")
    model.Shape = plate()
    job = PathJob.Create("Job", [model], None)
    for default in job.Tools.Group:
        document.removeObject(default.Name)
    library = os.path.join(os.path.dirname(os.path.dirname(PathToolBit.__file__)), "Tools", "Bit")
    bit = PathToolBit.Factory.CreateFrom(os.path.join(library, "5mm_Endmill.fctb"))
    tool = PathToolController.Create("End mill", bit, 1)
    tool.HorizFeed = "1800 mm/min"
    tool.VertFeed = "600 mm/min"
    job.Proxy.addToolController(tool)
    floor = next(
        f"Face{number}"
        for number, face in enumerate(job.Model.Group[0].Shape.Faces, start=1)
        if abs(face.CenterOfMass.z - 5) < 1e-6 and face.Area > 200
    )
    add(document, job, tool, ObjectPocket, "Pocket", (job.Model.Group[0], (floor,)), 8, 5)
    add(document, job, tool, ObjectProfile, "Outline", None, 8, 0)
    document.recompute()
    return job


def add(document, job, tool, kind, label, base, top, bottom):
    operation = document.addObject("Path::FeaturePython", label)
    operation.Proxy = kind(operation, label, job)
    operation.ToolController = tool
    if base:
        operation.Base = [base]
    for name, value in {"StartDepth": top, "FinalDepth": bottom, "StepDown": 4}.items():
        operation.setExpression(name, None)
        setattr(operation, name, value)
    document.recompute()


job = make_job(FreeCAD.newDocument("plate"))
job.PostProcessor = os.environ["KCS_TEST_POST"]
job.PostProcessorArgs = os.environ["KCS_TEST_ARGUMENTS"]
job.PostProcessorOutputFile = os.environ["KCS_TEST_OUTPUT"]
if os.environ.get("KCS_TEST_MACRO"):
    with open(os.environ["KCS_TEST_MACRO"], encoding="utf-8") as macro:
        exec(compile(macro.read(), macro.name, "exec"), {"__name__": "__main__"})
else:
    # What the workbench's button Post Process does, without asking for anything.
    poster = CommandPathPost()
    for objects in poster.buildPostList(job):
        poster.exportObjectsWith(objects, job)
