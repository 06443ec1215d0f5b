#!/usr/bin/python3
"""Runs the programs of cases.json in LinuxCNC's simulator, without a screen, and records every setpoint.

record.py CASES FOLDER [NAME...]: writes FOLDER/NAME.txt for the named cases, or all: a line "x y z", in mm, for every
millisecond. Takes as long as the programs do. LinuxCNC refuses to run for root, so root becomes another user for it.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
USER = 20001  # any that nobody has; what it starts lives in namespaces of its own and ends with them
FEED = 100  # mm/s

INI = """[EMC]
VERSION = 1.1
[DISPLAY]
DISPLAY = {folder}/play.py
[TASK]
TASK = milltask
CYCLE_TIME = 0.001
[RS274NGC]
PARAMETER_FILE = parameters
[EMCMOT]
EMCMOT = motmod
SERVO_PERIOD = 1000000
[EMCIO]
EMCIO = io
CYCLE_TIME = 0.1
TOOL_TABLE = tools
[HAL]
HALFILE = machine.hal
[KINS]
KINEMATICS = trivkins
JOINTS = 3
[TRAJ]
COORDINATES = X Y Z
LINEAR_UNITS = mm
ANGULAR_UNITS = degree
MAX_LINEAR_VELOCITY = {feed}
DEFAULT_LINEAR_VELOCITY = {feed}
MAX_LINEAR_ACCELERATION = 1e6
NO_FORCE_HOMING = 1
"""
AXIS = """[AXIS_{letter}]
MIN_LIMIT = -1000
MAX_LIMIT = 1000
MAX_VELOCITY = 500
MAX_ACCELERATION = {acceleration}
[JOINT_{joint}]
TYPE = LINEAR
MIN_LIMIT = -1000
MAX_LIMIT = 1000
MAX_VELOCITY = 500
MAX_ACCELERATION = {acceleration}
FERROR = 100
MIN_FERROR = 100
"""


def program_of(case):
    """The case's program with its tolerance, and with every feed replaced; rapids are kept to it by the machine."""
    feed = f"F[{FEED * 60}*#<_metric>+{FEED * 60}/25.4*#<_imperial>]"
    lines = ["G21", f"G64 P{case['tolerance']}", "G20" if case.get("inches") else ""]
    for line in open(case["file"]):
        line = re.sub(r"\([^)]*\)|;.*", "", line).strip()
        if not line.lower().startswith("o"):  # no feeds there, but "if ["
            line = re.sub(r"(?i)G64(\s*P\S+)?", "", line)
            line = re.sub(r"(?i)F\s*(\[[^]]*\]|[-+.\d]+)", feed, line)
        lines.append("" if line == "%" else line)
    return "\n".join(lines + ["M2", ""])


def set_up(case, folder):
    for name in "machine.hal", "play.py":
        shutil.copy(HERE / name, folder)
    folder.joinpath("play.py").chmod(0o755)
    folder.joinpath("tools").write_text("T1 P1 Z0 D10\n")
    axes = "".join(
        AXIS.format(letter=letter, joint=joint, acceleration=case["acceleration"]) for joint, letter in enumerate("XYZ"))
    folder.joinpath("machine.ini").write_text(INI.format(folder=folder, feed=FEED) + axes)
    folder.joinpath("program.ngc").write_text(program_of(case))


def record(case, recording):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        set_up(case, folder)
        command = ["linuxcnc", "-r", "machine.ini"]
        if os.geteuid() == 0:
            for path in [folder, *folder.iterdir()]:
                os.chown(path, USER, USER)
            command = ["unshare", "--ipc", "--pid", "--fork", "--kill-child", "--mount-proc", "setpriv",
                       f"--reuid={USER}", f"--regid={USER}", "--clear-groups", *command]
        log = folder / "log"
        with open(log, "w") as output:
            subprocess.run(command, cwd=folder, env={**os.environ, "HOME": name}, stdin=subprocess.DEVNULL,
                           stdout=output, stderr=output, timeout=600, check=False)
        if not (folder / "done").exists():
            sys.exit(f"LinuxCNC did not play {case['file']}; it said:\n{log.read_text()}")
        shutil.copyfile(folder / "samples.txt", recording)


def main(cases, folder, *names):
    os.makedirs(folder, exist_ok=True)
    for case in json.load(open(cases)):
        if not names or case["name"] in names:
            print(f"LinuxCNC plays {case['name']}", file=sys.stderr)
            record(case, os.path.join(folder, case["name"] + ".txt"))


main(*sys.argv[1:])
