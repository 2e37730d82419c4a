"""A display for VTK, which draws through X only."""

import contextlib
import ctypes
import os
import shutil
import subprocess

from rendering.failure import Failure


def can_open_display():
    """Tried beforehand, for VTK aborts where it cannot."""
    if not os.environ.get("DISPLAY"):
        return False
    x11 = ctypes.CDLL("libX11.so.6")
    x11.XOpenDisplay.restype = ctypes.c_void_p
    return x11.XOpenDisplay(None) is not None


@contextlib.contextmanager
def display():
    """Debian's VTK draws through X only. An X server in memory (Xvfb) of our own is the same on
    every machine, so it is preferred to the display that the user may have."""
    xvfb = shutil.which("Xvfb")
    if xvfb is None:
        if not can_open_display():
            raise Failure("VTK needs an X server to draw, and DISPLAY names none.\n"
                          "On Debian: apt-get install xvfb; it is then started by itself.")
        yield
        return
    read_end, write_end = os.pipe()
    server = subprocess.Popen(
        [xvfb, "-displayfd", str(write_end), "-screen", "0", "1280x1024x24", "-nolisten", "tcp"],
        pass_fds=[write_end], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        os.close(write_end)
        with os.fdopen(read_end) as ready:
            number = ready.readline().strip()  # once it is ready; nothing if it failed
        if not number:
            raise Failure("Xvfb, the X server that VTK would draw with, did not start")
        os.environ["DISPLAY"] = f":{number}"
        yield
    finally:
        server.terminate()
        server.wait()
