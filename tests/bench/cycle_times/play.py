#!/usr/bin/python3
"""What LinuxCNC starts as its display: plays program.ngc once and records every setpoint into samples.txt."""
import subprocess
import sys
import time

import linuxcnc

command, status, errors = linuxcnc.command(), linuxcnc.stat(), linuxcnc.error_channel()


def ask(request, *arguments):
    request(*arguments)
    command.wait_complete()


def is_done():
    status.poll()
    return status.interp_state == linuxcnc.INTERP_IDLE and status.exec_state == linuxcnc.EXEC_DONE and status.inpos


ask(command.state, linuxcnc.STATE_ESTOP_RESET)
ask(command.state, linuxcnc.STATE_ON)
ask(command.mode, linuxcnc.MODE_AUTO)
command.program_open("program.ngc")
with open("samples.txt", "w") as samples:
    sampler = subprocess.Popen(["halsampler"], stdout=samples)
    command.auto(linuxcnc.AUTO_RUN, 0)
    time.sleep(1)  # until the program surely runs; what stands still at both ends is left out later
    while not is_done():
        time.sleep(0.05)
    time.sleep(0.2)  # until the sampler has written the last of it
    sampler.terminate()
    sampler.wait()
while message := errors.poll():
    if message[0] in (linuxcnc.OPERATOR_ERROR, linuxcnc.NML_ERROR):
        sys.exit(f"LinuxCNC says: {message[1]}")
open("done", "w").close()
