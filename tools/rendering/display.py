"""A display for VTK, which draws only through X."""

import contextlib
import ctypes
import os
import shutil
import subprocess

from rendering.failure import Failure


def can_open_display():
    """Tests the display, because VTK aborts if it cannot be opened."""
    if not os.environ.get("DISPLAY"):
        return False
    x11 = ctypes.CDLL("libX11.so.6")
    x11.XOpenDisplay.restype = ctypes.c_void_p
    return x11.XOpenDisplay(None) is not None


@contextlib.contextmanager
def display():
    """Debian's VTK draws only through X. A separate X server in memory (Xvfb) is the same on every
    machine, and is therefore preferred to the user's display."""
    xvfb = shutil.which("Xvfb")
    if xvfb is None:
        if not can_open_display():
            raise Failure("VTK requires an X server for drawing, and DISPLAY is not set to one.\n"
                          "On Debian: apt-get install xvfb; it is then started automatically.")
        yield
        return
    read_end, write_end = os.pipe()
    server = subprocess.Popen(
        [xvfb, "-displayfd", str(write_end), "-screen", "0", "1280x1024x24", "-nolisten", "tcp"],
        pass_fds=[write_end], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        os.close(write_end)
        with os.fdopen(read_end) as ready:
            number = ready.readline().strip()  # the number, once it is ready; empty if it failed
        if not number:
            raise Failure("Xvfb, the X server for VTK, did not start")
        os.environ["DISPLAY"] = f":{number}"
        yield
    finally:
        server.terminate()
        server.wait()
